// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/quantity_options.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::study
{
  /// A scene with another discretisation.
  struct Rung
  {
    std::string              label;    ///< value of the parameter, "0.0125"
    std::vector<std::string> settings; ///< "time/step=0.0125"
    double                   size;     ///< of steps, cells or tolerances, over that of the scene
    double                   cost;     ///< CPU time over that of the scene, predicted
  };

  /// What makes a scene as much finer as is wanted.
  struct Finer
  {
    std::string setting; ///< "time/step = 0.0088"
    double      factor;  ///< by which sizes then really go down
  };

  /// One way to make a scene finer, and coarser.
  struct Ladder
  {
    std::string                         name;      ///< "steps", "mesh"
    std::string                         parameter; ///< "time/step"; "" if there is none
    double                              order = 1; ///< of the error in the size, in theory
    std::vector<Rung>                   rungs;     ///< from coarse to fine at one ratio of sizes; the scene is one of them
    std::size_t                         scene = 0; ///< index of the scene in rungs
    std::string                         note;      ///< why there are no, or no finer, rungs; "" for no reason
    std::function<Finer(double factor)> finer;     ///< at least so many times finer
  };

  /// All ways to make a scene finer.
  struct Refinements
  {
    Ladder              steps;          ///< in time
    Ladder              mesh;           ///< in space
    std::optional<Rung> degree;         ///< another degree of the elements on the same mesh, if there is one
    std::string         degree_name;    ///< "system/degree"
    bool                higher = false; ///< whether that degree is higher
    std::optional<Rung> method;         ///< a method of higher order with the steps of the scene, if there is one
    std::optional<Rung> least_damping;  ///< the method that keeps vibrations best, where it is another one and there may be some
    std::string         method_name;    ///< "integrator/type"
  };

  /// What `verify` is asked for.
  struct VerifyOptions : QuantityOptions
  {
    /// What can be refined in the scene. @throws InputError if it is no scene.
    std::function<Refinements(const std::filesystem::path &scene, const std::vector<std::string> &overrides)> refinements;
  };

  /// The command `verify`: runs the scene as it stands, with shorter steps, by a method of higher order, by one that damps least, on other
  /// meshes and with elements of another degree, and tells for each quantity the value of the scene with the estimated errors of steps and
  /// mesh (discretisation_error()), the drift of energy, which error is the largest and what halving it would cost. Writes verify.txt,
  /// verify.csv (a row for each quantity), runs.csv (a row for each run) and verify.sqlite. Runs that are done are not run again.
  /// @throws InputError for quantities that the runs do not have, SolveError if a run failed, after all others were told; Interrupted.
  void verify_command(const VerifyOptions &options, std::ostream &out);
} // namespace myolines::study
