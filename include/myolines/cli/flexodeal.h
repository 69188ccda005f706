// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace myolines
{
  /// Files of Flexodeal or of Flexodeal Lite and the scene to make of them.
  struct FlexodealOptions
  {
    std::filesystem::path parameters; ///< deal.II parameter file
    std::filesystem::path
        strain; ///< two columns t [s], strain [-]; empty or "-": the ramp that the earliest versions have in the parameters
    std::filesystem::path activation; ///< two columns t [s], activation [-]; likewise
    std::filesystem::path scene;      ///< to write
    std::filesystem::path markers;    ///< lines "name x y z" [m], or nothing; empty: none
    std::filesystem::path pressures;  ///< columns of time [s] and of pressures [Pa] on faces, under their numbers; empty: none
    std::filesystem::path points;     ///< its "quadrature point data", CSV; empty: none
    std::string           steps;      ///< schedule; empty: the step size of the parameters

    std::filesystem::path mesh; ///< mesh instead of the body of the parameters; empty: none
    std::vector<std::string>
        ends; ///< names of its surfaces that are held and pulled; empty: those with the numbers 0 and "Pulling face ID"
  };

  /// Writes the scene of type "muscle 3d" that computes what that program would, with its boundary rates, points and tolerances. Parameters
  /// of any version are read: what an entry means depends on the entries that are there. What is replaced, changed or has no counterpart is
  /// told on @p out. The end is that of the last step that it makes before its end time (it writes 0.20000001 for 0.2).
  /// @throws InputError with file and line for what no version has, what changes the physics in an unknown way, and what `check` refuses.
  void import_flexodeal(const FlexodealOptions &options, std::ostream &out);
} // namespace myolines
