// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_batch_step.h"

namespace myolines
{
  /// The kernels on one batch.
  template <InstructionSet isa, int n1>
  class BatchWork : private BatchStep<isa, n1>
  {
    using Base = BatchStep<isa, n1>;
    using T    = Lanes<isa>;
    using Base::add_forces;
    using Base::add_integral;
    using Base::add_rank;
    using Base::advance;
    using Base::Base;
    using Base::cells;
    using Base::change_of_pressure;
    using Base::clear;
    using Base::coefficients;
    using Base::columns;
    using Base::combine;
    using Base::dilatation;
    using Base::evaluate_F;
    using Base::evaluate_gradient;
    using Base::evaluate_values;
    using Base::expand;
    using Base::F;
    using Base::F_rate;
    using Base::fibres;
    using Base::fill_columns_of_state;
    using Base::fill_columns_of_step;
    using Base::filled_lanes_are;
    using Base::inverse;
    using Base::JxW;
    using Base::law_points;
    using Base::m;
    using Base::material;
    using Base::max_modes;
    using Base::missing;
    using Base::mode;
    using Base::n_nodes;
    using Base::n_points;
    using Base::orthonormal_modes;
    using Base::pressure;
    using Base::require_positive;
    using Base::step_actions;
    using Base::step_coefficients;
    using Base::step_stresses;
    using Base::step_tangents;
    using Base::stiffness_of_modes;
    using Base::store_volume;
    using Base::t;
    using Base::to_orthonormal;
    using Base::values;
    using Base::volumetric_state;
    using Base::work;

  public:
    static std::size_t scratch_size(const int n, const int n_modes)
    {
      return Base::scratch_size(n, n_modes) + std::size_t(n_lanes) * n * n * n * Base::step_scratch_size();
    }

    static bool residual(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *v,
                         const double *a, double *r, KernelForces &forces, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      return work.add_residual(u, v, a, r, forces);
    }

    static void local(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, double *z, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.evaluate_F(u);
      work.volumetric_state();
      for (int i = 0; i < t.n_modes; ++i)
        {
          reinterpret_cast<T *>(z)[i]             = work.dilatation[i];
          reinterpret_cast<T *>(z)[t.n_modes + i] = work.pressure[i];
        }
    }

    static void advance(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *dp, const double *trial_u,
                        const double alpha, double *trial_z, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.advance(reinterpret_cast<const T *>(dp), trial_u, alpha, reinterpret_cast<T *>(trial_z));
    }

    static void linearise(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *v,
                          double *tangent, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.store_tangent(u, v, reinterpret_cast<T *>(tangent));
    }

    static void apply(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double w[3], const double *tangent,
                      const double *x, double *y, const KernelPressure *pressure, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.add_apply(w, reinterpret_cast<const T *>(tangent), x, y, pressure);
    }

    static void volume(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, double *columns,
                       double *stiffness, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.fill_volume(u, reinterpret_cast<T *>(columns), reinterpret_cast<T *>(stiffness));
    }

    static void element_matrices(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double w[3], const double *u,
                                 const double *v, double *matrices, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.fill_matrices(w, u, v, reinterpret_cast<T *>(matrices));
    }

    static void points(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *v, double *values,
                       double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.fill_points(u, v, reinterpret_cast<T *>(values));
    }

  private:
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

    /// Stresses of the laws at the points, [n_points][9].
    void law_stresses(T *P)
    {
      clear(P, 9 * n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        law_kernels<isa>(cells.laws[i]).stress(cells.laws[i], law_points(F, 9, F_rate), reinterpret_cast<double *>(P));
    }

    LawWeights law_weights(const double w[3]) const { return {w[0], m.viscous ? w[1] : 0, !m.exact_tangent}; }

    bool add_residual(const double *u, const double *v, const double *a, double *r, KernelForces &forces)
    {
      if (!evaluate_state(u, v))
        return false;
      T          stress(0.), gap(0.), bulk(0.), volume(0.), *of_laws = coefficients;
      const bool step = m.before != nullptr;
      if (step)
        step_stresses(of_laws);
      else if (cells.n_laws > 0)
        law_stresses(of_laws);
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F + 9 * q);
          const PointLaw<T>   law(m, fibres, material(q), k, F_rate + 9 * q, expand(pressure, q));
          T                   P[9];
          if (!step)
            law.stress(P);
          if (step || cells.n_laws > 0)
            for (int i = 0; i < 9; ++i)
              P[i] = step ? of_laws[9 * q + i] : P[i] + of_laws[9 * q + i];
          const T weight = JxW(q);
          for (int i = 0; i < 9; ++i)
            work[9 * q + i] = P[i] * weight;
          const T wrong = (T(2.) * law.base.first + T(cells.law_shear)) * expand(missing, q);
          stress += dot(P, P) * weight;
          gap += wrong * wrong * weight;
          bulk += material(q)[material_bulk] * material(q)[material_bulk] * weight;
          volume += weight;
        }
      if (cells.n_laws > 0) // whose exponentials may overflow
        {
          T finite(1.);
          require_positive(T(std::numeric_limits<double>::max()) - stress, finite);
          if (!filled_lanes_are(finite))
            return false;
        }
      add_forces(u, stress, gap, bulk, cbrt(volume), forces);
      if (m.inertia)
        {
          evaluate_values(a);
          weigh_values(1);
        }
      add_integral(work, m.inertia ? values : nullptr, r);
      return true;
    }

    /// values *= factor rho0 JxW
    void weigh_values(const double factor)
    {
      for (int q = 0; q < n_points; ++q)
        {
          const T weight = T(factor) * material(q)[material_density] * JxW(q);
          for (int a = 0; a < 3; ++a)
            values[a * n_points + q] *= weight;
        }
    }

    void store_tangent(const double *u, const double *v, T *tangent)
    {
      evaluate_state(u, v);
      const int size   = point_tangent_size(m);
      T        *behind = tangent + n_points * size;
      store_volume(behind);
      if (m.before != nullptr)
        {
          step_tangents(tangent);
          return;
        }
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F + 9 * q);
          const PointLaw<T>   law(m, fibres, material(q), k, F_rate + 9 * q, expand(pressure, q));
          law.store(F_rate + 9 * q, JxW(q), tangent + q * size);
        }
      if (m.viscous)
        for (int i = 0; i < 9 * n_points; ++i)
          behind[VolumeLayout(t.n_modes).size + i] = F_rate[i];
    }

    /// The change of pressure is dp_h = phi S int phi cof F : dF, F that of the end in a step, unless one is given.
    void add_apply(const double w[3], const T *tangent, const double *x, double *y, const KernelPressure *given)
    {
      const bool inertia = m.inertia && w[2] != 0, stiffness = w[0] != 0 || (w[1] != 0 && m.velocities());
      if (!stiffness && !inertia)
        return;
      T *dF = F, *volume = F_rate, *flux = F; // work is taken by the interpolation
      if (!stiffness)
        evaluate_values(x);
      else
        {
          evaluate_gradient(x, dF, inertia ? values : nullptr);
          T moments[max_modes], dp[max_modes];
          clear(moments, t.n_modes);
          if (m.before != nullptr)
            step_actions(w, tangent, dF, flux, volume, moments);
          else
            state_actions(w, tangent, dF, flux, volume, moments);
          change_of_pressure(w[0], tangent + n_points * point_tangent_size(m), moments, given, dp);
          for (int q = 0; q < n_points; ++q)
            {
              const T change = expand(dp, q);
              for (int i = 0; i < 9; ++i)
                flux[9 * q + i] += change * volume[9 * q + i];
            }
        }
      if (inertia)
        weigh_values(w[2]);
      add_integral(stiffness ? flux : nullptr, inertia ? values : nullptr, y);
    }

    /// At fixed pressure @p flux = dP JxW, in the place of dF; @p volume = dP/dp JxW = cof F JxW; moments += int phi dJ.
    void state_actions(const double w[3], const T *tangent, const T *dF, T *flux, T *volume, T *moments)
    {
      const int size    = point_tangent_size(m);
      T        *of_laws = coefficients;
      if (cells.n_laws > 0)
        law_actions(w, tangent, size, dF, of_laws);
      for (int q = 0; q < n_points; ++q)
        {
          T dP[9];
          tangent_action(m, material(q), tangent + q * size, dF + 9 * q, JxW(q), w[0], w[1], dP, volume + 9 * q);
          const T change = dot(volume + 9 * q, dF + 9 * q);
          for (int i = 0; i < t.n_modes; ++i)
            moments[i] += mode(q, i) * change;
          for (int i = 0; i < 9; ++i)
            flux[9 * q + i] = dP[i];
          if (cells.n_laws > 0)
            for (int i = 0; i < 9; ++i)
              flux[9 * q + i] += of_laws[9 * q + i];
        }
    }

    /// dP of the laws at the points, [n_points][9], times JxW.
    void law_actions(const double w[3], const T *tangent, const int size, const T *dF, T *dP) const
    {
      clear(dP, 9 * n_points);
      const LawPoints points = law_points(tangent + tangent_F, size, tangent + n_points * size + VolumeLayout(t.n_modes).size);
      for (int i = 0; i < cells.n_laws; ++i)
        law_kernels<isa>(cells.laws[i])
            .action(cells.laws[i], points, law_weights(w), reinterpret_cast<const double *>(dF), reinterpret_cast<double *>(dP));
    }

    void fill_matrices(const double w[3], const double *u, const double *v, T *matrices)
    {
      clear(matrices, 9 * n_nodes * n_nodes);
      const bool inertia = m.inertia && w[2] != 0, stiffness = w[0] != 0 || (w[1] != 0 && m.velocities());
      if (inertia)
        for (int q = 0; q < n_points; ++q)
          values[q] = T(w[2]) * material(q)[material_density] * JxW(q);
      if (stiffness)
        {
          evaluate_state(u, v);
          if (m.before != nullptr)
            step_coefficients(w);
          else
            state_coefficients(w);
        }
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          if (stiffness || (inertia && a == b))
            integrate_pairs<n1>(t, stiffness ? coefficients + (3 * a + b) * 9 * n_points : nullptr, n_points,
                                inertia && a == b ? values : nullptr, matrices + (3 * a + b) * n_nodes * n_nodes);
      if (w[0] != 0)
        add_volumetric_rank(w[0], matrices);
    }

    /// matrices += w A^T S B; A and B are the same but in a step.
    void add_volumetric_rank(const double w, T *matrices)
    {
      constexpr int n = max_modes * 3 * n_nodes;
      T            *B = columns, *A = m.before != nullptr ? B + n : B;
      fill_columns_of_state(B);
      if (m.before != nullptr)
        fill_columns_of_step(A);
      add_rank(w, A, B, columns + 2 * n, matrices);
    }

    void fill_volume(const double *u, T *orthonormal, T *stiffness)
    {
      evaluate_F(u);
      volumetric_state();
      const int n = 3 * n_nodes;
      T         R[max_modes * max_modes], E[max_modes * max_modes];
      orthonormal_modes(R);
      stiffness_of_modes(m.softened, E);
      to_orthonormal(R, E, stiffness);
      fill_columns_of_state(columns);
      combine(R, columns, orthonormal, n);
      if (m.before == nullptr)
        return;
      fill_columns_of_step(columns);
      combine(R, columns, orthonormal + t.n_modes * n, n);
    }

    void state_coefficients(const double w[3])
    {
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F + 9 * q);
          const PointLaw<T>   law(m, fibres, material(q), k, F_rate + 9 * q, expand(pressure, q));
          T                   LF[9];
          if (m.rate)
            law.curvature(F_rate + 9 * q, LF);
          law.coefficients(&inverse(q, 0), LF, w[0], w[1], JxW(q), coefficients + q, 9 * n_points, n_points);
        }
      for (int i = 0; i < cells.n_laws; ++i)
        law_kernels<isa>(cells.laws[i])
            .coefficients(cells.laws[i], law_points(F, 9, F_rate), law_weights(w), reinterpret_cast<double *>(coefficients));
    }

    void fill_points(const double *u, const double *v, T *out)
    {
      T *displacement = coefficients, *velocity = coefficients + 3 * n_points;
      evaluate_F(u, F, displacement);
      volumetric_state();
      clear(velocity, 3 * n_points);
      clear(F_rate, 9 * n_points);
      if (v)
        evaluate_gradient(v, F_rate, velocity);
      for (int q = 0; q < n_points; ++q)
        {
          T *point = out + std::size_t(q) * n_point_values;
          for (int i = 0; i < 9; ++i)
            {
              point[point_F + i]      = F[9 * q + i];
              point[point_F_rate + i] = F_rate[9 * q + i];
            }
          for (int c = 0; c < 3; ++c)
            {
              point[point_displacement + c] = displacement[c * n_points + q];
              point[point_velocity + c]     = velocity[c * n_points + q];
            }
          point[point_pressure]   = expand(pressure, q);
          point[point_dilatation] = expand(dilatation, q);
          point[point_JxW]        = JxW(q);
        }
    }
  };

  template <InstructionSet isa, int n1>
  constexpr Kernels make_kernels()
  {
    using Work = BatchWork<isa, n1>;
    return {&Work::residual,         &Work::local,  &Work::advance,     &Work::linearise, &Work::apply, &Work::volume,
            &Work::element_matrices, &Work::points, &Work::scratch_size};
  }
} // namespace myolines
