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
    std::filesystem::path strain;     ///< two columns t [s], strain [-]
    std::filesystem::path activation; ///< two columns t [s], activation [-]
    std::filesystem::path scene;      ///< to write
    std::filesystem::path markers;    ///< lines "name x y z" [m]; empty: none
    std::filesystem::path points;     ///< its "quadrature point data", CSV; empty: none
    std::string           steps;      ///< schedule; empty: the step size of the parameters

    std::filesystem::path    mesh; ///< mesh instead of the body of the parameters; empty: none
    std::vector<std::string> ends; ///< names of its physical surfaces that are the faces 0 and 1, x- and x+; two with a mesh
  };

  /// Writes the scene of type "muscle 3d" that computes what that program would, with its boundary rates, points and
  /// tolerances; what has no counterpart is named on @p out, a line each. The end is the largest whole number of steps
  /// that fits into its end time (it writes 0.20000001 for 0.2). @throws InputError with file and line.
  void import_flexodeal(const FlexodealOptions &options, std::ostream &out);
} // namespace myolines
