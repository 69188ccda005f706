// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

#include <type_traits>

namespace myolines
{
#define MYOLINES_UNROLLED _Pragma("GCC unroll 9")

  /// A number and its derivatives along n directions: forward differentiation. T is double or Lanes. What does not depend on the directions
  /// (numbers, T) may stand beside it in every operation and costs no derivative.
  template <typename T, int n = 1>
  struct Dual
  {
    T value;    ///< of the function
    T slope[n]; ///< its derivatives along the directions

    MYOLINES_INLINE Dual() {} // uninitialised, like a double
    /// A constant: no slopes.
    template <typename C, typename = std::enable_if_t<std::is_convertible_v<C, T>>>
    MYOLINES_INLINE Dual(const C &constant)
      : value(constant)
    {
      MYOLINES_UNROLLED for (int k = 0; k < n; ++k) slope[k] = T(0.);
    }
    /// Value @p f, and @p df times the slopes of @p x: a function of x.
    MYOLINES_INLINE Dual(const T &f, const T &df, const Dual &x)
      : value(f)
    {
      MYOLINES_UNROLLED for (int k = 0; k < n; ++k) slope[k] = df * x.slope[k];
    }

    ///@{
    /// Arithmetic by the rules of differentiation.
    MYOLINES_INLINE Dual &operator+=(const Dual &b) { return *this = *this + b; }
    MYOLINES_INLINE Dual &operator-=(const Dual &b) { return *this = *this - b; }

    friend MYOLINES_INLINE Dual operator+(const Dual &a, const Dual &b)
    {
      return each(a.value + b.value, [&](const int k) MYOLINES_INLINED { return a.slope[k] + b.slope[k]; });
    }
    friend MYOLINES_INLINE Dual operator-(const Dual &a, const Dual &b)
    {
      return each(a.value - b.value, [&](const int k) MYOLINES_INLINED { return a.slope[k] - b.slope[k]; });
    }
    friend MYOLINES_INLINE Dual operator*(const Dual &a, const Dual &b)
    {
      return each(a.value * b.value, [&](const int k) MYOLINES_INLINED { return a.slope[k] * b.value + a.value * b.slope[k]; });
    }
    friend MYOLINES_INLINE Dual operator/(const Dual &a, const Dual &b)
    {
      const T inverse = T(1.) / b.value, ratio = a.value * inverse;
      return each(ratio, [&](const int k) MYOLINES_INLINED { return (a.slope[k] - ratio * b.slope[k]) * inverse; });
    }
    friend MYOLINES_INLINE Dual operator-(const Dual &a)
    {
      return each(-a.value, [&](const int k) MYOLINES_INLINED { return -a.slope[k]; });
    }
    ///@}

    template <typename C>
    using IfConstant = std::enable_if_t<std::is_convertible_v<C, T>>; ///< For operands that do not depend on the directions.
    ///@{
    /// The same with such operands.
    template <typename C, typename = IfConstant<C>>
    friend MYOLINES_INLINE Dual operator+(const C &c, const Dual &x)
    {
      return each(T(c) + x.value, [&](const int k) MYOLINES_INLINED { return x.slope[k]; });
    }
    template <typename C, typename = IfConstant<C>>
    friend MYOLINES_INLINE Dual operator+(const Dual &x, const C &c)
    {
      return c + x;
    }
    template <typename C, typename = IfConstant<C>>
    friend MYOLINES_INLINE Dual operator-(const Dual &x, const C &c)
    {
      return each(x.value - T(c), [&](const int k) MYOLINES_INLINED { return x.slope[k]; });
    }
    template <typename C, typename = IfConstant<C>>
    friend MYOLINES_INLINE Dual operator*(const C &c, const Dual &x)
    {
      return Dual(T(c) * x.value, T(c), x);
    }
    template <typename C, typename = IfConstant<C>>
    friend MYOLINES_INLINE Dual operator*(const Dual &x, const C &c)
    {
      return c * x;
    }
    template <typename C, typename = IfConstant<C>>
    friend MYOLINES_INLINE Dual operator/(const C &c, const Dual &x)
    {
      const T inverse = T(1.) / x.value, f = T(c) * inverse;
      return Dual(f, -f * inverse, x);
    }
    ///@}

    ///@{
    /// Functions by the chain rule.
    friend MYOLINES_INLINE Dual sqrt(const Dual &x)
    {
      const T f = sqrt(x.value);
      return Dual(f, T(0.5) / f, x);
    }
    friend MYOLINES_INLINE Dual cbrt(const Dual &x)
    {
      const T f = cbrt(x.value);
      return Dual(f, T(1. / 3.) * f / x.value, x);
    }
    friend MYOLINES_INLINE Dual exp(const Dual &x)
    {
      const T f = exp(x.value);
      return Dual(f, f, x);
    }
    ///@}

  private:
    template <typename Slope>
    static MYOLINES_INLINE Dual each(const T &value, const Slope &slope)
    {
      Dual y;
      y.value                                                  = value;
      MYOLINES_UNROLLED for (int k = 0; k < n; ++k) y.slope[k] = slope(k);
      return y;
    }
  };
} // namespace myolines
