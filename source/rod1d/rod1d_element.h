// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/rod1d/rod1d_system.h>

#include <array>

namespace myolines
{
  /// Lagrange polynomials on equidistant nodes of [0, 1] and their integrals, for elements of length h.
  struct Rod1dSystem::Element
  {
    static constexpr unsigned int largest = 4; ///< nodes, and Gauss points

    Element(unsigned int degree, double h, double mass_per_length);

    struct GaussPoint
    {
      double                      weight; ///< on [0, 1]
      std::array<double, largest> slope;  ///< of the polynomials, in 1/m
    };

    unsigned int                                     n; ///< nodes = Gauss points = degree + 1
    double                                           h;
    std::vector<GaussPoint>                          points;
    std::array<std::array<double, largest>, largest> mass; ///< [kg]

    /// Polynomial @p a and its derivative with respect to the coordinate @p s in [0, 1].
    double shape(unsigned int a, double s) const;
    double shape_derivative(unsigned int a, double s) const;
  };
} // namespace myolines
