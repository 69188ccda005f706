#include "hexahedra.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>

namespace myolines
{
  double corner_quality(const std::vector<dealii::Point<3>> &x, const unsigned int *v)
  {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (unsigned int i = 0; i < 8; ++i)
      {
        dealii::Tensor<1, 3> edge[3];
        for (unsigned int d = 0; d < 3; ++d)
          edge[d] = x[v[i | (1u << d)]] - x[v[i & ~(1u << d)]];
        const double J = edge[0] * dealii::cross_product_3d(edge[1], edge[2]);
        low            = std::min(low, J);
        high           = std::max(high, J);
      }
    return high > 0 ? low / high : -1;
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
