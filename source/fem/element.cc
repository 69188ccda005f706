// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/element.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

namespace myolines
{
  namespace
  {
    /// Legendre polynomial of degree 0..2, orthonormal on [0, 1].
    double legendre(const int degree, const double x)
    {
      const double s = 2 * x - 1;
      return degree == 0 ? 1. : degree == 1 ? std::sqrt(3.) * s : std::sqrt(5.) * 0.5 * (3 * s * s - 1);
    }
  } // namespace

  Element::Element(const unsigned int degree, const unsigned int n)
    : n_nodes_1d(degree + 1)
    , n_nodes(n_nodes_1d * n_nodes_1d * n_nodes_1d)
    , n_points_1d(n)
    , n_points(n * n * n)
    , n_modes(degree * (degree + 1) * (degree + 2) / 6)
  {
    const dealii::QGauss<1>         gauss(n);
    const dealii::FE_Q<1>           line(degree);
    const std::vector<unsigned int> hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<1>(degree);
    for (unsigned int q = 0; q < n; ++q)
      {
        point.push_back(gauss.point(q)[0]);
        weight.push_back(gauss.weight(q));
        for (int i = 0; i < n_nodes_1d; ++i)
          {
            value.push_back(line.shape_value(hierarchic[i], gauss.point(q)));
            derivative.push_back(line.shape_grad(hierarchic[i], gauss.point(q))[0]);
          }
      }
    for (unsigned int q = 0; q < n * n * n; ++q)
      {
        const unsigned int qx = q % n, qy = (q / n) % n, qz = q / (n * n);
        weights_3d.push_back(weight[qx] * weight[qy] * weight[qz]);
        for (unsigned int total = 0; total < degree; ++total)
          for (unsigned int c = 0; c <= total; ++c)
            for (unsigned int b = 0; b + c <= total; ++b)
              modes.push_back(legendre(total - b - c, point[qx]) * legendre(b, point[qy]) * legendre(c, point[qz]));
      }
  }
} // namespace myolines
