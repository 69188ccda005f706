// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_step_stress.h"

namespace myolines
{
  /// One batch of cells during a step (KernelModel::before): forces of two states and their derivatives.
  template <InstructionSet isa, int n1>
  class BatchStep : public BatchStepStress<isa, n1>
  {
  protected:
    using Base = BatchStepStress<isa, n1>;
    using Base::all_is_stored;
    using Base::cells;
    using Base::clear;
    using Base::coefficients;
    using Base::dissipates;
    using Base::enter_step;
    using Base::expand;
    using Base::F;
    using Base::F_before;
    using Base::F_rate;
    using Base::field;
    using Base::inverse;
    using Base::JxW;
    using Base::kernels_of;
    using Base::law;
    using Base::m;
    using Base::material;
    using Base::mode;
    using Base::n_points;
    using Base::points;
    using Base::points_of;
    using Base::pressure;
    using Base::save;
    using Base::stresses;
    using Base::t;
    using Base::takes;
    using typename Base::Part;

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
      T *tangents = field(Base::of_moduli);
      enter_step();
      const Part stored(*this, false), all(*this, true);
      const bool mixed = !all_is_stored();
      const int  size  = point_tangent_size(m);
      T         *along = field(Base::of_along), *along_rate = field(Base::of_along_rate), *dP = field(Base::of_dP),
        *dP_all = field(Base::of_dP_all), *end = field(Base::of_end);
      stresses(stored, F, F_rate, end);
      remember(stored, field(Base::of_U), field(Base::of_tangents));
      if (mixed)
        remember(all, field(Base::of_U), field(Base::of_tangents_of_all));
      if (dissipates())
        remember(stored, F, field(Base::of_tangents_of_end));
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
          add_changes(stored, field(Base::of_U), field(Base::of_tangents), along, 1, 0, dP);
          if (dissipates())
            change_end(stored, E);
          if (mixed)
            {
              clear(dP_all, 9 * n_points);
              add_changes(all, field(Base::of_U), field(Base::of_tangents_of_all), along, 1, 0, dP_all);
              if (m.velocities())
                add_changes(all, field(Base::of_U), field(Base::of_tangents_of_all), along_rate, 0, 1, dP_all);
            }
          for (int q = 0; q < n_points; ++q)
            {
              const StepPoint<T> &at     = points()[q];
              const Mat3<T>       dU     = Mat3<T>::load(along + 9 * q);
              const Mat3<T>       of     = at.inverse * (Mat3<T>::load(dP + 9 * q) - dU * at.stored);
              const Mat3<T>       middle = mixed ? at.inverse * (Mat3<T>::load(dP_all + 9 * q) - dU * at.whole) : of;
              const Mat3<T>       S_end  = at.second_stress(at.F, Mat3<T>::load(end + 9 * q));
              Mat3<T>             dS     = middle + secant_change(at, of, S_end, E) + expand(pressure, q) * at.change_of_volume(E);
              if (dissipates())
                dS = dS + dissipated_change(at, Mat3<T>::load(field(Base::of_end_change) + 9 * q), E);
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

  private:
    /// w_u dP/dF_1 + w_v dP/dF_rate
    T modulus(const double w[3], const T *tangent, const int i, const int j) const
    {
      const T by_F = T(w[0]) * tangent[step_by_F + 9 * i + j];
      return m.velocities() ? by_F + T(w[1]) * tangent[step_by_rate + 9 * i + j] : by_F;
    }

    /// Fills of_end_change with the changes of the stored S_1 along the change @p E of C_1.
    void change_end(const Part &stored, const Mat3<T> &E)
    {
      T       *along = field(Base::of_end_along), *dP = field(Base::of_end_change);
      const T *end = field(Base::of_end);
      for (int q = 0; q < n_points; ++q)
        {
          const StepPoint<T> &at = points()[q];
          save((T(0.5) / at.J) * (cofactor(at.F) * E), along + 9 * q); // 2 sym(F^T dF) = E
        }
      clear(dP, 9 * n_points);
      add_changes(stored, F, field(Base::of_tangents_of_end), along, 1, 0, dP);
      for (int q = 0; q < n_points; ++q)
        {
          const StepPoint<T> &at = points()[q];
          const Mat3<T>       S  = at.second_stress(at.F, Mat3<T>::load(end + 9 * q));
          save(at.second_stress(at.F, Mat3<T>::load(dP + 9 * q) - Mat3<T>::load(along + 9 * q) * S), dP + 9 * q);
        }
    }

    /// d(chi/2 (S_1 - S_0 + l (C_1 - C_0))) along E, where S_1 changes by @p dS.
    Mat3<T> dissipated_change(const StepPoint<T> &at, const Mat3<T> &dS, const Mat3<T> &E) const
    {
      const T change = dot(dS, at.change) + dot(at.difference, E) + T(2.) * at.lift * dot(at.change, E);
      const T dl     = select(at.lift > T(0.), T(-1.) * change / at.square, T(0.));
      return T(m.dissipation / 2) * (dS + dl * at.change + at.lift * E);
    }

    /// d(c (C_1 - C_0)) along E, where the stored stress in the middle changes by @p of and is S_end at the end.
    static MYOLINES_INLINE Mat3<T> secant_change(const StepPoint<T> &at, const Mat3<T> &of, const Mat3<T> &S_end, const Mat3<T> &E)
    {
      const T missing = dot(S_end, E) - dot(of, at.change) - dot(at.stored, E);
      const T dc      = select(at.has_secant(), (missing - T(2.) * at.secant * dot(at.change, E)) / at.square, T(0.));
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

    /// Tangents of PointLaw at F_at, the middle or, of what does not depend on rates, the end.
    void remember(const Part &part, const T *F_at, T *of_points) const
    {
      const T *rate = field(Base::of_U_rate);
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F_at + 9 * q);
          law(part, k, q, rate + 9 * q).store(rate + 9 * q, T(1.), of_points + q * tangent_size_rate);
        }
    }

    /// dP += w_u dP/dF : along + w_v dP/dFdot : along at F_at, where remember() was.
    void add_changes(const Part &part, const T *F_at, const T *of_points, const T *along, const double w_u, const double w_v, T *dP) const
    {
      T *of_law = field(Base::of_laws);
      clear(of_law, 9 * n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        if (takes(part, i))
          kernels_of(i).action(cells.laws[i], points_of(part, F_at, field(Base::of_U_rate)), {w_u, part.model.viscous ? w_v : 0, false},
                               reinterpret_cast<const double *>(along), reinterpret_cast<double *>(of_law));
      for (int q = 0; q < n_points; ++q)
        {
          T       of_tissue[9], cofactor[9];
          const T weight = T(1.) / JxW(q);
          tangent_action(part.model, material(q), Kinematics<T>(F_at + 9 * q), of_points + q * tangent_size_rate, along + 9 * q, T(1.), w_u,
                         w_v, of_tissue, cofactor);
          for (int i = 0; i < 9; ++i)
            dP[9 * q + i] += of_tissue[i] + weight * of_law[9 * q + i];
        }
    }

    /// Of a change of the rate of C, which comes from F_rate and, as this is the rate of F_m, from F_1.
    void add_rates(const Part &all, const SymmetricUnit &unit, T *tangents, const int size)
    {
      T            *along = field(Base::of_along_rate), *dP = field(Base::of_dP_all);
      const Mat3<T> E = unit.template matrix<T>();
      for (int q = 0; q < n_points; ++q)
        save(T(0.5) * (transpose(points()[q].inverse) * E), along + 9 * q);
      clear(dP, 9 * n_points);
      add_changes(all, field(Base::of_U), field(Base::of_tangents_of_all), along, 0, 1, dP);
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
