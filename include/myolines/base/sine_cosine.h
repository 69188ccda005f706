// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

namespace myolines
{
  /// Taylor coefficients up to degree 22.
  struct TaylorCoefficients
  {
    double of[23]; ///< of x^n: those of cos x where n is even, of sin x where it is odd

    constexpr TaylorCoefficients()
      : of{1, 1}
    {
      for (int n = 2; n < 23; ++n)
        of[n] = -of[n - 2] / ((n - 1) * n);
    }
  };

  /// Of one angle.
  template <typename T>
  struct SineCosine
  {
    T sine;   ///< [-]
    T cosine; ///< [-]
  };

  ///@{
  /// Whether T is Lanes of floats.
  template <typename T>
  constexpr bool in_single_precision = false;
  template <InstructionSet isa, int n>
  constexpr bool in_single_precision<Lanes<isa, float, n>> = true;
  ///@}

  /// Of x [rad], at most 1e5 in size, to 4e-16 (in single precision at most 100, to 3e-7): x is brought to [-pi/2, pi/2] by a multiple of
  /// pi, where Taylor polynomials of degree 21 and 22 are exact to rounding. T is double or Lanes; all lanes are found at once, while sin()
  /// and cos() of Lanes are found one by one.
  template <typename T>
  MYOLINES_INLINE SineCosine<T> sine_and_cosine(const T &x)
  {
    constexpr TaylorCoefficients c;
    constexpr bool               single = in_single_precision<T>;
    constexpr double             rounding =
        single ? 12582912. : 6755399441055744.; // 1.5 * 2^23 or 2^52: added and taken away, it rounds to a whole number
    // The first part of pi is short, so that its product with a whole number is exact.
    constexpr double pi_first = single ? 3.140625 : 3.1415926534682512, pi_rest = single ? 9.67653589793e-4 : 1.2154201013012385e-10;
    constexpr double per_pi = 0.318309886183790672;

    const T multiple = (x * T(per_pi) + T(rounding)) - T(rounding);
    const T half     = (multiple * T(0.5) + T(rounding)) - T(rounding);
    const T odd      = multiple - T(2.) * half; // -1, 0 or 1
    const T sign     = T(1.) - T(2.) * odd * odd;
    const T r        = (x - multiple * T(pi_first)) - multiple * T(pi_rest);
    const T square   = r * r;
    T       sine(c.of[21]), cosine(c.of[22]);
    for (int n = 20; n >= 0; n -= 2)
      {
        cosine = cosine * square + T(c.of[n]);
        if (n > 0)
          sine = sine * square + T(c.of[n - 1]);
      }
    return {sign * r * sine, sign * cosine};
  }
} // namespace myolines
