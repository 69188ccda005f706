// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <type_traits>

namespace myolines
{
  /// Instruction sets that kernels are compiled for; one is chosen when the program starts.
  enum class InstructionSet
  {
    baseline, ///< what every x86-64 (or other) processor has
    avx2,     ///< 256 bits, 4 doubles
    avx512    ///< 512 bits, 8 doubles
  };

  /// The widest instruction set of this processor that kernels are compiled for.
  InstructionSet widest_instruction_set();

  const char *name(InstructionSet instruction_set); ///< "baseline", "AVX2", "AVX-512"

  /// Cells (or other equal things) that a kernel treats at once, one per lane.
  constexpr int n_lanes = 8;

#define MYOLINES_INLINE inline __attribute__((always_inline))
#define MYOLINES_INLINED __attribute__((always_inline)) // of a lambda

  /// One number per lane, as vectors of the width that the instruction set has. The tag makes every function that takes a
  /// Lanes a different function for each instruction set, so the linker can never put a wide copy of one into a program
  /// running on a narrow processor. Fewer lanes than n_lanes, such as those of one vector, suit what has many numbers at once.
  template <InstructionSet isa, typename Real = double, int n = n_lanes>
  struct Lanes
  {
    static constexpr int size = n; ///< numbers
    /// of a register of the instruction set
    static constexpr int bytes   = isa == InstructionSet::avx512 ? 64 : isa == InstructionSet::avx2 ? 32 : 16;
    static constexpr int width   = bytes / sizeof(Real) < n ? bytes / sizeof(Real) : n; ///< numbers in one register
    static constexpr int n_parts = n / width;                                           ///< registers for all numbers
    typedef Real         Vec __attribute__((vector_size(width * sizeof(Real))));        ///< One register of numbers.
    typedef float        Narrow __attribute__((vector_size(width * sizeof(float))));    ///< As many numbers in single precision.
    using Integer = std::conditional_t<sizeof(Real) == 8, long, int>;                   ///< The integer as wide as a Real.
    typedef Integer Bits __attribute__((vector_size(width * sizeof(Real)))); ///< One register of truth values: all bits set, or none.
    /// The result of a comparison, lane by lane.
    struct Mask
    {
      Bits part[n_parts]; ///< the lanes, in registers
    };
    Vec part[n_parts]; ///< the lanes, in registers

    MYOLINES_INLINE Lanes() {} ///< uninitialised, like a double
    /// The same number in every lane.
    MYOLINES_INLINE Lanes(const Real x)
    {
      for (int p = 0; p < n_parts; ++p)
        part[p] = Vec{} + x;
    }
    MYOLINES_INLINE Real operator[](const int lane) const { return part[lane / width][lane % width]; } ///< The number of a lane.
    MYOLINES_INLINE void set(const int lane, const Real x) { part[lane / width][lane % width] = x; }   ///< Puts a number into a lane.

    /// Of numbers in single precision, one per lane.
    static MYOLINES_INLINE Lanes widened(const float *from)
    {
      return each([&](const int p) {
        Narrow x;
        __builtin_memcpy(&x, from + p * width, sizeof(x));
        return __builtin_convertvector(x, Vec);
      });
    }
    /// Writes them rounded to single precision.
    MYOLINES_INLINE void round_to(float *to) const
    {
      for (int p = 0; p < n_parts; ++p)
        {
          const Narrow x = __builtin_convertvector(part[p], Narrow);
          __builtin_memcpy(to + p * width, &x, sizeof(x));
        }
    }

    ///@{
    /// Arithmetic and comparisons, lane by lane.
    MYOLINES_INLINE Lanes &operator+=(const Lanes &b) { return *this = *this + b; }
    MYOLINES_INLINE Lanes &operator-=(const Lanes &b) { return *this = *this - b; }
    MYOLINES_INLINE Lanes &operator*=(const Lanes &b) { return *this = *this * b; }

    friend MYOLINES_INLINE Lanes operator+(const Lanes &a, const Lanes &b)
    {
      return each([&](const int p) { return a.part[p] + b.part[p]; });
    }
    friend MYOLINES_INLINE Lanes operator-(const Lanes &a, const Lanes &b)
    {
      return each([&](const int p) { return a.part[p] - b.part[p]; });
    }
    friend MYOLINES_INLINE Lanes operator*(const Lanes &a, const Lanes &b)
    {
      return each([&](const int p) { return a.part[p] * b.part[p]; });
    }
    friend MYOLINES_INLINE Lanes operator/(const Lanes &a, const Lanes &b)
    {
      return each([&](const int p) { return a.part[p] / b.part[p]; });
    }
    friend MYOLINES_INLINE Lanes operator-(const Lanes &a)
    {
      return each([&](const int p) { return -a.part[p]; });
    }
    friend MYOLINES_INLINE Mask operator<(const Lanes &a, const Lanes &b)
    {
      return compare([&](const int p) { return a.part[p] < b.part[p]; });
    }
    friend MYOLINES_INLINE Mask operator<=(const Lanes &a, const Lanes &b)
    {
      return compare([&](const int p) { return a.part[p] <= b.part[p]; });
    }
    friend MYOLINES_INLINE Mask operator>(const Lanes &a, const Lanes &b) { return b < a; }
    ///@}

    /// Lane by lane @p yes where the mask is set, else @p no. Both are evaluated.
    friend MYOLINES_INLINE Lanes select(const Mask &where, const Lanes &yes, const Lanes &no)
    {
      return each([&](const int p) { return where.part[p] ? yes.part[p] : no.part[p]; });
    }
    ///@{
    /// As of a double, lane by lane.
    friend MYOLINES_INLINE Lanes sqrt(const Lanes &x) { return x.map(__builtin_sqrt); }
    friend MYOLINES_INLINE Lanes exp(const Lanes &x) { return x.map(__builtin_exp); }
    friend MYOLINES_INLINE Lanes log(const Lanes &x) { return x.map(__builtin_log); }
    friend MYOLINES_INLINE Lanes sin(const Lanes &x) { return x.map(__builtin_sin); }
    friend MYOLINES_INLINE Lanes cos(const Lanes &x) { return x.map(__builtin_cos); }
    ///@}

    /// The cube root of finite numbers [-], to two units of its last digit, all lanes at once: a third of the bits of a number, exponent
    /// and all, is the root to 7 %, and Halley's iteration leaves two thirds of the cube of an error.
    friend MYOLINES_INLINE Lanes cbrt(const Lanes &x)
    {
      constexpr Real bias = sizeof(Real) == 8 ? 3071454945866678272. : 710235477.; // two thirds of the bits of 1
      return each([&](const int p) {
        const Vec size = x.part[p] < 0 ? -x.part[p] : x.part[p];
        Bits      bits;
        __builtin_memcpy(&bits, &size, sizeof(bits));
        bits = __builtin_convertvector(__builtin_convertvector(bits, Vec) / 3 + bias, Bits);
        Vec y;
        __builtin_memcpy(&y, &bits, sizeof(y));
        for (int k = 0; k < 3; ++k)
          {
            const Vec cube = y * y * y;
            y *= (cube + 2 * size) / (2 * cube + size);
          }
        return size == 0 ? x.part[p] : x.part[p] < 0 ? -y : y;
      });
    }

    /// f of a double, lane by lane; f is no inline function, which would be compiled for a wide instruction set only.
    template <typename Function>
    friend MYOLINES_INLINE Lanes each_lane(const Lanes &x, const Function &f)
    {
      return x.map(f);
    }

  private:
    template <typename Function>
    static MYOLINES_INLINE Lanes each(const Function &f)
    {
      Lanes y;
      for (int p = 0; p < n_parts; ++p)
        y.part[p] = f(p);
      return y;
    }
    template <typename Function>
    static MYOLINES_INLINE Mask compare(const Function &f)
    {
      Mask y;
      for (int p = 0; p < n_parts; ++p)
        y.part[p] = f(p);
      return y;
    }
    template <typename Function>
    MYOLINES_INLINE Lanes map(const Function &f) const
    {
      Lanes y;
      for (int lane = 0; lane < n; ++lane)
        y.set(lane, f((*this)[lane]));
      return y;
    }
  };

  // The same vocabulary for a plain double, so that pointwise laws are written once.
  ///@{
  /// The same vocabulary for a plain double, so that pointwise laws are written once.
  MYOLINES_INLINE double select(const bool where, const double yes, const double no) { return where ? yes : no; }
  MYOLINES_INLINE double sqrt(const double x) { return __builtin_sqrt(x); }
  MYOLINES_INLINE double cbrt(const double x) { return __builtin_cbrt(x); }
  MYOLINES_INLINE double exp(const double x) { return __builtin_exp(x); }
  MYOLINES_INLINE double log(const double x) { return __builtin_log(x); }
  MYOLINES_INLINE double sin(const double x) { return __builtin_sin(x); }
  MYOLINES_INLINE double cos(const double x) { return __builtin_cos(x); }
  ///@}
} // namespace myolines
