// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/cli/resume.h>
#include <myolines/cli/simulation.h>
#include <myolines/output/text_file.h>
#include <myolines/system/instants.h>

#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    /// Calls a function between steps, with their number.
    class Between : public Keeper
    {
    public:
      explicit Between(std::function<void(std::size_t)> call)
        : call_(std::move(call))
      {}

      void                       accepted(const State &, const std::size_t step) override { call_(step); }
      std::optional<std::string> reason_to_stop(const State &, std::size_t) override { return std::nullopt; }
      void                       ended(const State &, std::size_t) override {}

    private:
      std::function<void(std::size_t)> call_;
    };
  } // namespace

  Simulation::Simulation(scene::Node scene, const InstructionSet instruction_set)
    : experiment_(std::move(scene), instruction_set)
    , state_(experiment_.start())
    , observers_{&followed_}
  {}

  void Simulation::advance_to(const double t, const std::function<void()> &between)
  {
    const double end = experiment_.settings().end;
    if (!(t >= state_.t) || t > end)
      experiment_.scene().section("time").refuse(
          "end", "the simulation is at t = " + exact_text(state_.t) + " s and cannot advance to " + exact_text(t) + " s",
          "a time from there to the end of the scene, " + exact_text(end) + " s");
    if (t == state_.t)
      return;
    LoopSettings settings = experiment_.settings();
    settings.end          = t;
    settings.steps_done   = followed_.steps;
    settings.resumed      = followed_.begun;
    // Kinks of the present time count, of courses that have been set here as well.
    settings.start = followed_.begun ? std::nextafter(state_.t, std::numeric_limits<double>::lowest()) : state_.t;
    Between keeper([&](const std::size_t step) {
      if (forgets(step))
        experiment_.forget();
      if (between)
        between();
    });
    experiment_.advance(settings, state_, observers_, &keeper);
    if (forgets(followed_.steps)) // of the last step the keeper does not hear
      experiment_.forget();
  }

  bool Simulation::forgets(const std::size_t step) const
  {
    return step % experiment_.scene().section("output").section("checkpoint").integer("every") == 0;
  }

  Steering &Simulation::steering(const std::string &path)
  {
    std::vector<std::string> paths;
    for (const auto &one : steered())
      {
        if (one->path() == path)
          return *one;
        paths.push_back(one->path());
      }
    const scene::Node &scene = experiment_.scene();
    throw InputError(InputProblem{scene.where("") + path, "nothing there is steered",
                                  paths.empty() ? "a drive of type \"steered\"; the scene has none" : "one of " + join(paths),
                                  nearest_hint(path, paths, "nearest")});
  }

  void Simulation::steer(const std::string &path, const double value, const double duration)
  {
    Steering &one = steering(path);
    if (followed_.begun || duration > 0)
      one.go_to(value, state_.t, duration);
    else
      one.begin_with(value);
    if (!followed_.begun)
      state_ = experiment_.start();
  }

  void Simulation::steer(const std::string &path, std::shared_ptr<const Drive> course)
  {
    Steering &one = steering(path);
    if (followed_.begun)
      return one.follow(std::move(course), state_.t);
    one.begin_with(std::move(course), state_.t);
    state_ = experiment_.start();
  }

  const std::vector<Simulation::Measured> &Simulation::measure()
  {
    if (tables_.empty())
      tables_ = experiment_.make_outputs(OutputFolder::read_by(
          [this](const std::string &table, const std::vector<std::string> &columns, const std::vector<double> &values) {
            for (std::size_t i = 0; i < values.size(); ++i)
              measured_.push_back({table, columns.at(i), values[i]});
          }));
    measured_.clear();
    for (const auto &table : tables_)
      table->measure(state_, followed_.begun ? Side::left : Side::right);
    return measured_;
  }

  Simulation::Moment Simulation::save()
  {
    Moment moment;
    moment.begun     = followed_.begun;
    moment.run.step  = followed_.steps;
    moment.run.state = state_;
    if (followed_.begun)
      experiment_.keep(moment.run);
    for (const auto &one : steered())
      moment.courses.push_back(one->courses());
    return moment;
  }

  void Simulation::restore(const Moment &moment)
  {
    const bool        of_a_file = moment.courses.empty(); // which has nothing of what steers
    const std::size_t n_drives = moment.courses.size(), n_unknowns = moment.run.state.u.size();
    if (n_unknowns != state_.u.size() || (!of_a_file && n_drives != steered().size()))
      throw InputError(InputProblem{"restore",
                                    "the moment is of another scene: it has " + std::to_string(n_unknowns) + " unknowns and " +
                                        std::to_string(n_drives) + " steered drives",
                                    std::to_string(state_.u.size()) + " and " + std::to_string(steered().size()),
                                    "save() of a simulation of the same scene makes one"});
    followed_.begun = moment.begun;
    followed_.steps = moment.run.step;
    state_          = moment.run.state;
    if (followed_.begun)
      experiment_.recall(moment.run);
    for (std::size_t i = 0; i < moment.courses.size(); ++i)
      steered()[i]->put_back(moment.courses[i]);
  }

  void Simulation::save(const std::filesystem::path &file)
  {
    if (!followed_.begun)
      throw InputError(InputProblem{file.string(), "the simulation has not begun", "at least one step before its state is written", ""});
    Checkpoint now      = save().run;
    now.scene           = scene::resolved_xml(experiment_.scene());
    now.inputs          = experiment_.inputs();
    now.instruction_set = name(experiment_.instruction_set());
    write_checkpoint(file, now, experiment_.system());
  }

  void Simulation::restore(const std::filesystem::path &file)
  {
    const CheckpointReader reader(file);
    refuse_other_run(reader.contents().scene, scene::resolved_xml(experiment_.scene()), file.string());
    refuse_other_mesh(experiment_.scene(), reader.contents().inputs);
    Moment moment{reader.read(experiment_.system()), {}, true};
    restore(moment);
  }
} // namespace myolines
