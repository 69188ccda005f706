// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verify_results.h"

#include <myolines/study/runner.h>

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
