// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

#if defined(__F16C__)
#  include <immintrin.h>
#endif

namespace myolines
{
  /// Dense kernels on n_lanes symmetric matrices at once, lower triangles row by row, entries interleaved by lane. Plain
  /// code only: compiled for several instruction sets.
  struct PatchKernels
  {
    unsigned int entry_size; ///< bytes of an entry of a packed factor: 2 where the instruction set converts half precision, else 4

    /// Replaces n x n matrices A by the lower triangular X with A^(-1) = X^T X, and fills @p sums with the row sums of |A|; @p scratch
    /// holds n lanes. Returns the bits of the lanes whose matrix is not positive definite; what those hold then is of no use.
    unsigned int (*factorise)(int n, double *matrix, double *sums, double *scratch);

    /// Row i of the packed factor is that of X, scaled so that its largest entry uses the range of the format; weights[i] is what the
    /// square of that costs.
    void (*pack)(int n, const double *factor, void *packed, float *weights);

    /// y = X^T X x.
    void (*multiply)(int n, const void *packed, const float *weights, const float *x, float *y);
  };

  /// How entries of packed factors are stored.
  template <InstructionSet isa>
  struct PackedEntry
  {
#if defined(__F16C__)
    using Number = unsigned short;
    static MYOLINES_INLINE Lanes<isa, float> load(const Number *from)
    {
      Lanes<isa, float> x;
      static_assert(Lanes<isa, float>::n_parts == 1, "one conversion fills all lanes");
      const __m256 wide = _mm256_cvtph_ps(_mm_load_si128(reinterpret_cast<const __m128i *>(from)));
      x.part[0]         = wide;
      return x;
    }
    static void store(const float *x, Number *to)
    {
      _mm_store_si128(reinterpret_cast<__m128i *>(to), _mm256_cvtps_ph(_mm256_loadu_ps(x), _MM_FROUND_TO_NEAREST_INT));
    }
#else
    using Number = float;
    static MYOLINES_INLINE Lanes<isa, float> load(const Number *from) { return *reinterpret_cast<const Lanes<isa, float> *>(from); }
    static void                              store(const float *x, Number *to)
    {
      for (int lane = 0; lane < n_lanes; ++lane)
        to[lane] = x[lane];
    }
#endif
  };

  template <InstructionSet isa>
  struct PatchWork
  {
    using Packed = PackedEntry<isa>;

    static constexpr int start(const int row) { return row * (row + 1) / 2; }

    /// y = X^T W X x with the first n rows of X, W the diagonal of the weights; returns the sum of (X x)^2. Four rows at a time: an entry
    /// is used twice while it is near, and the traffic of x and y is a quarter.
    template <typename T, typename Number, typename Load, typename Weight>
    static MYOLINES_INLINE T twice(const int n, const Number *X, const Load &load, const Weight &weight, const T *x, T *y)
    {
      constexpr int m = 4;
      T             squares(0.);
      int           i = 0;
      for (; i + m <= n; i += m)
        {
          const Number *row[m];
          T             s[m];
          for (int r = 0; r < m; ++r)
            {
              row[r] = X + start(i + r) * n_lanes;
              s[r]   = T(0.);
            }
          for (int j = 0; j < i; ++j)
            {
              const T xj = x[j];
              for (int r = 0; r < m; ++r)
                s[r] += load(row[r] + j * n_lanes) * xj;
            }
          for (int r = 0; r < m; ++r)
            {
              for (int j = i; j <= i + r; ++j)
                s[r] += load(row[r] + j * n_lanes) * x[j];
              squares += s[r] * s[r];
              s[r] *= weight(i + r);
            }
          for (int j = 0; j < i; ++j)
            {
              T yj = y[j];
              for (int r = 0; r < m; ++r)
                yj += load(row[r] + j * n_lanes) * s[r];
              y[j] = yj;
            }
          for (int j = i; j < i + m; ++j)
            {
              T yj(0.);
              for (int r = j - i; r < m; ++r)
                yj += load(row[r] + j * n_lanes) * s[r];
              y[j] = yj;
            }
        }
      for (; i < n; ++i)
        {
          const Number *row = X + start(i) * n_lanes;
          T             s(0.);
          for (int j = 0; j <= i; ++j)
            s += load(row + j * n_lanes) * x[j];
          squares += s * s;
          s *= weight(i);
          for (int j = 0; j < i; ++j)
            y[j] += load(row + j * n_lanes) * s;
          y[i] = load(row + i * n_lanes) * s;
        }
      return squares;
    }

    /// Bordering: of the leading matrix with A^(-1) = X^T X and the next row (a, d), l = X a gives the pivot d - l.l and the row
    /// (-l^T X, 1) / sqrt(pivot) of X. The pivots are those of a Cholesky factorisation: all positive if and only if A is positive
    /// definite.
    static unsigned int factorise(const int n, double *matrix, double *sums, double *scratch)
    {
      using T              = Lanes<isa, double>;
      T           *A       = reinterpret_cast<T *>(matrix);
      T           *sum     = reinterpret_cast<T *>(sums);
      T           *product = reinterpret_cast<T *>(scratch);
      const auto   load    = [](const double *from) MYOLINES_INLINED { return *reinterpret_cast<const T *>(from); };
      const auto   one     = [](int) MYOLINES_INLINED { return T(1.); };
      unsigned int refused = 0;
      for (int i = 0; i < n; ++i)
        {
          T *row = A + start(i);
          sum[i] = T(0.);
          for (int j = 0; j <= i; ++j)
            {
              const T size = select(row[j] < T(0.), -row[j], row[j]);
              sum[i] += size;
              if (j < i)
                sum[j] += size;
            }
          const T squares = twice(i, matrix, load, one, row, product);
          T       pivot   = row[i] - squares;
          for (int lane = 0; lane < n_lanes; ++lane)
            if (!(pivot[lane] > 0))
              {
                refused |= 1u << lane;
                pivot.set(lane, 1.);
              }
          const T inverse = T(1.) / sqrt(pivot);
          for (int j = 0; j < i; ++j)
            row[j] = -product[j] * inverse;
          row[i] = inverse;
        }
      return refused;
    }

    static void pack(const int n, const double *factor, void *packed, float *weights)
    {
      using T                = Lanes<isa, double>;
      constexpr double range = 16384; // half precision ends at 65504; what is 4e-9 of that is still a normal number
      auto            *to    = static_cast<typename Packed::Number *>(packed);
      for (int i = 0; i < n; ++i)
        {
          const T *row = reinterpret_cast<const T *>(factor) + start(i);
          T        largest(0.);
          for (int j = 0; j <= i; ++j)
            {
              const T size = select(row[j] < T(0.), -row[j], row[j]);
              largest      = select(largest < size, size, largest);
            }
          const T unit  = largest * T(1 / range);
          const T scale = select(largest > T(0.), T(1.) / unit, T(0.));
          for (int lane = 0; lane < n_lanes; ++lane)
            weights[i * n_lanes + lane] = static_cast<float>(unit[lane] * unit[lane]);
          for (int j = 0; j <= i; ++j, to += n_lanes)
            {
              const T scaled = row[j] * scale;
              float   single[n_lanes];
              for (int lane = 0; lane < n_lanes; ++lane)
                single[lane] = static_cast<float>(scaled[lane]);
              Packed::store(single, to);
            }
        }
    }

    static void multiply(const int n, const void *packed, const float *weights, const float *x, float *y)
    {
      using T           = Lanes<isa, float>;
      const T   *w      = reinterpret_cast<const T *>(weights);
      const auto load   = [](const typename Packed::Number *from) MYOLINES_INLINED { return Packed::load(from); };
      const auto weight = [w](const int i) MYOLINES_INLINED { return w[i]; };
      twice(n, static_cast<const typename Packed::Number *>(packed), load, weight, reinterpret_cast<const T *>(x),
            reinterpret_cast<T *>(y));
    }
  };

  template <InstructionSet isa>
  constexpr PatchKernels make_patch_kernels()
  {
    return {sizeof(typename PackedEntry<isa>::Number), &PatchWork<isa>::factorise, &PatchWork<isa>::pack, &PatchWork<isa>::multiply};
  }
} // namespace myolines
