// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hexahedra.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace myolines
{
  double scaled_jacobian(const std::vector<dealii::Point<3>> &x, const unsigned int *v)
  {
    double smallest = 1;
    for (unsigned int i = 0; i < 8; ++i)
      {
        dealii::Tensor<1, 3> edge[3];
        for (unsigned int d = 0; d < 3; ++d)
          edge[d] = x[v[i | (1u << d)]] - x[v[i & ~(1u << d)]];
        const double lengths = edge[0].norm() * edge[1].norm() * edge[2].norm();
        smallest             = std::min(smallest, lengths > 0 ? edge[0] * dealii::cross_product_3d(edge[1], edge[2]) / lengths : 0.);
      }
    return smallest;
  }

  double cell_volume(const std::vector<dealii::Point<3>> &x, const unsigned int *v)
  {
    double                  volume = 0;
    const dealii::QGauss<3> rule(2);
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        dealii::Tensor<2, 3> J;
        for (unsigned int i = 0; i < 8; ++i)
          J += outer_product(x[v[i]], dealii::GeometryInfo<3>::d_linear_shape_function_gradient(rule.point(q), i));
        volume += rule.weight(q) * determinant(J);
      }
    return volume;
  }
} // namespace myolines
