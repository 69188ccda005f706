// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

namespace myolines
{
  /// Dense kernels on n_lanes symmetric matrices at once, lower triangles row by row, entries interleaved by lane. Plain
  /// code only: compiled for several instruction sets.
  struct PatchKernels
  {
    /// Inverts n x n matrices in place; @p scratch holds n lanes. Returns the bits of the lanes whose matrix is not
    /// positive definite; what those hold then is of no use.
    unsigned int (*invert)(int n, double *matrix, double *scratch);

    /// y = A x.
    void (*multiply)(int n, const float *matrix, const float *x, float *y);
  };

  template <InstructionSet isa>
  struct PatchWork
  {
    /// Sweeps one pivot after the other; all of them turn A into -A^(-1). The pivots are those of an LDL^T
    /// factorisation: all positive if and only if A is positive definite.
    static unsigned int invert(const int n, double *matrix, double *scratch)
    {
      using T              = Lanes<isa, double>;
      T           *A       = reinterpret_cast<T *>(matrix);
      T           *column  = reinterpret_cast<T *>(scratch);
      unsigned int refused = 0;
      for (int k = 0; k < n; ++k)
        {
          T *row   = A + k * (k + 1) / 2;
          T  pivot = row[k];
          for (int lane = 0; lane < n_lanes; ++lane)
            if (!(pivot[lane] > 0))
              {
                refused |= 1u << lane;
                pivot.set(lane, 1.);
              }
          const T inverse = T(1.) / pivot;
          for (int j = 0; j < k; ++j)
            column[j] = row[j];
          column[k] = T(0.);
          for (int i = k + 1; i < n; ++i)
            column[i] = A[i * (i + 1) / 2 + k];
          for (int i = 0; i < n; ++i)
            {
              const T factor = column[i] * inverse;
              T      *at     = A + i * (i + 1) / 2;
              for (int j = 0; j <= i; ++j)
                at[j] -= factor * column[j];
            }
          for (int j = 0; j < k; ++j)
            row[j] = column[j] * inverse;
          for (int i = k + 1; i < n; ++i)
            A[i * (i + 1) / 2 + k] = column[i] * inverse;
          row[k] = -inverse;
        }
      for (int i = 0; i < n * (n + 1) / 2; ++i)
        A[i] = -A[i];
      return refused;
    }

    /// Each entry is used for both triangles. Two rows at a time halve the traffic of x and y.
    static void multiply(const int n, const float *matrix, const float *xs, float *ys)
    {
      using T    = Lanes<isa, float>;
      const T *A = reinterpret_cast<const T *>(matrix);
      const T *x = reinterpret_cast<const T *>(xs);
      T       *y = reinterpret_cast<T *>(ys);
      int      i = 0;
      for (; i + 1 < n; i += 2)
        {
          const T *first = A + i * (i + 1) / 2, *second = first + i + 1;
          const T  x1 = x[i], x2 = x[i + 1];
          T        s1 = first[i] * x1 + second[i] * x2, s2 = second[i] * x1 + second[i + 1] * x2;
          for (int j = 0; j < i; ++j)
            {
              const T a = first[j], b = second[j], xj = x[j];
              s1 += a * xj;
              s2 += b * xj;
              y[j] += a * x1 + b * x2;
            }
          y[i]     = s1;
          y[i + 1] = s2;
        }
      if (i < n)
        {
          const T *row = A + i * (i + 1) / 2;
          const T  xi  = x[i];
          T        s   = row[i] * xi;
          for (int j = 0; j < i; ++j)
            {
              s += row[j] * x[j];
              y[j] += row[j] * xi;
            }
          y[i] = s;
        }
    }
  };

  template <InstructionSet isa>
  constexpr PatchKernels make_patch_kernels()
  {
    return {&PatchWork<isa>::invert, &PatchWork<isa>::multiply};
  }
} // namespace myolines
