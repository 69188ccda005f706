// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>
#include <myolines/materials/law_kernels.h>

namespace myolines
{
  /// A law on the points of a batch, as many lanes at a time as one vector has: matrices of dual numbers of all lanes would not stay in
  /// registers (four times slower).
  template <InstructionSet isa, class L>
  class LawBatch
  {
    static constexpr int width = Lanes<isa>::width;
    using T                    = Lanes<isa, double, width>;

  public:
    /// As LawKernels::stress.
    static void stress(const LawTerm &term, const LawPoints &points, double *stress)
    {
      for_each(term, points,
               [&](const Place &at) { at.add(T(1.), law(term).stress(strain(at.deformation())), stress + 9 * at.q * n_lanes); });
    }

    /// As LawKernels::action.
    static void action(const LawTerm &term, const LawPoints &points, const LawWeights &w, const double *direction, double *change)
    {
      const bool symmetrised = w.symmetrised && L::rates != Rates::none;
      for_each(term, points, [&](const Place &at) {
        const Mat3<T> dF = at.matrix(direction + 9 * at.q * n_lanes);
        at.add(at.JxW(), symmetrised ? symmetrised_action(at, w, dF) : tangent(law(term), at.deformation(), T(w.u) * dF, T(w.v) * dF),
               change + 9 * at.q * n_lanes);
      });
    }

    /// As LawKernels::coefficients.
    static void coefficients(const LawTerm &term, const LawPoints &points, const LawWeights &w, double *c)
    {
      for_each(term, points, [&](const Place &at) {
        T A[9][9];
        all_moduli(at, w, A);
        const T scale = at.weight() * at.JxW();
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            {
              T half[3][3]; // A_aI,bK dxi_B/dX_K
              for (int I = 0; I < 3; ++I)
                for (int B = 0; B < 3; ++B)
                  half[I][B] = A[3 * a + I][3 * b] * at.inverse(B, 0) + A[3 * a + I][3 * b + 1] * at.inverse(B, 1) +
                               A[3 * a + I][3 * b + 2] * at.inverse(B, 2);
              for (int X = 0; X < 3; ++X)
                for (int B = 0; B < 3; ++B)
                  {
                    const T s  = at.inverse(X, 0) * half[0][B] + at.inverse(X, 1) * half[1][B] + at.inverse(X, 2) * half[2][B];
                    T      &to = at.lanes(c, ((3 * a + b) * 9 + 3 * X + B) * points.n + at.q);
                    to         = to + at.of_tissue(scale * s);
                  }
            }
      });
    }

    /// As LawKernels::energy.
    static void energy(const LawTerm &term, const LawPoints &points, double *W)
    {
      for_each(term, points,
               [&](const Place &at) { at.lanes(W, at.q) += at.of_tissue(at.weight() * law(term).energy(strain(at.deformation()))); });
    }

  private:
    static const L &law(const LawTerm &term) { return *static_cast<const L *>(term.law); }

    /// Some lanes of a point.
    struct Place
    {
      const LawTerm   &term;
      const LawPoints &points;
      int              q, first; ///< lane

      /// Number @p i of an array of fields.
      MYOLINES_INLINE const T &lanes(const double *fields, const int i) const
      {
        return *reinterpret_cast<const T *>(fields + std::size_t(i) * n_lanes + first);
      }
      MYOLINES_INLINE T &lanes(double *fields, const int i) const
      {
        return *reinterpret_cast<T *>(fields + std::size_t(i) * n_lanes + first);
      }
      MYOLINES_INLINE Mat3<T> matrix(const double *fields) const
      {
        return Mat3<T>::make([&](const int i, const int j) MYOLINES_INLINED { return lanes(fields, 3 * i + j); });
      }
      MYOLINES_INLINE T material(const int i) const { return lanes(points.material + q * points.material_stride, i); }
      MYOLINES_INLINE T inverse(const int A, const int J) const { return lanes(points.geometry + q * points.geometry_stride, 3 * A + J); }
      MYOLINES_INLINE T JxW() const { return lanes(points.geometry + q * points.geometry_stride, 9) * T(points.weight[q]); }

      MYOLINES_INLINE Deformation<T> deformation() const
      {
        const bool at_rest = L::rates == Rates::none || points.F_rate == nullptr;
        return {matrix(points.F + q * points.F_stride),
                at_rest ? Mat3<T>::zero() : matrix(points.F_rate + 9 * q * n_lanes),
                {{material(material_direction), material(material_direction + 1), material(material_direction + 2)}},
                points.activation->at(material(material_region)),
                points.curves};
      }

      /// Of the part in the mix: all else than fat weighs 1 - fraction.
      MYOLINES_INLINE T weight() const { return T(term.weight) * (T(1.) - material(material_fat)); }

      /// @p x in the lanes of this tissue, zero in others, whose numbers may be anything.
      MYOLINES_INLINE T of_tissue(const T &x) const
      {
        const T away = material(material_tissue) - T(double(term.tissue));
        return select(away * away < T(0.25), x, T(0.));
      }

      MYOLINES_INLINE void add(const T &factor, const Mat3<T> &x, double *to) const
      {
        const T scale = weight() * factor;
        for (int i = 0; i < 9; ++i)
          lanes(to, i) += of_tissue(scale * x.entry[i]);
      }
    };

    template <typename Work>
    static MYOLINES_INLINE void for_each(const LawTerm &term, const LawPoints &points, const Work &work)
    {
      for (int q = 0; q < points.n; ++q)
        for (int first = 0; first < n_lanes; first += width)
          work(Place{term, points, q, first});
    }

    static void all_moduli(const Place &at, const LawWeights &w, T (&A)[9][9])
    {
      moduli(law(at.term), at.deformation(), T(w.u), T(w.v), A);
      if (w.symmetrised && L::rates != Rates::none)
        for (int i = 0; i < 9; ++i)
          for (int j = 0; j < i; ++j)
            A[i][j] = A[j][i] = T(0.5) * (A[i][j] + A[j][i]);
    }

    static Mat3<T> symmetrised_action(const Place &at, const LawWeights &w, const Mat3<T> &dF)
    {
      T A[9][9];
      all_moduli(at, w, A);
      Mat3<T> dP = Mat3<T>::zero();
      for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
          dP.entry[i] += A[i][j] * dF.entry[j];
      return dP;
    }
  };

  /// The kernels of the law L. To be called where the options of the compiler are those of the instruction set, and for plain code only.
  template <InstructionSet isa, class L>
  constexpr LawKernels make_law_kernels()
  {
    using Batch = LawBatch<isa, L>;
    if constexpr (has_energy<L>)
      return {&Batch::stress, &Batch::action, &Batch::coefficients, &Batch::energy};
    else
      return {&Batch::stress, &Batch::action, &Batch::coefficients, nullptr};
  }
} // namespace myolines
