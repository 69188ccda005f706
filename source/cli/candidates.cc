// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/cli/candidates.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/fit.h>
#include <myolines/cli/refinements.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/integrator.h>
#include <myolines/time/step_control.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    using study::Candidate;
    using study::Rung;

    constexpr int    sizes_of_steps = 14, tolerances = 10;
    constexpr double largest_tolerance = 0.1, ratio_of_tolerances = 4;
    constexpr int    first_step_tried = 4; // of those sizes, where steps are chosen by error

    /// The scene without a method.
    class SceneToAdvise
    {
    public:
      SceneToAdvise(const std::filesystem::path &file, const std::vector<std::string> &overrides)
        : file_(file)
        , overrides_(overrides)
        , node_(read_whole_scene(file, overrides))
        , time_(node_.section("time"))
      {
        require_steps(time_);
        const double step = time_.has("step") ? time_.number("step") : parse_schedule(time_.text("steps"), time_, "steps").front().size;
        const double half = (time_.number("end") - time_.number("start")) / 2;
        if (!(half > 0))
          time_.refuse("end", "the end does not come after the start", "a time later than \"start\" [s]");
        longest_ = std::min(half, step * std::exp2(std::floor(std::log2(half / step) + 1e-9)));
      }

      std::string method() const { return node_.section("integrator").text("type"); }

      /// @throws InputError if the scene does not take the method.
      Candidate with_given_steps(const IntegratorEntry &method) const
      {
        Candidate candidate{method.facts.name, "time/step", settings_of(method), {}, {}};
        if (method.facts.solves == MethodFacts::Solves::mass) // which would be cut to the stable ones, however many these are
          candidate.settings.push_back("time/control/type=fixed");
        else if (time_.section("control").text("type") == "error")
          candidate.settings.push_back("time/control/type=cut back");
        with(candidate.settings);
        for (int i = 0; i < sizes_of_steps; ++i)
          candidate.rungs.push_back({short_number(step(i)), {step_setting(i)}, std::exp2(-i), std::exp2(i)});
        return candidate;
      }

      /// @throws InputError if the scene does not take them.
      Candidate with_steps_by_error(const IntegratorEntry &method, const std::size_t like) const
      {
        Candidate candidate{method.facts.name + ", steps by error", "tolerance", settings_of(method), {}, like};
        candidate.settings.insert(candidate.settings.end(), {"time/control/type=error", step_setting(first_step_tried)});
        const scene::Node  whole   = with(candidate.settings);
        const scene::Node &control = whole.section("time").section("control");
        double             largest = 0, label = 1; // of the scene
        for (const char *block : {"velocity", "displacement"})
          if (control.has(block))
            {
              label   = control.section(block).number("relative tolerance");
              largest = std::max(largest, label);
            }
        const double most =
            largest > 0 ? std::pow(ratio_of_tolerances, std::floor(std::log(largest_tolerance / largest) / std::log(ratio_of_tolerances)))
                        : 64;
        for (int i = 0; i < tolerances; ++i)
          {
            const double size = std::pow(ratio_of_tolerances, -i);
            candidate.rungs.push_back(
                {short_number(most * size * (label > 0 ? label : 1)), scaled_tolerances(control, most * size), size, 1 / size});
          }
        return candidate;
      }

      scene::Node with(const std::vector<std::string> &settings) const
      {
        std::vector<std::string> all = overrides_;
        all.insert(all.end(), settings.begin(), settings.end());
        return read_whole_scene(file_, all);
      }

    private:
      static std::string short_number(const double value)
      {
        std::ostringstream text;
        text << value;
        return text.str();
      }

      double      step(const int i) const { return longest_ * std::exp2(-i); }
      std::string step_setting(const int i) const { return "time/step=" + scene::format_number(step(i)); }

      std::vector<std::string> settings_of(const IntegratorEntry &method) const
      {
        std::vector<std::string> settings;
        if (method.facts.name != this->method())
          settings.push_back("integrator/type=" + method.facts.name);
        if (time_.has("steps"))
          settings.push_back("~time/steps");
        return settings;
      }

      const std::filesystem::path    file_;
      const std::vector<std::string> overrides_;
      const scene::Node              node_;
      const scene::Node             &time_;
      double                         longest_; ///< step [s]
    };
    /// What @p make makes is added; where the scene refuses it, why.
    template <typename Make>
    bool add_if_taken(const std::string &name, study::Choices &choices, const Make &make)
    {
      try
        {
          choices.candidates.push_back(make());
          return true;
        }
      catch (const InputError &error)
        {
          choices.refused.emplace_back(name, error.problems().front().what);
          return false;
        }
    }

    std::size_t place_of(const std::string &name, const std::vector<Candidate> &candidates)
    {
      const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate &each) { return each.name == name; });
      return found - candidates.begin();
    }
  } // namespace

  study::Choices choices_of(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    const SceneToAdvise scene(file, overrides);
    study::Choices      choices;
    choices.mesh = refinements_of(file, overrides).mesh;
    for (const IntegratorEntry &method : integrator_registry())
      if (method.make && !method.make_self_paced)
        add_if_taken(method.facts.name, choices, [&] { return scene.with_given_steps(method); });
    const std::size_t n = choices.candidates.size();
    for (std::size_t i = 0; i < n; ++i)
      if (const IntegratorEntry &method = integrator_entry(choices.candidates[i].name); method.facts.error_exponent > 0)
        add_if_taken(method.facts.name + ", steps by error", choices, [&] { return scene.with_steps_by_error(method, i); });
    const auto all    = methods_for_every_system();
    choices.reference = place_of(all.at(0)->facts.name, choices.candidates);
    choices.check     = place_of(all.at(1)->facts.name, choices.candidates);
    return choices;
  }
} // namespace myolines
