// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace myolines
{
  /// Tensor-product Lagrange element of degree k on the unit cube with n Gauss points per direction, as plain tables.
  /// Nodes and points are numbered lexicographically, x fastest. With it comes the discontinuous space P_{k-1} of pressure
  /// and dilatation: Legendre products of total degree <= k-1, orthonormal on the unit cube.
  struct Element
  {
    Element(unsigned int degree, unsigned int n_points_1d); ///< @p degree k in 1..3, @p n_points_1d n in 2..6.

    int n_nodes_1d;  ///< k + 1
    int n_nodes;     ///< its cube
    int n_points_1d; ///< n
    int n_points;    ///< its cube
    int n_modes;     ///< dim P_{k-1}: 1, 4, 10 for k = 1, 2, 3

    std::vector<double> point;      ///< [n] Gauss points in (0, 1)
    std::vector<double> weight;     ///< [n] their weights
    std::vector<double> value;      ///< [n][k+1] shape functions at the points
    std::vector<double> derivative; ///< [n][k+1] their derivatives
    std::vector<double> modes;      ///< [n^3][n_modes]
    std::vector<double> weights_3d; ///< [n^3]
  };
} // namespace myolines
