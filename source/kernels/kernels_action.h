// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_batch_step.h"

#if defined(__SSE2__)
#  include <immintrin.h>
#endif

namespace myolines
{
  /// One batch of cells as linear solves see it: the action of its tangent, and its pressures eliminated.
  template <InstructionSet isa, int n1>
  class BatchAction : public BatchStep<isa, n1>
  {
  protected:
    using Base = BatchStep<isa, n1>;
    using T    = Lanes<isa>;
    using Base::add_integral;
    using Base::add_unit_integral;
    using Base::Base;
    using Base::cells;
    using Base::clear;
    using Base::coefficients;
    using Base::cofactors;
    using Base::evaluate_F;
    using Base::evaluate_gradient;
    using Base::evaluate_unit_gradient;
    using Base::evaluate_values;
    using Base::expand;
    using Base::F;
    using Base::F_rate;
    using Base::fibres;
    using Base::from_orthonormal;
    using Base::from_unit;
    using Base::JxW;
    using Base::law_points;
    using Base::m;
    using Base::material;
    using Base::max_modes;
    using Base::mode;
    using Base::moments_to_orthonormal;
    using Base::n_points;
    using Base::orthonormal_modes;
    using Base::pressure;
    using Base::step_action;
    using Base::step_tangents;
    using Base::stiffness_of_modes;
    using Base::store_volume;
    using Base::t;
    using Base::to_orthonormal;
    using Base::to_unit;
    using Base::values;
    using Base::volume_of_step;
    using Base::volumetric_state;
    using Base::weigh_values;

    /// Gradients, rates if needed, pressure and dilatation at the points. False if the state is inadmissible.
    bool evaluate_state(const double *u, const double *v)
    {
      evaluate_F(u);
      if (!volumetric_state())
        return false;
      if (m.velocities())
        evaluate_gradient(v, F_rate);
      return true;
    }

    LawWeights law_weights(const double w[3]) const { return {w[0], m.viscous ? w[1] : 0, !m.exact_tangent}; }

    void store_tangent(const double *u, const double *v, float *high, float *low, T *volume)
    {
      evaluate_state(u, v);
      store_volume(volume);
      const int size  = point_tangent_size(m);
      const T  *steps = m.before != nullptr ? step_tangents() : nullptr;
      for (int q = 0; q < n_points; ++q)
        {
          T        of_state[tangent_size_rate + 9];
          const T *fields = steps != nullptr ? steps + q * size : of_state;
          if (steps == nullptr)
            {
              const Kinematics<T> k(F + 9 * q);
              PointLaw<T>(m, fibres, material(q), k, F_rate + 9 * q, expand(pressure, q)).store(F_rate + 9 * q, JxW(q), of_state);
              if (m.keep_gradient)
                for (int i = 0; i < 9; ++i)
                  of_state[size - 9 + i] = F[9 * q + i];
            }
          for (int i = 0; i < size; ++i)
            {
              const int at = (q * size + i) * n_lanes;
              fields[i].round_to(high + at);
              if (low != nullptr)
                (fields[i] - T::widened(high + at)).round_to(low + at);
            }
        }
    }

    /// The change of pressure is dp_h = phi S int phi cof F : dF, F that of the end in a step, unless one is given.
    void add_apply(const double w[3], const KernelTangent &tangent, const double *x, double *y, const KernelPressure *given)
    {
      const bool inertia = m.inertia && w[2] != 0, stiffness = w[0] != 0 || (w[1] != 0 && m.velocities());
      if (!stiffness && !inertia)
        return;
      T *flux = F; // in directions of the unit cell
      if (!stiffness)
        evaluate_values(x);
      else
        {
          evaluate_unit_gradient(x, flux, inertia ? values : nullptr);
          if (m.before != nullptr)
            add_step(w, tangent, flux, given);
          else
            add_state(w, tangent, flux, given);
        }
      if (inertia)
        weigh_values(w[2]);
      add_unit_integral(stiffness ? flux : nullptr, inertia ? values : nullptr, y);
    }

    void fill_stiffness(const double *u, T *W)
    {
      evaluate_F(u);
      volumetric_state();
      T R[max_modes * max_modes], E[max_modes * max_modes];
      orthonormal_modes(R);
      stiffness_of_modes(m.softened, E);
      to_orthonormal(R, E, W);
    }

    /// y += A^T W b
    void condense(const double *u, const T *W, const T *b, double *y)
    {
      T R[max_modes * max_modes], Wb[max_modes], p[max_modes], *forces = F_rate;
      orthonormal_modes(R);
      multiply_modes(W, b, Wb);
      from_orthonormal(R, Wb, p);
      evaluate_F(u);
      if (m.before != nullptr)
        volume_of_step(forces);
      else
        cofactors(forces);
      for (int q = 0; q < n_points; ++q)
        {
          const T at = expand(p, q);
          for (int i = 0; i < 9; ++i)
            forces[9 * q + i] *= at;
        }
      add_integral(forces, nullptr, y);
    }

    /// z = W (B x - b / weight)
    void recover(const double *u, const T *W, const double weight, const double *x, const T *b, T *z)
    {
      T R[max_modes * max_modes], moments[max_modes], p[max_modes], *unit = F_rate;
      orthonormal_modes(R);
      evaluate_F(u, F);
      evaluate_unit_gradient(x, unit);
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          T dF[9];
          from_unit(unit, q, dF);
          this->add_moments(dot(cofactor(Mat3<T>::load(F + 9 * q)), Mat3<T>::load(dF)), q, moments);
        }
      moments_to_orthonormal(R, moments, p);
      for (int i = 0; i < t.n_modes; ++i)
        p[i] -= b[i] * T(1 / weight);
      multiply_modes(W, p, z);
    }

  private:
    void multiply_modes(const T *W, const T *b, T *Wb) const
    {
      for (int i = 0; i < t.n_modes; ++i)
        {
          Wb[i] = T(0.);
          for (int j = 0; j < t.n_modes; ++j)
            Wb[i] += W[i * t.n_modes + j] * b[j];
        }
    }

    static MYOLINES_INLINE T widened(const float *from)
    {
#if defined(__AVX512F__) // otherwise GCC converts two halves; and its unmasked function warns of itself
      T x;
      x.part[0] = _mm512_maskz_cvtps_pd(0xff, _mm256_loadu_ps(from));
      return x;
#elif defined(__SSE2__) && !defined(__AVX__) // otherwise GCC converts one by one
      T x;
      for (int p = 0; p < T::n_parts; ++p)
        x.part[p] = _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i *>(from + p * T::width))));
      return x;
#else
      return T::widened(from);
#endif
    }

    /// @p n fields of point q from number @p begin on. Those of the same point in the next batch are fetched meanwhile.
    template <int n>
    MYOLINES_INLINE void load(const KernelTangent &tangent, const int q, const int begin, T *fields) const
    {
      constexpr int     together = 64 / (n_lanes * sizeof(float)); // in a line of the cache
      const std::size_t size = point_tangent_size(m) * n_lanes, first = q * size + begin * n_lanes;
      for (int i = 0; i < n; ++i)
        fields[i] = widened(tangent.high + first + i * n_lanes);
      for (int i = 0; i < n; i += together)
        __builtin_prefetch(tangent.high + n_points * size + first + i * n_lanes);
      if (tangent.low == nullptr)
        return;
      for (int i = 0; i < n; ++i)
        fields[i] += widened(tangent.low + first + i * n_lanes);
      for (int i = 0; i < n; i += together)
        __builtin_prefetch(tangent.low + n_points * size + first + i * n_lanes);
    }

    void add_state(const double w[3], const KernelTangent &tangent, T *flux, const KernelPressure *given)
    {
      T *of_u = F_rate;
      if (!m.keep_gradient)
        evaluate_unit_gradient(tangent.u, of_u);
      const T *of_laws = cells.n_laws > 0 ? law_actions(w, tangent, flux, of_u) : nullptr;
      // What a point has read of u makes room for its volume.
      add_points(w, tangent, flux, of_u, given, [&](const int q, const T *dF, T *dP, T *volume) MYOLINES_INLINED {
        T fields[tangent_size_rate], gradient[9];
        load<tangent_size_0>(tangent, q, 0, fields);
        if (m.rate)
          load<tangent_size_rate - tangent_size_0>(tangent, q, tangent_size_0, fields + tangent_size_0);
        else
          clear(fields + tangent_size_0, tangent_size_rate - tangent_size_0);
        gradient_of_deformation(tangent, of_u, q, gradient);
        tangent_action(m, material(q), Kinematics<T>(gradient), fields, dF, JxW(q), w[0], w[1], dP, volume);
        const T change = dot(volume, dF);
        if (of_laws != nullptr)
          for (int i = 0; i < 9; ++i)
            dP[i] += of_laws[9 * q + i];
        return change;
      });
    }

    void add_step(const double w[3], const KernelTangent &tangent, T *flux, const KernelPressure *given)
    {
      add_points(w, tangent, flux, F_rate, given, [&](const int q, const T *dF, T *dP, T *volume) MYOLINES_INLINED {
        T fields[step_by_rate + 81];
        load<step_by_rate>(tangent, q, 0, fields);
        if (m.velocities())
          load<81>(tangent, q, step_by_rate, fields + step_by_rate);
        else
          clear(fields + step_by_rate, 81);
        return step_action(w, fields, dF, dP, volume);
      });
    }

    /// F, as it was kept or by the gradient of the displacement in directions of the unit cell.
    MYOLINES_INLINE void gradient_of_deformation(const KernelTangent &tangent, const T *of_u, const int q, T *gradient) const
    {
      if (m.keep_gradient)
        return load<9>(tangent, q, point_tangent_size(m) - 9, gradient);
      from_unit(of_u, q, gradient);
      for (int i = 0; i < 9; i += 4)
        gradient[i] += T(1.);
    }

    /// @p flux: that of dF becomes that of dP JxW; @p volume: room for that of dP/dp JxW. action(q, dF, dP, volume) gives the last two at
    /// fixed pressure and returns dJ JxW.
    template <typename Action>
    MYOLINES_INLINE void add_points(const double w[3], const KernelTangent &tangent, T *flux, T *volume, const KernelPressure *given,
                                    const Action &action) const
    {
      const VolumeLayout layout(t.n_modes);
      const T           *stored = reinterpret_cast<const T *>(tangent.volume), *R = stored + layout.orthonormal;
      T                  moments[max_modes], dp[max_modes];
      clear(moments, t.n_modes);
      if (given != nullptr)
        {
          from_orthonormal(R, reinterpret_cast<const T *>(given->dp), dp);
          for (int i = 0; i < t.n_modes; ++i)
            dp[i] *= T(w[0]);
        }
      for (int q = 0; q < n_points; ++q)
        {
          T dF[9], dP[9], by_pressure[9];
          from_unit(flux, q, dF);
          const T change = action(q, dF, dP, by_pressure);
          for (int i = 0; i < t.n_modes; ++i)
            moments[i] += mode(q, i) * change;
          if (given != nullptr)
            {
              const T p = expand(dp, q);
              for (int i = 0; i < 9; ++i)
                dP[i] += p * by_pressure[i];
            }
          else
            to_unit(by_pressure, q, volume);
          to_unit(dP, q, flux);
        }
      if (given != nullptr)
        {
          T       *rows = reinterpret_cast<T *>(given->rows), Cz[max_modes];
          const T *z    = reinterpret_cast<const T *>(given->dp);
          moments_to_orthonormal(R, moments, rows);
          multiply_modes(stored + layout.compliance, z, Cz);
          for (int i = 0; i < t.n_modes; ++i)
            rows[i] -= Cz[i];
          return;
        }
      multiply_modes(stored + (m.softened ? layout.softened : layout.stiffness), moments, dp);
      for (int i = 0; i < t.n_modes; ++i)
        dp[i] *= T(w[0]);
      for (int q = 0; q < n_points; ++q)
        {
          const T p = expand(dp, q);
          for (int k = 0; k < 9; ++k)
            flux[k * n_points + q] += p * volume[k * n_points + q];
        }
    }

    /// dP of the laws at the points, [n_points][9], times JxW.
    const T *law_actions(const double w[3], const KernelTangent &tangent, const T *of_x, const T *of_u)
    {
      T *gradient = coefficients, *dF = gradient + 9 * n_points, *dP = dF + 9 * n_points, *rate = dP + 9 * n_points;
      for (int q = 0; q < n_points; ++q)
        {
          gradient_of_deformation(tangent, of_u, q, gradient + 9 * q);
          from_unit(of_x, q, dF + 9 * q);
        }
      if (m.viscous)
        evaluate_gradient(tangent.v, rate);
      clear(dP, 9 * n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        law_kernels<isa>(cells.laws[i])
            .action(cells.laws[i], law_points(gradient, 9, rate), law_weights(w), reinterpret_cast<const double *>(dF),
                    reinterpret_cast<double *>(dP));
      return dP;
    }
  };
} // namespace myolines
