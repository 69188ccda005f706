// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verify_results.h"

#include <myolines/study/runner.h>
#include <myolines/study/swings.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {

    LadderError ladder_error(const VerifiedQuantity &quantity, const std::vector<VerifyRun> &runs, const VerifyRun::Part part,
                             const Ladder &ladder, const std::filesystem::path &folder)
    {
      LadderError found;
      found.ladder = &ladder;
      for (const VerifyRun &run : runs)
        if (run.done() && (run.part == part || run.part == VerifyRun::Part::scene))
          found.runs.push_back(&run);
      std::sort(found.runs.begin(), found.runs.end(), [](const VerifyRun *a, const VerifyRun *b) { return a->rung.size > b->rung.size; });
      std::vector<Sample> samples;
      std::size_t         scene   = 0;
      double              between = 0; // rows of the last run
      for (const VerifyRun *run : found.runs)
        {
          if (run->part == VerifyRun::Part::scene)
            scene = samples.size();
          const NamedValue value = value_in_run(quantity, case_folder(folder, run->which.name));
          samples.push_back({run->rung.size, value.value});
          between = value.between;
          found.values.push_back(samples.back().value);
        }
      if (samples.size() > 1)
        found.error = discretisation_error(samples, scene, ladder.order);
      if (found.error && part == VerifyRun::Part::steps)
        found.error->error += between;
      return found;
    }

    /// log(CPU time) over log(1 / size), from the two finest runs that have both; at least 0.
    std::optional<double> growth_of_cost(const std::vector<const VerifyRun *> &runs)
    {
      std::vector<const VerifyRun *> timed;
      for (const VerifyRun *run : runs)
        if (run->outcome.cpu_seconds.value_or(0) > 0)
          timed.push_back(run);
      if (timed.size() < 2)
        return std::nullopt;
      const VerifyRun &fine = *timed.back(), &coarse = *timed[timed.size() - 2];
      return std::max(0., std::log(*fine.outcome.cpu_seconds / *coarse.outcome.cpu_seconds) / std::log(coarse.rung.size / fine.rung.size));
    }
  } // namespace

  std::optional<LadderError::Halving> LadderError::halving(const VerifyRun &scene) const
  {
    if (!error || !error->assumed || !ladder->finer)
      return std::nullopt;
    const Finer finer = ladder->finer(std::pow(2, 1 / *error->assumed));
    Halving     halving{finer.setting, {}};
    if (const auto growth = growth_of_cost(runs); growth && scene.outcome.cpu_seconds)
      halving.cpu_seconds = *scene.outcome.cpu_seconds * std::pow(finer.factor, *growth);
    return halving;
  }

  namespace
  {
    constexpr double steps_of_a_vibration = 8; // what is slower than so many steps of the scene is seen by its own method
    constexpr double safety_of_amplitudes = 3; // steps are of the length of the vibration, which has no rate

    /// At the rows of the one that has fewer: between these it would show how rows are joined.
    Series difference(const Series &series, const Series &other)
    {
      if (series.t.size() > other.t.size())
        return difference(other, series);
      const double first = other.t.front(), last = other.t.back();
      Series       common = window(series, first, last);
      const auto   there  = reference_at(other, common.t);
      for (std::size_t i = 0; there && i < common.x.size(); ++i)
        common.x[i] -= (*there)[i];
      return common;
    }

    double mean_step(const std::vector<double> &times)
    {
      return (times.back() - times.front()) / std::max<double>(1, static_cast<double>(times.size()) - 1);
    }

    /// Amplitude of the vibration that the run @p by of least damping has at the value, and the finest run of the method of the scene has
    /// not. An extreme value has its vibration in it, whatever its phase.
    void add_vibration(const VerifyRun &by, const VerifyRun &scene, const std::filesystem::path &folder, VerifiedValue &found)
    {
      const auto series_of_run = [&](const VerifyRun &run) { return series_in_run(found.quantity, case_folder(folder, run.which.name)); };
      const VerifyRun &finest  = *found.steps.runs.back();
      const NamedValue value   = value_in_run(found.quantity, case_folder(folder, by.which.name));
      const double     width   = 1.5 * steps_of_a_vibration * mean_step(series_of_run(scene).t);
      found.least_damped       = value.value;
      found.vibration =
          is_extreme(found.quantity) ? 0 : amplitude_about(difference(series_of_run(by), series_of_run(finest)), value.time, width);
      const double known = std::abs(found.steps.values.back() - found.value);
      found.steps_error =
          std::max({found.steps_error.value_or(0), std::abs(value.value - found.value), known + safety_of_amplitudes * *found.vibration});
    }
  } // namespace

  VerifiedValue verified_value(const VerifiedQuantity &quantity, const std::vector<VerifyRun> &runs, const Refinements &refinements,
                               const std::filesystem::path &folder)
  {
    const NamedValue of_scene = value_in_run(quantity, case_folder(folder, runs.front().which.name));
    VerifiedValue    found{quantity,
                        of_scene.header,
                        of_scene.value,
                        ladder_error(quantity, runs, VerifyRun::Part::steps, refinements.steps, folder),
                        ladder_error(quantity, runs, VerifyRun::Part::mesh, refinements.mesh, folder),
                        {},
                        {},
                        {},
                        {},
                        {},
                        {}};
    if (found.mesh.error)
      found.mesh_error = found.mesh.error->error;
    if (found.steps.error)
      found.steps_error = found.steps.error->error;
    for (const VerifyRun &run : runs)
      if (run.part == VerifyRun::Part::method && run.done())
        {
          found.other_method = value_in_run(quantity, case_folder(folder, run.which.name)).value;
          found.steps_error  = std::max(found.steps_error.value_or(0), std::abs(*found.other_method - found.value));
        }
      else if (run.part == VerifyRun::Part::least_damping && run.done())
        add_vibration(run, runs.front(), folder, found);
      else if (run.part == VerifyRun::Part::degree && run.done())
        {
          found.other_degree = value_in_run(quantity, case_folder(folder, run.which.name)).value;
          if (refinements.higher)
            found.mesh_error = std::max(found.mesh_error.value_or(0), std::abs(*found.other_degree - found.value));
        }
    return found;
  }

  std::optional<EnergyDrift> energy_drift(const VerifyRun &scene)
  {
    const auto manifest = nlohmann::json::parse(scene.outcome.manifest, nullptr, /*allow_exceptions*/ false);
    if (!manifest.is_object() || !manifest.contains("energy") || !manifest["energy"].is_object())
      return std::nullopt;
    const auto &energy = manifest["energy"];
    return EnergyDrift{energy["drift [J]"].get<double>(), energy["exchanged [J]"].get<double>()};
  }
} // namespace myolines::study
