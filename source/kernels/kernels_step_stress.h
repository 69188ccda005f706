// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_volume.h"

namespace myolines
{
  /// One batch of cells during a step (KernelModel::before): stresses of two states.
  template <InstructionSet isa, int n1>
  class BatchStepStress : public BatchVolume<isa, n1>
  {
  protected:
    using Base = BatchVolume<isa, n1>;
    using Base::cells;
    using Base::clear;
    using Base::F;
    using Base::F_before;
    using Base::F_rate;
    using Base::fibres;
    using Base::law_points;
    using Base::m;
    using Base::material;
    using Base::n_points;
    using Base::of_step;

    using T = Lanes<isa>;
    using Base::Base;

    /// Fields of lanes.
    static constexpr int step_scratch_size() { return of_points + sizeof(StepPoint<T>) / sizeof(T); }

    /// Of the stresses: what has an energy, at rest, or all.
    struct Part
    {
      Part(const BatchStepStress &batch, const bool whole)
        : model(batch.m)
        , terms(batch.fibres)
        , all(whole)
      {
        model.exact_tangent = true;
        model.rate_tangent  = {};
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
      of_end_along       = 74, ///< change of F_1
      of_end_change      = 83, ///< and of the stored S_1
      of_end_rate        = 92, ///< zero
      of_tangents        = 101,
      of_tangents_of_all = of_tangents + tangent_size_rate,
      of_tangents_of_end = of_tangents_of_all + tangent_size_rate,
      of_moduli          = of_tangents_of_end + tangent_size_rate,
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
          StepPoint<T> &at = points()[q];
          at.stored        = at.inverse * Mat3<T>::load(P + 9 * q);
          const T missing  = after[q] - before[q] - T(0.5) * dot(at.stored, at.change);
          at.secant        = select(at.has_secant(), T(2.) * missing / at.square, T(0.));
          at.whole         = mixed ? at.inverse * Mat3<T>::load(P_all + 9 * q) : at.stored;
          at.stress        = at.whole + at.secant * at.change;
        }
      if (dissipates())
        dissipate(stored);
    }

    bool dissipates() const { return m.dissipation != 0; }

    /// Adds chi/2 (S_1 - S_0 + l (C_1 - C_0)) to the stresses, see StepPoint::lift. Nothing is lost where |C_1 - C_0| is rounding: there
    /// l = 0, and the work is smaller than that.
    void dissipate(const Part &stored)
    {
      T *P_0 = field(of_end_along), *P_1 = field(of_end_change), *at_rest = field(of_end_rate);
      clear(at_rest, 9 * n_points);
      stresses(stored, F_before, at_rest, P_0);
      stresses(stored, F, at_rest, P_1);
      for (int q = 0; q < n_points; ++q)
        {
          StepPoint<T> &at = points()[q];
          at.difference    = at.second_stress(at.F, Mat3<T>::load(P_1 + 9 * q)) - at.second_stress(at.before, Mat3<T>::load(P_0 + 9 * q));
          const T work     = dot(at.difference, at.change);
          at.lift          = select(T(1e-24) < at.square, select(work < T(0.), T(-1.) * work / at.square, T(0.)), T(0.));
          at.stress        = at.stress + T(m.dissipation / 2) * (at.difference + at.lift * at.change);
        }
    }
  };
} // namespace myolines
