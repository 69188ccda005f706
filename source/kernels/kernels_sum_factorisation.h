// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/kernels/kernels.h>

#include <type_traits>

namespace myolines
{
  // Tensor-product interpolation between the nodes of a cell and its Gauss points, one direction after the other.
  // n1 nodes and n points per direction; x runs fastest everywhere. T is Lanes.
  //
  // As N_ijk(x, y, z) = N_i(x) N_j(y) N_k(z), sums over the three indices are done in turn: about n1^3 n + n1^2 n^2 + n1 n^3 products for a
  // field in place of n1^3 n^3, a quarter of them for degree 2 with four points.

  constexpr int max_points_1d = 6;

  /// sum(number of points per direction) with a constant where it is that of the nodes, so that loops over points are unrolled.
  template <int n1, typename Sum>
  MYOLINES_INLINE void with_points(const KernelTables &t, const Sum &sum)
  {
    if (t.n_points_1d == n1)
      sum(std::integral_constant<int, n1>());
    else
      sum(t.n_points_1d);
  }

  /// value[q] += sum_i N_i(q) u_i (if wanted), gradient[A][q] = sum_i dN_i/dxi_A(q) u_i (if wanted).
  template <int n1, typename T, typename Points>
  MYOLINES_INLINE void interpolate(const KernelTables &t, const Points points, const T *u, T *value, T *gradient)
  {
    const int n = points, nq = n * n * n;
    T         x_value[max_points_1d * n1 * n1], x_slope[max_points_1d * n1 * n1];
    for (int jk = 0; jk < n1 * n1; ++jk)
      for (int q = 0; q < n; ++q)
        {
          T v(0.), d(0.);
          for (int i = 0; i < n1; ++i)
            {
              v += T(t.value[q * n1 + i]) * u[jk * n1 + i];
              d += T(t.derivative[q * n1 + i]) * u[jk * n1 + i];
            }
          x_value[jk * n + q] = v;
          x_slope[jk * n + q] = d;
        }
    // The letters tell what x and y have contributed: v a value, d a slope. There is no dd, as no derivative is by both.
    T vv[max_points_1d * max_points_1d * n1], dv[max_points_1d * max_points_1d * n1], vd[max_points_1d * max_points_1d * n1];
    for (int k = 0; k < n1; ++k)
      for (int q = 0; q < n; ++q)
        for (int p = 0; p < n; ++p)
          {
            T a(0.), b(0.), c(0.);
            for (int j = 0; j < n1; ++j)
              {
                const T  N(t.value[q * n1 + j]), D(t.derivative[q * n1 + j]);
                const T &v = x_value[(k * n1 + j) * n + p];
                a += N * v;
                b += N * x_slope[(k * n1 + j) * n + p];
                c += D * v;
              }
            const int at = (k * n + q) * n + p;
            vv[at]       = a;
            dv[at]       = b;
            vd[at]       = c;
          }
    for (int r = 0; r < n; ++r)
      for (int pq = 0; pq < n * n; ++pq)
        {
          T v(0.), gx(0.), gy(0.), gz(0.);
          for (int k = 0; k < n1; ++k)
            {
              const T  N(t.value[r * n1 + k]), D(t.derivative[r * n1 + k]);
              const T &w = vv[k * n * n + pq];
              v += N * w;
              gz += D * w;
              gx += N * dv[k * n * n + pq];
              gy += N * vd[k * n * n + pq];
            }
          const int q = r * n * n + pq;
          if (value)
            value[q] = v;
          if (gradient)
            {
              gradient[q]          = gx;
              gradient[nq + q]     = gy;
              gradient[2 * nq + q] = gz;
            }
        }
  }

  template <int n1, typename T>
  void interpolate(const KernelTables &t, const T *u, T *value, T *gradient)
  {
    with_points<n1>(t, [&](const auto points) MYOLINES_INLINED { interpolate<n1>(t, points, u, value, gradient); });
  }

  /// The transpose: u_i += sum_q N_i(q) value[q] (if given) + sum_A dN_i/dxi_A(q) gradient[A][q] (if given).
  template <int n1, typename T, typename Points>
  MYOLINES_INLINE void integrate(const KernelTables &t, const Points points, const T *value, const T *gradient, T *u)
  {
    // The loops of interpolate() backwards: z first, x last.
    const int n = points, nq = n * n * n;
    T         vv[max_points_1d * max_points_1d * n1], dv[max_points_1d * max_points_1d * n1], vd[max_points_1d * max_points_1d * n1];
    for (int k = 0; k < n1; ++k)
      for (int pq = 0; pq < n * n; ++pq)
        {
          T a(0.), b(0.), c(0.);
          for (int r = 0; r < n; ++r)
            {
              const T   N(t.value[r * n1 + k]);
              const int q = r * n * n + pq;
              if (value)
                a += N * value[q];
              if (gradient)
                {
                  a += T(t.derivative[r * n1 + k]) * gradient[2 * nq + q];
                  b += N * gradient[q];
                  c += N * gradient[nq + q];
                }
            }
          vv[k * n * n + pq] = a;
          dv[k * n * n + pq] = b;
          vd[k * n * n + pq] = c;
        }
    T x_value[max_points_1d * n1 * n1], x_slope[max_points_1d * n1 * n1];
    for (int k = 0; k < n1; ++k)
      for (int j = 0; j < n1; ++j)
        for (int p = 0; p < n; ++p)
          {
            T v(0.), d(0.);
            for (int q = 0; q < n; ++q)
              {
                const int at = (k * n + q) * n + p;
                v += T(t.value[q * n1 + j]) * vv[at] + T(t.derivative[q * n1 + j]) * vd[at];
                d += T(t.value[q * n1 + j]) * dv[at];
              }
            x_value[(k * n1 + j) * n + p] = v;
            x_slope[(k * n1 + j) * n + p] = d;
          }
    for (int jk = 0; jk < n1 * n1; ++jk)
      for (int i = 0; i < n1; ++i)
        {
          T s(0.);
          for (int p = 0; p < n; ++p)
            s += T(t.value[p * n1 + i]) * x_value[jk * n + p] + T(t.derivative[p * n1 + i]) * x_slope[jk * n + p];
          u[jk * n1 + i] += s;
        }
  }

  template <int n1, typename T>
  void integrate(const KernelTables &t, const T *value, const T *gradient, T *u)
  {
    with_points<n1>(t, [&](const auto points) MYOLINES_INLINED { integrate<n1>(t, points, value, gradient, u); });
  }

  /// matrix[i][j] += sum_q sum_AB dN_i/dxi_A(q) c[3 A + B][q] dN_j/dxi_B(q) + sum_q N_i m[q] N_j (if m given): all pairs of
  /// nodes at once, one direction after the other. Coefficient field A, B of point q stands at c[(3 A + B) * stride + q].
  template <int n1, typename T>
  void integrate_pairs(const KernelTables &t, const T *c, const int stride, const T *m, T *matrix)
  {
    constexpr int pairs = n1 * n1;
    const int     n     = t.n_points_1d;
    // Four kinds of factors per direction: value/slope on the side of i and of j. kind = 2 * (slope of i) + (slope of j).
    double factor[4][max_points_1d][pairs];
    for (int q = 0; q < n; ++q)
      for (int i = 0; i < n1; ++i)
        for (int j = 0; j < n1; ++j)
          {
            const double vi = t.value[q * n1 + i], vj = t.value[q * n1 + j], di = t.derivative[q * n1 + i], dj = t.derivative[q * n1 + j];
            factor[0][q][i * n1 + j] = vi * vj;
            factor[1][q][i * n1 + j] = vi * dj;
            factor[2][q][i * n1 + j] = di * vj;
            factor[3][q][i * n1 + j] = di * dj;
          }
    const auto kind = [](const int A, const int B, const int direction) { return 2 * (A == direction) + (B == direction); };

    for (int r = 0; r < n; ++r) // one z-plane of points at a time: its sums stay in cache
      {
        T plane[4][pairs * pairs]; // by kind in z: [pair y][pair x]
        for (int z = 0; z < 4; ++z)
          for (int p = 0; p < pairs * pairs; ++p)
            plane[z][p] = T(0.);
        for (int q = 0; q < n; ++q)
          {
            const int  first    = (r * n + q) * n;
            const auto add_line = [&](const T *field, const int kx, const int ky, const int kz) {
              T line[pairs];
              for (int p = 0; p < pairs; ++p)
                line[p] = T(0.);
              for (int s = 0; s < n; ++s)
                for (int p = 0; p < pairs; ++p)
                  line[p] += field[first + s] * T(factor[kx][s][p]);
              for (int y = 0; y < pairs; ++y)
                for (int p = 0; p < pairs; ++p)
                  plane[kz][y * pairs + p] += T(factor[ky][q][y]) * line[p];
            };
            for (int A = 0; c && A < 3; ++A)
              for (int B = 0; B < 3; ++B)
                add_line(c + (3 * A + B) * stride, kind(A, B, 0), kind(A, B, 1), kind(A, B, 2));
            if (m)
              add_line(m, 0, 0, 0);
          }
        for (int iz = 0; iz < n1; ++iz)
          for (int jz = 0; jz < n1; ++jz)
            {
              const int pz = iz * n1 + jz;
              const T   f0(factor[0][r][pz]), f1(factor[1][r][pz]), f2(factor[2][r][pz]), f3(factor[3][r][pz]);
              for (int iy = 0; iy < n1; ++iy)
                for (int jy = 0; jy < n1; ++jy)
                  for (int ix = 0; ix < n1; ++ix)
                    for (int jx = 0; jx < n1; ++jx)
                      {
                        const int p = (iy * n1 + jy) * pairs + ix * n1 + jx;
                        const int i = (iz * n1 + iy) * n1 + ix, j = (jz * n1 + jy) * n1 + jx;
                        matrix[i * n1 * n1 * n1 + j] += f0 * plane[0][p] + f1 * plane[1][p] + f2 * plane[2][p] + f3 * plane[3][p];
                      }
            }
      }
  }
} // namespace myolines
