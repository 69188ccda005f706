// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace myolines
{
  /// What `point` is asked for.
  struct PointOptions
  {
    std::filesystem::path folder;                               ///< empty: results/ and the name of the scene, with " point" after it
    std::vector<double>   stretch{0.4, 1.8, 141};               ///< from, to, number of points
    std::vector<double>   strain_rate{-1.25, 1, 91};            ///< likewise, non-dimensional
    std::vector<double>   activation{0, 0.2, 0.4, 0.6, 0.8, 1}; ///< one curve for each
  };

  /// The laws of every tissue of a scene at a single point, uniaxial and incompressible, F = diag(s, s^(-1/2), s^(-1/2)) along the fibre
  /// (thesis (5.8.18), figures 5.4, 6.1 and 6.11): for each tissue TISSUE_stretch.csv (fibre stress against stretch at rate 0, one column
  /// for each activation), TISSUE_strain_rate.csv (at stretch 1), TISSUE_surface.csv (fully active, stretch by rate) and TISSUE_base.csv
  /// (Cauchy stress of the isotropic parts, 2 (s^2 - 1/s) dPsi/dI1), all in Pa with the weights of the mix, and a picture of each; a
  /// summary on @p out.
  ///
  /// Of a one-dimensional muscle, forces over F_0: muscle_parts.csv (at rest, fully active: active, passive, base material and total
  /// against stretch, each with its weight; thesis figure 3.4), muscle_stretch.csv (the total at rest, one column for each
  /// activation), muscle_strain_rate.csv (at stretch 1), a picture of each; on @p out where the force falls with the stretch.
  /// @throws InputError for other systems and empty ranges.
  void point_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, PointOptions options,
                     std::ostream &out);
} // namespace myolines
