// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

namespace myolines
{
  // Vectors and matrices of three dimensions for laws at a point, so that code and physics page look alike. Entries are double, Lanes or
  // Dual; what mixes two of them has the richer one. Everything is inlined, loops of three and nine are unrolled.

  /// A vector.
  template <typename T>
  struct Vec3
  {
    T entry[3]; ///< x, y, z

    ///@{
    /// Entry @p i, 0 to 2.
    MYOLINES_INLINE T       &operator[](const int i) { return entry[i]; }
    MYOLINES_INLINE const T &operator[](const int i) const { return entry[i]; }
    ///@}
  };

  /// Rows are current, columns reference directions where the matrix is a deformation gradient or a first Piola-Kirchhoff stress.
  template <typename T>
  struct Mat3
  {
    T entry[9]; ///< row by row

    ///@{
    /// Entry in row @p i and column @p j, 0 to 2.
    MYOLINES_INLINE T       &operator()(const int i, const int j) MYOLINES_INLINED { return entry[3 * i + j]; }
    MYOLINES_INLINE const T &operator()(const int i, const int j) const { return entry[3 * i + j]; }
    ///@}

    /// All entries zero.
    static MYOLINES_INLINE Mat3 zero()
    {
      return make([](int, int) MYOLINES_INLINED { return T(0.); });
    }
    /// From nine numbers, row by row.
    static MYOLINES_INLINE Mat3 load(const T *entries)
    {
      return make([&](const int i, const int j) MYOLINES_INLINED { return entries[3 * i + j]; });
    }

    /// Of entries f(i, j), written out: loops that the compiler does not unroll keep matrices in memory.
    template <typename Function>
    static MYOLINES_INLINE Mat3 make(const Function &f)
    {
      return {{f(0, 0), f(0, 1), f(0, 2), f(1, 0), f(1, 1), f(1, 2), f(2, 0), f(2, 1), f(2, 2)}};
    }
  };

  /// The matrix of entries f(i, j), with the type of these.
  template <typename Function>
  MYOLINES_INLINE auto make_matrix(const Function &f)
  {
    return Mat3<decltype(f(0, 0))>::make(f);
  }

  ///@{
  /// Sums and products of matrices and vectors.
  template <typename A, typename B>
  MYOLINES_INLINE auto operator+(const Mat3<A> &a, const Mat3<B> &b)
  {
    return make_matrix([&](const int i, const int j) MYOLINES_INLINED { return a(i, j) + b(i, j); });
  }
  template <typename A, typename B>
  MYOLINES_INLINE auto operator-(const Mat3<A> &a, const Mat3<B> &b)
  {
    return make_matrix([&](const int i, const int j) MYOLINES_INLINED { return a(i, j) - b(i, j); });
  }
  template <typename A, typename B>
  MYOLINES_INLINE auto operator*(const Mat3<A> &a, const Mat3<B> &b)
  {
    return make_matrix([&](const int i, const int j)
                           MYOLINES_INLINED { return a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j); });
  }
  template <typename A, typename B>
  MYOLINES_INLINE auto operator*(const Mat3<A> &a, const Vec3<B> &b)
  {
    const auto row = [&](const int i) MYOLINES_INLINED { return a(i, 0) * b[0] + a(i, 1) * b[1] + a(i, 2) * b[2]; };
    return Vec3<decltype(row(0))>{{row(0), row(1), row(2)}};
  }
  ///@}
  /// A number times a matrix.
  template <typename A, typename B>
  MYOLINES_INLINE auto operator*(const A &a, const Mat3<B> &b) -> Mat3<decltype(a * b(0, 0))>
  {
    return make_matrix([&](const int i, const int j) MYOLINES_INLINED { return a * b(i, j); });
  }

  /// A^T
  template <typename T>
  MYOLINES_INLINE Mat3<T> transpose(const Mat3<T> &a)
  {
    return make_matrix([&](const int i, const int j) MYOLINES_INLINED { return a(j, i); });
  }
  /// a + x I
  template <typename T, typename X>
  MYOLINES_INLINE Mat3<T> plus_identity(Mat3<T> a, const X &x)
  {
    a(0, 0) = a(0, 0) + x;
    a(1, 1) = a(1, 1) + x;
    a(2, 2) = a(2, 2) + x;
    return a;
  }
  /// tr A
  template <typename T>
  MYOLINES_INLINE T trace(const Mat3<T> &a)
  {
    return a(0, 0) + a(1, 1) + a(2, 2);
  }
  /// A : B
  template <typename A, typename B>
  MYOLINES_INLINE auto dot(const Mat3<A> &a, const Mat3<B> &b)
  {
    const auto row = [&](const int i) MYOLINES_INLINED { return a(i, 0) * b(i, 0) + a(i, 1) * b(i, 1) + a(i, 2) * b(i, 2); };
    return row(0) + row(1) + row(2);
  }
  /// a . b
  template <typename A, typename B>
  MYOLINES_INLINE auto dot(const Vec3<A> &a, const Vec3<B> &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  /// a (x) b
  template <typename A, typename B>
  MYOLINES_INLINE auto outer(const Vec3<A> &a, const Vec3<B> &b)
  {
    return make_matrix([&](const int i, const int j) MYOLINES_INLINED { return a[i] * b[j]; });
  }
  /// d det A / dA
  template <typename T>
  MYOLINES_INLINE Mat3<T> cofactor(const Mat3<T> &a)
  {
    return make_matrix([&](const int i, const int j) MYOLINES_INLINED {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      return a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    });
  }
} // namespace myolines
