// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Adds the optional parameter `strain places` to the list @p series; @p where says which points x stands for.
  void add_strain_places(scene::Schema &series, const std::string &where);

  /// The places, in (0, 1]; none if they are not given. @throws InputError.
  std::vector<double> read_strain_places(const scene::Node &series);

  /// Header of strain.csv: time, strains and strain rates at all places.
  ///
  /// strain(p L) = (u(p L) - u(0))/(p L) and its rate (v(p L) - v(0))/(p L), the mean ones of the part between x = 0 and x = p L, as in
  /// the figures of thesis section 4.7.
  std::vector<std::string> strain_columns(const std::vector<double> &places);

  /// A row of strain.csv from displacements @p u and velocities @p v at x = 0 and then at the places.
  std::vector<double> strain_row(double t, const std::vector<double> &places, double length, const std::vector<double> &u,
                                 const std::vector<double> &v);
} // namespace myolines
