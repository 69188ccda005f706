#pragma once

namespace myolines
{
  /// Instruction sets that kernels are compiled for; one is chosen when the program starts.
  enum class InstructionSet
  {
    baseline, ///< what every x86-64 (or other) processor has
    avx2,
    avx512
  };

  /// Cells that a kernel treats at once, one per lane.
  constexpr int n_lanes = 8;

#define MYOLINES_INLINE inline __attribute__((always_inline))

  /// One double per lane. The tag makes every function that takes a Lanes a different function for each instruction
  /// set, so the linker can never put a wide copy of one into a program running on a narrow processor.
  template <InstructionSet isa>
  struct Lanes
  {
    typedef double    Vec __attribute__((vector_size(n_lanes * sizeof(double))));
    typedef long long Mask __attribute__((vector_size(n_lanes * sizeof(double))));
    Vec               v;

    MYOLINES_INLINE Lanes() {} // uninitialised, like a double
    MYOLINES_INLINE Lanes(const double x)
      : v(Vec{} + x)
    {}
    MYOLINES_INLINE explicit Lanes(const Vec &x)
      : v(x)
    {}
    MYOLINES_INLINE double operator[](const int lane) const { return v[lane]; }
    MYOLINES_INLINE void   set(const int lane, const double x) { v[lane] = x; }

    MYOLINES_INLINE Lanes &operator+=(const Lanes &b)
    {
      v += b.v;
      return *this;
    }
    MYOLINES_INLINE Lanes &operator-=(const Lanes &b)
    {
      v -= b.v;
      return *this;
    }
    MYOLINES_INLINE Lanes &operator*=(const Lanes &b)
    {
      v *= b.v;
      return *this;
    }

    friend MYOLINES_INLINE Lanes operator+(const Lanes &a, const Lanes &b) { return Lanes(Vec(a.v + b.v)); }
    friend MYOLINES_INLINE Lanes operator-(const Lanes &a, const Lanes &b) { return Lanes(Vec(a.v - b.v)); }
    friend MYOLINES_INLINE Lanes operator*(const Lanes &a, const Lanes &b) { return Lanes(Vec(a.v * b.v)); }
    friend MYOLINES_INLINE Lanes operator/(const Lanes &a, const Lanes &b) { return Lanes(Vec(a.v / b.v)); }
    friend MYOLINES_INLINE Lanes operator-(const Lanes &a) { return Lanes(Vec(-a.v)); }
    friend MYOLINES_INLINE Mask  operator<(const Lanes &a, const Lanes &b) { return a.v < b.v; }
    friend MYOLINES_INLINE Mask  operator<=(const Lanes &a, const Lanes &b) { return a.v <= b.v; }
    friend MYOLINES_INLINE Mask  operator>(const Lanes &a, const Lanes &b) { return a.v > b.v; }

    friend MYOLINES_INLINE Lanes select(const Mask &where, const Lanes &yes, const Lanes &no) { return Lanes(Vec(where ? yes.v : no.v)); }
    friend MYOLINES_INLINE Lanes sqrt(const Lanes &x) { return x.map(__builtin_sqrt); }
    friend MYOLINES_INLINE Lanes cbrt(const Lanes &x) { return x.map(__builtin_cbrt); }
    friend MYOLINES_INLINE Lanes sin(const Lanes &x) { return x.map(__builtin_sin); }
    friend MYOLINES_INLINE Lanes cos(const Lanes &x) { return x.map(__builtin_cos); }

  private:
    template <typename Function>
    MYOLINES_INLINE Lanes map(const Function &f) const
    {
      Lanes y;
      for (int lane = 0; lane < n_lanes; ++lane)
        y.v[lane] = f(v[lane]);
      return y;
    }
  };

  // The same vocabulary for a plain double, so that pointwise laws are written once.
  MYOLINES_INLINE double select(const bool where, const double yes, const double no) { return where ? yes : no; }
  MYOLINES_INLINE double sqrt(const double x) { return __builtin_sqrt(x); }
  MYOLINES_INLINE double cbrt(const double x) { return __builtin_cbrt(x); }
  MYOLINES_INLINE double sin(const double x) { return __builtin_sin(x); }
  MYOLINES_INLINE double cos(const double x) { return __builtin_cos(x); }
} // namespace myolines
