// SPDX-License-Identifier: LGPL-2.1-or-later
#include "muscle1d_element.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

namespace myolines
{
  Muscle1dSystem::Element::Element(const unsigned int degree, const double length, const unsigned int n_points, const double density,
                                   const double consistent_part)
    : n(degree + 1)
    , h(length)
  {
    const auto              shapes = dealii::Polynomials::generate_complete_Lagrange_basis(dealii::QGaussLobatto<1>(n).get_points());
    const dealii::QGauss<1> gauss(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        GaussPoint point{h * gauss.weight(q), {}};
        for (const auto &shape : shapes)
          point.slope.push_back(shape.derivative().value(gauss.point(q)[0]) / h);
        points.push_back(point);
      }
    if (density == 0)
      return;
    mass.assign(n, std::vector<double>(n, 0.));
    const auto add_mass = [&](const dealii::Quadrature<1> &rule, const double part) {
      for (unsigned int q = 0; q < n; ++q)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            mass[i][j] += part * density * h * rule.weight(q) * shapes[i].value(rule.point(q)[0]) * shapes[j].value(rule.point(q)[0]);
    };
    add_mass(dealii::QGaussLobatto<1>(n), 1 - consistent_part);
    add_mass(dealii::QGauss<1>(n), consistent_part);
  }
} // namespace myolines
