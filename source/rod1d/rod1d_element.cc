// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rod1d_element.h"

#include <deal.II/base/quadrature_lib.h>

namespace myolines
{
  Rod1dSystem::Element::Element(const unsigned int degree, const double length, const double mass_per_length)
    : n(degree + 1)
    , h(length)
    , mass{}
  {
    const dealii::QGauss<1> gauss(n);
    for (unsigned int q = 0; q < n; ++q)
      {
        const double s = gauss.point(q)[0];
        GaussPoint   point{gauss.weight(q), {}};
        for (unsigned int a = 0; a < n; ++a)
          {
            point.slope[a] = shape_derivative(a, s) / h;
            for (unsigned int b = 0; b < n; ++b)
              mass[a][b] += mass_per_length * h * point.weight * shape(a, s) * shape(b, s);
          }
        points.push_back(point);
      }
  }

  double Rod1dSystem::Element::shape(const unsigned int a, const double s) const
  {
    double value = 1;
    for (unsigned int b = 0; b < n; ++b)
      if (b != a)
        value *= (s * (n - 1) - b) / (static_cast<double>(a) - b);
    return value;
  }

  double Rod1dSystem::Element::shape_derivative(const unsigned int a, const double s) const
  {
    double sum = 0;
    for (unsigned int c = 0; c < n; ++c)
      {
        if (c == a)
          continue;
        double product = (n - 1) / (static_cast<double>(a) - c);
        for (unsigned int b = 0; b < n; ++b)
          if (b != a && b != c)
            product *= (s * (n - 1) - b) / (static_cast<double>(a) - b);
        sum += product;
      }
    return sum;
  }
} // namespace myolines
