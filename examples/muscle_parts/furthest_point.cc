// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/discretisation.h>
#include <myolines/observers/muscle3d_series.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  SeriesEntry furthest_point_entry()
  {
    return switched_series("furthest point", false, SeriesNeeds::nothing, "furthest.csv: the largest displacement of a node.",
                           [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
                             return make_series_file(
                                 context.folder, {"furthest.csv", "Largest displacement of a node"}, {"Time [s]", "Displacement [m]"},
                                 [](const Muscle3dSample &sample) {
                                   const Vector &u      = sample.state().u; // three components of each node, one behind the other
                                   double        square = 0;
                                   for (unsigned int i = 0; i < u.locally_owned_size(); i += 3)
                                     square = std::max(square, std::pow(u.local_element(i), 2) + std::pow(u.local_element(i + 1), 2) +
                                                                   std::pow(u.local_element(i + 2), 2));
                                   const MPI_Comm all = sample.system().discretisation().communicator;
                                   return std::vector<double>{sample.t(), std::sqrt(dealii::Utilities::MPI::max(square, all))};
                                 });
                           });
  }
} // namespace myolines
