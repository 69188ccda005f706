// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle1d/muscle1d_system.h>

namespace myolines
{
  /// Lagrange polynomials on the Gauss-Lobatto nodes of an element of length h, and their integrals.
  struct Muscle1dSystem::Element
  {
    struct GaussPoint
    {
      double              weight; ///< [m]
      std::vector<double> slope;  ///< of the polynomials [1/m]
    };

    /// @p n_points Gauss points; @p density [kg/m], 0: no mass; @p consistent_part of the mass is integrated exactly, the rest on the nodes
    /// and hence diagonal.
    Element(unsigned int degree, double h, unsigned int n_points, double density, double consistent_part);

    static double sum(const GaussPoint &q, const double *values)
    {
      double result = 0;
      for (std::size_t i = 0; i < q.slope.size(); ++i)
        result += q.slope[i] * values[i];
      return result;
    }

    unsigned int                     n; ///< nodes
    double                           h; ///< [m]
    std::vector<GaussPoint>          points;
    std::vector<std::vector<double>> mass; ///< [kg]; empty: none
  };
} // namespace myolines
