// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/band_matrix.h>
#include <myolines/system/sampled.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace myolines
{
  /// With Q^T x the second differences and R the matrix of hat functions of the inner samples, the curvatures there solve
  /// (R + p Q^T Q) c = Q^T x, and the values are x - p Q c.
  std::vector<double> spline_filtered(const std::vector<double> &t, const std::vector<double> &x, const double cut_off)
  {
    const unsigned int n = t.size();
    if (n < 3)
      return x;
    const double        p = (n - 1) / ((t.back() - t.front()) * std::pow(2 * M_PI * cut_off, 4));
    std::vector<double> h(n - 1);
    for (unsigned int i = 0; i + 1 < n; ++i)
      h[i] = t[i + 1] - t[i];

    // row i of Q^T has the entries q[i][0..2] at i, i + 1, i + 2
    const unsigned int                 inner = n - 2;
    std::vector<std::array<double, 3>> q(inner);
    for (unsigned int i = 0; i < inner; ++i)
      q[i] = {{1 / h[i], -1 / h[i] - 1 / h[i + 1], 1 / h[i + 1]}};

    const unsigned int  width = std::min(2u, inner - 1);
    BandMatrix          matrix(inner, width);
    std::vector<double> c(inner);
    matrix.clear();
    for (unsigned int i = 0; i < inner; ++i)
      {
        c[i] = q[i][0] * x[i] + q[i][1] * x[i + 1] + q[i][2] * x[i + 2];
        for (unsigned int j = i < width ? 0 : i - width; j < std::min(inner, i + width + 1); ++j)
          {
            double sum = i == j ? (h[i] + h[i + 1]) / 3 : i + 1 == j ? h[j] / 6 : j + 1 == i ? h[i] / 6 : 0;
            for (unsigned int k = std::max(i, j); k < std::min(i, j) + 3; ++k)
              sum += p * q[i][k - i] * q[j][k - j];
            matrix(i, j) = sum;
          }
      }
    if (!matrix.factorise())
      throw std::logic_error("the matrix of a smoothing spline is singular");
    matrix.solve(c.data());

    std::vector<double> filtered = x;
    for (unsigned int i = 0; i < inner; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        filtered[i + k] -= p * q[i][k] * c[i];
    return filtered;
  }
} // namespace myolines
