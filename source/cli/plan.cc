// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/scratch_folder.h>
#include <myolines/cli/plan.h>

#include <csignal>
#include <ctime>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// The CPU time of steps as they are taken.
    class StepClock : public Observer
    {
    public:
      void accepted(const State &, const StepRecord &record) override
      {
        done.push_back(seconds());
        sizes.push_back(record.dt);
      }

      double seconds() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

      std::vector<double> done, sizes; ///< when each had been taken [s], and how long it was [s]

    private:
      std::clock_t begin_ = std::clock();
    };

    constexpr double      patience = 20; // [s]
    constexpr std::size_t trials   = 4;

    std::string seconds_text(const double seconds)
    {
      std::ostringstream text;
      text.precision(2);
      if (seconds < 120)
        text << seconds << " s";
      else if (seconds < 7200)
        text << seconds / 60 << " min";
      else
        text << seconds / 3600 << " h";
      return text.str();
    }
  } // namespace

  std::vector<std::string> skipped_outputs(const Experiment &experiment)
  {
    const scene::Node       &output = experiment.scene().section("output");
    const scene::Schema      schema = system_entry(experiment.scene().section("system").text("type"), "").output();
    std::vector<std::string> lines;
    for (const scene::Schema::Section &section : schema.sections())
      if (!output.has(section.name))
        lines.push_back("off  output " + section.name + ": not asked for");
      else
        for (const scene::Entry &entry : section.schema->entries())
          if (entry.kind == scene::Kind::boolean && !output.section(section.name).boolean(entry.name))
            lines.push_back("off  output " + section.name + ", " + entry.name + ": not asked for");
    return lines;
  }

  std::vector<std::string> plan_of(const Experiment &experiment)
  {
    std::vector<std::string> lines = experiment.assembled().plan;
    for (const auto &more : {skipped_outputs(experiment), experiment.solver_plan()})
      lines.insert(lines.end(), more.begin(), more.end());
    return lines;
  }

  std::string predicted_cost(Experiment &experiment)
  {
    const auto          planned = experiment.planned_steps();
    const ScratchFolder scratch;
    StepClock           clock;
    try
      {
        experiment.run({&clock}, scratch.path(), [&] { return clock.done.size() >= trials || clock.seconds() > patience ? SIGTERM : 0; });
      }
    catch (const Interrupted &)
      {}
    catch (const SolveError &error)
      {
        if (clock.done.empty())
          return std::string("cost: not known, the first step failed: ") + error.what();
      }
    if (clock.done.empty())
      return "cost: the first step takes more than " + seconds_text(patience) + " of CPU";
    const std::size_t n       = clock.done.size();
    const double      of_step = n > 1 ? (clock.done.back() - clock.done.front()) / static_cast<double>(n - 1) : clock.done.front();
    const std::string per     = "about " + seconds_text(of_step) + " of CPU a step on each rank, from the first " + std::to_string(n);
    if (!planned)
      return "cost: " + per + "; how many steps there will be, the errors decide";
    return "cost: about " + seconds_text(clock.done.front() + of_step * (static_cast<double>(planned->n_steps) - 1)) +
           (planned->complete ? "" : " or more") + " of CPU on each rank, outputs aside (" + per + ")";
  }
} // namespace myolines
