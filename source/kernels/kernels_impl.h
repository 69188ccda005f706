// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_action.h"

namespace myolines
{
  /// The kernels on one batch.
  template <InstructionSet isa, int n1>
  class BatchWork : private BatchAction<isa, n1>
  {
    using Base = BatchAction<isa, n1>;
    using T    = Lanes<isa>;
    using Base::add_apply;
    using Base::add_forces;
    using Base::add_integral;
    using Base::add_rank;
    using Base::advance;
    using Base::Base;
    using Base::cells;
    using Base::clear;
    using Base::coefficients;
    using Base::cofactors;
    using Base::columns;
    using Base::dilatation;
    using Base::evaluate_F;
    using Base::evaluate_gradient;
    using Base::evaluate_state;
    using Base::evaluate_values;
    using Base::expand;
    using Base::F;
    using Base::F_rate;
    using Base::fibres;
    using Base::fill_columns;
    using Base::fill_stiffness;
    using Base::filled_lanes_are;
    using Base::inverse;
    using Base::JxW;
    using Base::law_points;
    using Base::law_weights;
    using Base::m;
    using Base::material;
    using Base::max_modes;
    using Base::missing;
    using Base::n_nodes;
    using Base::n_points;
    using Base::pressure;
    using Base::require_positive;
    using Base::step_coefficients;
    using Base::step_stresses;
    using Base::store_tangent;
    using Base::t;
    using Base::values;
    using Base::volume_of_step;
    using Base::volumetric_state;
    using Base::weigh_values;
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

    static void linearise(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *v, float *high,
                          float *low, double *volume, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.store_tangent(u, v, high, low, reinterpret_cast<T *>(volume));
    }

    static void apply(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double w[3], const KernelTangent &tangent,
                      const double *x, double *y, const KernelPressure *pressure, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.add_apply(w, tangent, x, y, pressure);
    }

    static void stiffness(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, double *W, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.fill_stiffness(u, reinterpret_cast<T *>(W));
    }

    static void condense(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *W,
                         const double *b, double *y, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.Base::condense(u, reinterpret_cast<const T *>(W), reinterpret_cast<const T *>(b), y);
    }

    static void recover(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *W,
                        const double weight, const double *x, const double *b, double *z, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.Base::recover(u, reinterpret_cast<const T *>(W), weight, x, reinterpret_cast<const T *>(b), reinterpret_cast<T *>(z));
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
    /// Stresses of the laws at the points, [n_points][9].
    void law_stresses(T *P)
    {
      clear(P, 9 * n_points);
      for (int i = 0; i < cells.n_laws; ++i)
        law_kernels<isa>(cells.laws[i]).stress(cells.laws[i], law_points(F, 9, F_rate), reinterpret_cast<double *>(P));
    }

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
      cofactors(F_rate);
      fill_columns(F_rate, B);
      if (m.before != nullptr)
        {
          volume_of_step(F_rate);
          fill_columns(F_rate, A);
        }
      add_rank(w, A, B, columns + 2 * n, matrices);
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
    return {&Work::residual, &Work::local,   &Work::advance,          &Work::linearise, &Work::apply,       &Work::stiffness,
            &Work::condense, &Work::recover, &Work::element_matrices, &Work::points,    &Work::scratch_size};
  }
} // namespace myolines
