// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_volume.h"

namespace myolines
{
  /// One batch of cells during a step (KernelModel::before): forces of two states and their derivatives.
  template <InstructionSet isa, int n1>
  class BatchStep : public BatchVolume<isa, n1>
  {
  protected:
    using Base = BatchVolume<isa, n1>;
    using Base::cells;
    using Base::clear;
    using Base::coefficients;
    using Base::expand;
    using Base::F;
    using Base::F_before;
    using Base::F_rate;
    using Base::fibres;
    using Base::inverse;
    using Base::JxW;
    using Base::law_points;
    using Base::m;
    using Base::material;
    using Base::mode;
    using Base::n_points;
    using Base::of_step;
    using Base::pressure;
    using Base::t;

    using T = Lanes<isa>;
    using Base::Base;

    /// P of the step at the points, [n_points][9].
    void step_stresses(T *P)
    {
      enter_step();
      for (int q = 0; q < n_points; ++q)
        {
          const StepPoint<T> &at = points()[q];
          save(at.middle * (at.stress + expand(pressure, q) * at.volume), P + 9 * q);
        }
    }

    /// The tangents of the points, each as StepTangentValue, in the scratch storage. S depends on F_1 by C_1 alone: its changes along the
    /// six units of a symmetric C are enough, and dC = F^T dF + dF^T F makes moduli of nine columns of them.
    const T *step_tangents()
    {
      T *tangents = field(of_moduli);
      enter_step();
      const Part stored(*this, false), all(*this, true);
      const bool mixed = !all_is_stored();
      const int  size  = point_tangent_size(m);
      T *along = field(of_along), *along_rate = field(of_along_rate), *dP = field(of_dP), *dP_all = field(of_dP_all), *end = field(of_end);
      stresses(stored, F, F_rate, end);
      remember(stored, field(of_tangents));
      if (mixed)
        remember(all, field(of_tangents_of_all));
      for (int q = 0; q < n_points; ++q)
        begin_tangent(q, tangents + q * size);
      for (const SymmetricUnit &unit : symmetric_units)
        {
          const Mat3<T> E = unit.template matrix<T>(); // the change of C_1
          for (int q = 0; q < n_points; ++q)
            {
              const StepPoint<T> &at = points()[q];
              const Mat3<T>       dU = T(0.25) * (transpose(at.inverse) * E); // 2 sym(U^T dU) = E/2 = dC_m; laws do not see its rotation
              save(dU, along + 9 * q);
              save(T(-1.) * (transpose(at.inverse) * (transpose(dU) * at.rate)), along_rate + 9 * q); // at one rate of C
            }
          clear(dP, 9 * n_points);
          add_changes(stored, field(of_tangents), along, 1, 0, dP);
          if (mixed)
            {
              clear(dP_all, 9 * n_points);
              add_changes(all, field(of_tangents_of_all), along, 1, 0, dP_all);
              if (m.velocities())
                add_changes(all, field(of_tangents_of_all), along_rate, 0, 1, dP_all);
            }
          for (int q = 0; q < n_points; ++q)
            {
              const StepPoint<T> &at = points()[q];
              const Mat3<T>       dU = Mat3<T>::load(along + 9 * q);
              const Mat3<T>       of = at.inverse * (Mat3<T>::load(dP + 9 * q) - dU * at.stored);
              const Mat3<T> middle   = mixed ? at.inverse * (Mat3<T>::load(dP_all + 9 * q) - dU * (at.stress - at.secant * at.change)) : of;
              const Mat3<T> dS =
                  middle + secant_change(at, of, Mat3<T>::load(end + 9 * q), E) + expand(pressure, q) * at.change_of_volume(E);
              add_along(unit, JxW(q), at.F, at.middle * dS, tangents + q * size);
            }
          if (m.velocities())
            add_rates(all, unit, tangents, size);
        }
      return tangents;
    }

    /// At fixed pressure dP = change of the flux at a point, times JxW; @p volume = dP/dp JxW. Returns dJ JxW.
    /// @p tangent: StepTangentValue.
    T step_action(const double w[3], const T *tangent, const T *dF, T *dP, T *volume) const
    {
      T change(0.);
      for (int i = 0; i < 9; ++i)
        {
          dP[i] = T(0.);
          for (int j = 0; j < 9; ++j)
            dP[i] += modulus(w, tangent, i, j) * dF[j];
          change += tangent[step_cofactor + i] * dF[i];
          volume[i] = tangent[step_volume + i];
        }
      return change;
    }

    /// The tangents of a step as coefficients in unit-cell directions, as PointLaw::coefficients().
    void step_coefficients(const double w[3])
    {
      const T *moduli = step_tangents();
      for (int q = 0; q < n_points; ++q)
        {
          const T *tangent = moduli + q * point_tangent_size(m);
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
              {
                T half[3][3]; // A_aI,bK dxi_B/dX_K
                for (int I = 0; I < 3; ++I)
                  for (int B = 0; B < 3; ++B)
                    {
                      half[I][B] = T(0.);
                      for (int K = 0; K < 3; ++K)
                        half[I][B] += modulus(w, tangent, 3 * a + I, 3 * b + K) * inverse(q, 3 * B + K);
                    }
                for (int A = 0; A < 3; ++A)
                  for (int B = 0; B < 3; ++B)
                    coefficients[((3 * a + b) * 9 + 3 * A + B) * n_points + q] =
                        inverse(q, 3 * A) * half[0][B] + inverse(q, 3 * A + 1) * half[1][B] + inverse(q, 3 * A + 2) * half[2][B];
              }
        }
    }

    /// F_m V JxW, [n_points][9], by which pressures enter forces.
    void volume_of_step(T *forces) const
    {
      for (int q = 0; q < n_points; ++q)
        {
          StepPoint<T> at;
          at.move(F_before + 9 * q, F + 9 * q, nullptr);
          save(JxW(q) * (at.middle * at.volume), forces + 9 * q);
        }
    }

    /// Fields of lanes.
    static constexpr int step_scratch_size() { return of_points + sizeof(StepPoint<T>) / sizeof(T); }

  private:
    /// w_u dP/dF_1 + w_v dP/dF_rate
    T modulus(const double w[3], const T *tangent, const int i, const int j) const
    {
      const T by_F = T(w[0]) * tangent[step_by_F + 9 * i + j];
      return m.velocities() ? by_F + T(w[1]) * tangent[step_by_rate + 9 * i + j] : by_F;
    }

    /// Of the stresses: what has an energy, at rest, or all.
    struct Part
    {
      Part(const BatchStep &batch, const bool whole)
        : model(batch.m)
        , terms(batch.fibres)
        , all(whole)
      {
        model.exact_tangent = true;
        if (!all)
          model.active = model.rate = model.viscous = terms.active = terms.rate = false;
      }
      KernelModel model;
      FibreTerms  terms;
      bool        all;
    };

    /// In the scratch storage.
    enum Field
    {
      of_U               = 0,
      of_U_rate          = 9,
      of_along           = 18,
      of_along_rate      = 27,
      of_dP              = 36,
      of_dP_all          = 45,
      of_end             = 54, ///< P of what is stored, at the end
      of_laws            = 63,
      of_energies        = 72,
      of_tangents        = 74,
      of_tangents_of_all = of_tangents + tangent_size_rate,
      of_moduli          = of_tangents_of_all + tangent_size_rate,
      of_points          = of_moduli + step_by_rate + 81
    };
    T            *field(const Field f) const { return of_step + std::size_t(n_points) * f; }
    StepPoint<T> *points() const { return reinterpret_cast<StepPoint<T> *>(field(of_points)); }

    static MYOLINES_INLINE void save(const Mat3<T> &x, T *to)
    {
      for (int i = 0; i < 9; ++i)
        to[i] = x.entry[i];
    }

    const LawKernels &kernels_of(const int law) const { return law_kernels<isa>(cells.laws[law]); }
    bool              takes(const Part &part, const int law) const { return part.all || kernels_of(law).energy != nullptr; }

    bool all_is_stored() const
    {
      bool all = !fibres.active && !m.viscous;
      for (int i = 0; i < cells.n_laws; ++i)
        all = all && kernels_of(i).energy != nullptr;
      return all;
    }

    LawPoints points_of(const Part &part, const T *F_at, const T *rate) const
    {
      LawPoints points = law_points(F_at, 9, rate);
      if (!part.model.viscous)
        points.F_rate = nullptr;
      return points;
    }

    PointLaw<T> law(const Part &part, const Kinematics<T> &k, const int q, const T *rate) const
    {
      return {part.model, part.terms, material(q), k, rate, T(0.)};
    }

    /// P[9 q + i] of a part at F_at, without pressure.
    void stresses(const Part &part, const T *F_at, const T *rate, T *P) const
    {
      clear(P, 9 * n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        if (takes(part, i))
          kernels_of(i).stress(cells.laws[i], points_of(part, F_at, rate), reinterpret_cast<double *>(P));
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F_at + 9 * q);
          T                   of_tissue[9];
          law(part, k, q, rate + 9 * q).stress(of_tissue);
          for (int i = 0; i < 9; ++i)
            P[9 * q + i] += of_tissue[i];
        }
    }

    /// W[q], without that of the volume.
    void energies(const Part &part, const T *F_at, T *W) const
    {
      clear(W, n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        if (takes(part, i))
          kernels_of(i).energy(cells.laws[i], points_of(part, F_at, F_rate), reinterpret_cast<double *>(W));
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F_at + 9 * q);
          const PointLaw<T>   at = law(part, k, q, F_rate);
          W[q] += Yeoh<T>(material(q) + material_yeoh).energy_of(at.I1);
          if (cells.muscle)
            W[q] += PassiveFibre<T>(material(q)[material_passive]).energy_of(at.lam, &m.curves);
          if (cells.tendon)
            W[q] += TendinousFibre<T>(material(q)[material_tendon]).energy_of(at.lam, &m.curves);
        }
    }

    /// Fills points() from F_before, F and F_rate.
    void enter_step()
    {
      T *U = field(of_U), *rate = field(of_U_rate), *P = field(of_dP), *P_all = field(of_dP_all);
      T *before = field(of_energies), *after = before + n_points;
      for (int q = 0; q < n_points; ++q)
        {
          StepPoint<T> &at = points()[q];
          at.move(F_before + 9 * q, F + 9 * q, m.velocities() ? F_rate + 9 * q : nullptr);
          save(at.U, U + 9 * q);
          save(at.rate, rate + 9 * q);
        }
      const Part stored(*this, false), all(*this, true);
      const bool mixed = !all_is_stored();
      energies(stored, F_before, before);
      energies(stored, F, after);
      stresses(stored, U, rate, P);
      if (mixed)
        stresses(all, U, rate, P_all);
      for (int q = 0; q < n_points; ++q)
        {
          StepPoint<T> &at    = points()[q];
          at.stored           = at.inverse * Mat3<T>::load(P + 9 * q);
          const T missing     = after[q] - before[q] - T(0.5) * dot(at.stored, at.change);
          at.secant           = select(at.has_secant(), T(2.) * missing / at.square, T(0.));
          const Mat3<T> whole = mixed ? at.inverse * Mat3<T>::load(P_all + 9 * q) : at.stored;
          at.stress           = whole + at.secant * at.change;
        }
    }

    /// d(c (C_1 - C_0)) along E, where the stored stress in the middle changes by @p of and is P_end at the end.
    static MYOLINES_INLINE Mat3<T> secant_change(const StepPoint<T> &at, const Mat3<T> &of, const Mat3<T> &P_end, const Mat3<T> &E)
    {
      const Mat3<T> S_end   = (T(1.) / at.J) * (transpose(cofactor(at.F)) * P_end);
      const T       missing = dot(S_end, E) - dot(of, at.change) - dot(at.stored, E);
      const T       dc      = select(at.has_secant(), (missing - T(2.) * at.secant * dot(at.change, E)) / at.square, T(0.));
      return dc * at.change + at.secant * E;
    }

    /// What does not come from changes of C.
    void begin_tangent(const int q, T *tangent) const
    {
      const StepPoint<T> &at = points()[q];
      clear(tangent, point_tangent_size(m));
      const Mat3<T> S = (T(0.5) * JxW(q)) * (at.stress + expand(pressure, q) * at.volume);
      for (int i = 0; i < 3; ++i)
        for (int J = 0; J < 3; ++J)
          for (int L = 0; L < 3; ++L)
            tangent[step_by_F + 9 * (3 * i + J) + 3 * i + L] = S(L, J);
      save(JxW(q) * (at.middle * at.volume), tangent + step_volume);
      save(JxW(q) * cofactor(at.F), tangent + step_cofactor);
    }

    /// Tangents of PointLaw in the middle.
    void remember(const Part &part, T *of_points) const
    {
      const T *U = field(of_U), *rate = field(of_U_rate);
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(U + 9 * q);
          law(part, k, q, rate + 9 * q).store(rate + 9 * q, T(1.), of_points + q * tangent_size_rate);
        }
    }

    /// dP += w_u dP/dF : along + w_v dP/dFdot : along in the middle.
    void add_changes(const Part &part, const T *of_points, const T *along, const double w_u, const double w_v, T *dP) const
    {
      T *of_law = field(of_laws);
      clear(of_law, 9 * n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        if (takes(part, i))
          kernels_of(i).action(cells.laws[i], points_of(part, field(of_U), field(of_U_rate)), {w_u, part.model.viscous ? w_v : 0, false},
                               reinterpret_cast<const double *>(along), reinterpret_cast<double *>(of_law));
      for (int q = 0; q < n_points; ++q)
        {
          T       of_tissue[9], cofactor[9];
          const T weight = T(1.) / JxW(q);
          tangent_action(part.model, material(q), Kinematics<T>(field(of_U) + 9 * q), of_points + q * tangent_size_rate, along + 9 * q,
                         T(1.), w_u, w_v, of_tissue, cofactor);
          for (int i = 0; i < 9; ++i)
            dP[9 * q + i] += of_tissue[i] + weight * of_law[9 * q + i];
        }
    }

    /// Of a change of the rate of C, which comes from F_rate and, as this is the rate of F_m, from F_1.
    void add_rates(const Part &all, const SymmetricUnit &unit, T *tangents, const int size)
    {
      T            *along = field(of_along_rate), *dP = field(of_dP_all);
      const Mat3<T> E = unit.template matrix<T>();
      for (int q = 0; q < n_points; ++q)
        save(T(0.5) * (transpose(points()[q].inverse) * E), along + 9 * q);
      clear(dP, 9 * n_points);
      add_changes(all, field(of_tangents_of_all), along, 0, 1, dP);
      for (int q = 0; q < n_points; ++q)
        {
          const StepPoint<T> &at     = points()[q];
          const Mat3<T>       column = at.middle * (at.inverse * Mat3<T>::load(dP + 9 * q));
          add_along(unit, JxW(q), at.middle, column, tangents + q * size + step_by_rate);
          add_along(unit, T(0.5) * JxW(q), at.F_rate, column, tangents + q * size + step_by_F);
        }
    }
  };
} // namespace myolines
