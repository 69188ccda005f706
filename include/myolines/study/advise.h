// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/verify.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// A method that may run the scene, with the sizes of its steps or its tolerances.
  struct Candidate
  {
    std::string                name;      ///< "sdirk3", "sdirk3, steps by error"
    std::string                parameter; ///< whose values the rungs are: "time/step"
    std::vector<std::string>   settings;  ///< that choose it; each rung has more
    std::vector<Rung>          rungs;     ///< from coarse to fine at one ratio of sizes
    std::optional<std::size_t> like;      ///< of steps by error: the candidate that is the same method with given steps
  };

  /// What may be chosen for a scene.
  struct Choices
  {
    std::vector<Candidate>                           candidates; ///< in the order of the list of methods
    std::size_t                                      reference;  ///< the candidate of high order whose values are taken as true
    std::size_t                                      check;      ///< another one of high order, which must agree with it
    std::vector<std::pair<std::string, std::string>> refused;    ///< method, and why the scene does not take it
    Ladder                                           mesh;       ///< meshes from the coarsest on
  };

  /// What `advise` is asked for.
  struct AdviseOptions : QuantityOptions
  {
    std::string           accuracy;          ///< "1 %" of the value, or a number in its unit
    bool                  keep_mesh = false; ///< the mesh of the scene stays; the accuracy is that of the steps alone
    bool                  trial     = true;  ///< what the pilot has found is tried on its mesh, where that is another one
    double                budget    = 3600;  ///< of the whole command [s]
    std::filesystem::path write;             ///< file for the scene that is recommended; empty for none

    /// What may be chosen. @throws InputError if it is no scene.
    std::function<Choices(const std::filesystem::path &scene, const std::vector<std::string> &overrides)> choices;
    /// The scene with these settings, as a file.
    std::function<std::string(const std::filesystem::path &scene, const std::vector<std::string> &settings)> scene_text;
  };

  /// The command `advise`: finds the method, the step or tolerance, and the mesh with which the quantities of a scene have the accuracy at
  /// the least CPU time, by a pilot on the coarsest mesh:
  ///   1. a reference, by a method of high order with shorter and shorter steps, until its change from step to step is a tenth of the
  ///      accuracy, and its distance from another method a quarter, and eight times shorter ones change it no more;
  ///   2. the reference on finer meshes: their errors (discretisation_error(), without factor of safety) and cost. The coarsest whose error
  ///      is at most three quarters of the accuracy is taken;
  ///   3. all candidates with finer and finer steps, until what the mesh leaves of the accuracy is met, here and with the next finer step,
  ///      or the run costs more than the cheapest that met it.
  ///   4. the cheapest on the mesh that is taken, beside the reference there; if its error is too large, the search goes on.
  /// The error that the pilot predicts is the larger one of the two steps of 3, and that of the mesh; the cost is that of the run of the
  /// pilot times the ratio of the costs of the reference on both meshes. Trials measure both. Writes advise.txt, advise.csv (a row for each
  /// candidate), runs.csv and advise.sqlite. Runs that are done are not run again.
  /// @throws InputError for quantities that the runs do not have or an accuracy that is none; SolveError if there is no reference, no mesh
  /// or no candidate within the accuracy; Interrupted by a signal or where the budget is spent.
  void advise_command(const AdviseOptions &options, std::ostream &out);
} // namespace myolines::study
