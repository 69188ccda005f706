// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_mesh.h"
#include "number_text.h"

#include <myolines/base/error.h>
#include <myolines/study/discretisation_error.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    constexpr double part_of_steps = 0.1;  // of the accuracy, that runs on finer meshes may miss by their steps
    constexpr double part_of_mesh  = 0.75; // of the accuracy, that the mesh may take

    /// The same run on the meshes of a ladder, from the coarsest on.
    struct MeshRuns
    {
      const Ladder                 &ladder;
      std::size_t                   rung_of_reference;
      std::vector<const PilotRun *> runs; ///< that are done

      double start_up(const std::size_t rung) const { return runs[std::min(rung, runs.size() - 1)]->start_up(); }

      /// CPU time of the steps on mesh @p rung over that on the first; beyond the runs by their growth from mesh to mesh.
      double growth(const std::size_t rung) const
      {
        const auto        steps = [](const PilotRun &run) { return std::max(1e-3, run.seconds_of_steps()); };
        const std::size_t last  = runs.size() - 1;
        const double      known = steps(*runs[std::min(rung, last)]) / steps(*runs.front());
        if (rung <= last)
          return known;
        const double ratio = last == 0 ? ladder.rungs[1].cost / ladder.rungs[0].cost : steps(*runs[last]) / steps(*runs[last - 1]);
        return known * std::pow(ratio, static_cast<double>(rung - last));
      }

      /// Likely error of the quantity @p q on mesh @p rung; none of a single run.
      std::optional<double> error(const std::size_t q, const std::size_t rung) const
      {
        if (runs.size() < 2)
          return std::nullopt;
        std::vector<Sample> samples;
        for (std::size_t i = runs.size() < 3 ? 0 : runs.size() - 3; i < runs.size(); ++i)
          samples.push_back({ladder.rungs[i].size, runs[i]->values[q].value});
        const std::size_t last = runs.size() - 1, first = runs.size() - samples.size();
        if (rung < first)
          return std::abs(runs[rung]->values[q].value - samples.back().value) +
                 discretisation_error(samples, samples.size() - 1, ladder.order).likely;
        const DiscretisationError found = discretisation_error(samples, std::min(rung, last) - first, ladder.order);
        return rung <= last || !found.assumed ? found.likely
                                              : found.likely * std::pow(ladder.rungs[rung].size / samples.back().size, *found.assumed);
      }
    };

    /// On all meshes up to @p at_least, and finer ones as far as --at-most goes. A run that fails ends the row.
    MeshRuns runs_on_meshes(Pilot &pilot, const PilotCase &which, const Ladder &ladder, const std::size_t at_least, const double at_most)
    {
      std::vector<PilotCase> cases;
      for (std::size_t i = 0; i < ladder.rungs.size() && (i <= at_least || ladder.rungs[i].cost <= at_most); ++i)
        cases.push_back({which.candidate, which.rung, &ladder.rungs[i]});
      MeshRuns found{ladder, which.rung, {}};
      for (const PilotRun *run : pilot.run(cases))
        if (run->done())
          found.runs.push_back(run);
        else
          break;
      if (found.runs.size() <= at_least)
        throw SolveError("no mesh of the scene can be advised: the run \"" + cases[found.runs.size()].candidate->name + "\" on " +
                         ladder.parameter + " = " + ladder.rungs[found.runs.size()].label + " did not end");
      return found;
    }

    MeshChoice chosen(const MeshRuns &meshes, const std::size_t rung, const Values &errors)
    {
      const Ladder &ladder = meshes.ladder;
      return {&ladder.rungs.front(), &ladder.rungs[rung], errors, meshes.rung_of_reference, meshes.start_up(rung), meshes.growth(rung)};
    }

    std::string too_coarse(const Ladder &ladder, const std::string &label, const double ratio)
    {
      return "no mesh leaves enough of the accuracy to the steps: the error of " + ladder.parameter + " = " + label + " is about " +
             digits(ratio, 2) + " times the accuracy" + (ladder.note.empty() ? "" : " (" + ladder.note + ")") +
             ". A larger --accuracy, a larger --at-most, or --keep-mesh, which advises the method alone, may help";
    }
  } // namespace

  const Rung *mesh_of_the_pilot(const Ladder &mesh) { return mesh.rungs.size() > 1 ? &mesh.rungs.front() : nullptr; }

  MeshChoice choose_mesh(Pilot &pilot, const Choices &choices, const TimeReference &reference, const AdviseOptions &options)
  {
    const Ladder     &ladder     = choices.mesh;
    const std::size_t quantities = pilot.quantities().size();
    if (ladder.rungs.size() < 2)
      return {nullptr, nullptr, Values(quantities, 0), reference.rung(), reference.run().start_up(), 1};
    const PilotCase which{&choices.candidates[choices.reference], reference.rung_within(part_of_steps), nullptr};
    if (options.keep_mesh)
      {
        const MeshRuns meshes = runs_on_meshes(pilot, which, ladder, ladder.scene, 0);
        return chosen(meshes, ladder.scene, Values(quantities, 0));
      }
    const MeshRuns            meshes = runs_on_meshes(pilot, which, ladder, 1, options.at_most);
    std::optional<MeshChoice> coarsest; // that is fine enough, as all finer ones are
    double                    finest_ratio = 0;
    for (std::size_t rung = ladder.rungs.size(); rung-- > 0;)
      {
        Values errors;
        for (std::size_t q = 0; q < quantities; ++q)
          errors.push_back(*meshes.error(q, rung));
        const double ratio = reference.ratio(errors);
        if (rung + 1 == ladder.rungs.size())
          finest_ratio = ratio;
        if (ratio > part_of_mesh)
          break;
        coarsest = chosen(meshes, rung, errors);
      }
    if (coarsest)
      return *coarsest;
    throw SolveError(too_coarse(ladder, ladder.rungs.back().label, finest_ratio));
  }
} // namespace myolines::study
