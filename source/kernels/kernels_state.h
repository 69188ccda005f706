// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_step.h"
#include "kernels_sum_factorisation.h"

#include <myolines/materials/volume_energy.h>

#include <limits>

namespace myolines
{
  /// One batch of cells: its nodal values, its state at the Gauss points, in scratch storage, and integrals over it.
  template <InstructionSet isa, int n1>
  class BatchState
  {
  public:
    using T                        = Lanes<isa>;
    static constexpr int n_nodes   = n1 * n1 * n1;
    static constexpr int max_modes = 10;

    static std::size_t scratch_size(const int n, const int /*n_modes*/)
    {
      // Four gradients, the coefficients of the tangent, values of three components, and three sets of volumetric columns.
      return std::size_t(n_lanes) * (n * n * n * (9 + 9 + 9 + 81 + 3 + 9) + 3 * max_modes * 3 * n_nodes);
    }

    BatchState(const KernelTables &tables, const KernelModel &model, const KernelCells &cells, double *scratch)
      : t(tables)
      , m(model)
      , cells(cells)
      , fibres{cells.muscle, cells.muscle && m.active, m.rate, cells.tendon, &m.activation, &m.curves}
      , n_points(t.n_points_1d * t.n_points_1d * t.n_points_1d)
      , F(reinterpret_cast<T *>(scratch))
      , F_rate(F + 9 * n_points)
      , work(F_rate + 9 * n_points)
      , coefficients(work + 9 * n_points)
      , values(coefficients + 81 * n_points)
      , F_before(values + 3 * n_points)
      , columns(F_before + 9 * n_points)
      , of_step(columns + 3 * max_modes * 3 * n_nodes)
    {}

    const T &inverse(const int q, const int k) const
    {
      return reinterpret_cast<const T *>(cells.geometry + std::size_t(q) * cells.geometry_stride)[k];
    }
    const T *material(const int q) const { return reinterpret_cast<const T *>(cells.material + std::size_t(q) * cells.material_stride); }
    T        JxW(const int q) const { return inverse(q, 9) * T(t.weight[q]); }
    T        mode(const int q, const int i) const { return T(t.modes[q * t.n_modes + i]); }

    /// The points as laws see them: F of point q at F + q * stride, Fdot at F_rate + 9 q.
    LawPoints law_points(const T *F, const int stride, const T *F_rate) const
    {
      return {n_points,
              reinterpret_cast<const double *>(F),
              std::size_t(stride) * n_lanes,
              m.viscous ? reinterpret_cast<const double *>(F_rate) : nullptr,
              cells.material,
              cells.material_stride,
              cells.geometry,
              cells.geometry_stride,
              t.weight,
              &m.activation,
              &m.curves};
    }

    void gather(const double *x, T *nodal) const
    {
      for (int i = 0; i < n_nodes; ++i)
        for (int lane = 0; lane < n_lanes; ++lane)
          {
            const double *at = x + 3 * std::size_t(cells.nodes[i * n_lanes + lane]);
            for (int c = 0; c < 3; ++c)
              nodal[c * n_nodes + i].set(lane, at[c]);
          }
    }

    /// Lanes behind the last cell repeat it (CellBatches): what they hold is not added.
    void scatter(const T *nodal, double *x) const
    {
      for (int i = 0; i < n_nodes; ++i)
        for (int lane = 0; lane < cells.n_filled; ++lane)
          {
            double *at = x + 3 * std::size_t(cells.nodes[i * n_lanes + lane]);
            for (int c = 0; c < 3; ++c)
              at[c] += nodal[c * n_nodes + i][lane];
          }
    }

    /// gradient[9 q + 3 a + J] = d x_a / d X_J, and the values if wanted ([3][n_points]).
    void evaluate_gradient(const double *x, T *gradient, T *value = nullptr)
    {
      evaluate_unit_gradient(x, work, value);
      for (int q = 0; q < n_points; ++q)
        from_unit(work, q, gradient + 9 * q);
    }

    /// gradient[(3 a + A) n_points + q] = d x_a / d xi_A, and the values if wanted ([3][n_points]).
    void evaluate_unit_gradient(const double *x, T *gradient, T *value = nullptr) const
    {
      T nodal[3 * n_nodes];
      gather(x, nodal);
      for (int a = 0; a < 3; ++a)
        interpolate<n1>(t, nodal + a * n_nodes, value ? value + a * n_points : nullptr, gradient + 3 * a * n_points);
    }

    void evaluate_values(const double *x)
    {
      T nodal[3 * n_nodes];
      gather(x, nodal);
      for (int a = 0; a < 3; ++a)
        interpolate<n1>(t, nodal + a * n_nodes, values + a * n_points, static_cast<T *>(nullptr));
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

    /// And F_before and its dilatation, of a step.
    void evaluate_F(const double *u)
    {
      evaluate_F(u, F);
      if (m.before == nullptr)
        return;
      evaluate_F(m.before, F_before);
      T moments[max_modes];
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        add_moments(Kinematics<T>(F_before + 9 * q).J, q, moments);
      project(moments, earlier);
    }

    void evaluate_F(const double *u, T *gradient, T *value = nullptr)
    {
      evaluate_gradient(u, gradient, value);
      for (int q = 0; q < n_points; ++q)
        for (int i = 0; i < 9; i += 4)
          gradient[9 * q + i] += T(1.);
    }

    /// c = (mass of the modes)^(-1) moments
    void project(const T *moments, T *c) const
    {
      const T *mass = reinterpret_cast<const T *>(cells.inverse_mode_mass);
      for (int i = 0; i < t.n_modes; ++i)
        {
          c[i] = T(0.);
          for (int j = 0; j < t.n_modes; ++j)
            c[i] += mass[i * t.n_modes + j] * moments[j];
        }
    }

    T expand(const T *c, const int q) const
    {
      T x(0.);
      for (int i = 0; i < t.n_modes; ++i)
        x += mode(q, i) * c[i];
      return x;
    }

    void add_moments(const T &x, const int q, T *moments) const
    {
      const T weighted = x * JxW(q);
      for (int i = 0; i < t.n_modes; ++i)
        moments[i] += mode(q, i) * weighted;
    }

    const T *local() const { return reinterpret_cast<const T *>(cells.local); }

    /// Written as it is so that NaN, which is not above zero, is refused as well.
    static void require_positive(const T &x, T &admissible) { admissible = select(x > T(0.), admissible, T(-1.)); }

    bool filled_lanes_are(const T &admissible) const
    {
      for (int lane = 0; lane < cells.n_filled; ++lane)
        if (admissible[lane] < 0)
          return false;
      return true;
    }

    static void clear(T *x, const int n)
    {
      for (int i = 0; i < n; ++i)
        x[i] = T(0.);
    }

    VolumeEnergy<T> volume_energy(const int q) const { return {m.volume_form, material(q)[material_bulk]}; }

    /// Psi_vol' and Psi_vol'' at a point of dilatation D, or what they are between two states. As Psi_vol is convex, what dissipates has
    /// the sign of the change.
    T volumetric_stress(const int q, const T &D) const
    {
      const VolumeEnergy<T> energy = volume_energy(q);
      if (m.before == nullptr)
        return energy.stress(D);
      const T D_0 = expand(earlier, q), secant = energy.secant(D_0, D).value;
      return m.dissipation == 0 ? secant : secant + T(m.dissipation / 2) * (energy.stress(D) - energy.stress(D_0));
    }
    T volumetric_stiffness(const int q, const T &D) const
    {
      const VolumeEnergy<T> energy = volume_energy(q);
      if (m.before == nullptr)
        return energy.stiffness(D);
      const T slope = energy.secant(expand(earlier, q), D).slope;
      return m.dissipation == 0 ? slope : slope + T(m.dissipation / 2) * energy.stiffness(D);
    }

    /// Dilatation and pressure of the state at F, see KernelCells::local. False if J <= 0, D <= 0 or NaN in a filled lane.
    bool volumetric_state()
    {
      T moments[max_modes], projected[max_modes], admissible(1.);
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const T J = Kinematics<T>(F + 9 * q).J;
          require_positive(J, admissible);
          add_moments(J, q, moments);
        }
      project(moments, projected);
      // D is an iterate of its own beside u, or Pi(J). In the latter case `missing` is zero, and `linearised` below is Pi(Psi'(D)).
      const T *z = cells.local != nullptr ? local() : projected;
      for (int i = 0; i < t.n_modes; ++i)
        {
          dilatation[i] = z[i];
          missing[i]    = projected[i] - z[i];
        }
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const T D = expand(dilatation, q);
          require_positive(D, admissible);
          add_moments(volumetric_stress(q, D) + volumetric_stiffness(q, D) * (expand(projected, q) - D), q, moments);
        }
      project(moments, linearised);
      for (int i = 0; i < t.n_modes; ++i)
        pressure[i] = cells.local != nullptr ? z[t.n_modes + i] : linearised[i];
      return filled_lanes_are(admissible);
    }

    /// @p stress, @p gap and @p bulk: integrals of the squares; @p h: the size of the cells.
    void add_forces(const double *u, const T &stress, const T &gap, const T &bulk, const T &h, KernelForces &forces) const
    {
      constexpr double eps = std::numeric_limits<double>::epsilon();
      for (int lane = 0; lane < cells.n_filled; ++lane)
        {
          const double *at     = u + 3 * std::size_t(cells.nodes[lane]);
          const double  change = eps * (1 + __builtin_sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) / h[lane]);
          forces.internal += stress[lane] * h[lane];
          forces.volume += gap[lane] * h[lane];
          forces.rounding += bulk[lane] * h[lane] * change * change;
        }
    }

    /// Adds sum_q P : Grad N_i (flux[9 q + 3 a + J] = P_aJ JxW) and sum_q N_i values (if given) to x.
    void add_integral(const T *flux, const T *value, double *x)
    {
      T *unit = coefficients;
      for (int q = 0; flux != nullptr && q < n_points; ++q)
        to_unit(flux + 9 * q, q, unit);
      add_unit_integral(flux ? unit : nullptr, value, x);
    }

    /// The same of a flux in the directions of the unit cell, unit[(3 a + A) n_points + q] = P_aJ JxW dxi_A/dX_J.
    void add_unit_integral(const T *unit, const T *value, double *x) const
    {
      T nodal[3 * n_nodes];
      clear(nodal, 3 * n_nodes);
      for (int a = 0; a < 3; ++a)
        integrate<n1>(t, value ? value + a * n_points : nullptr, unit ? unit + 3 * a * n_points : nullptr, nodal + a * n_nodes);
      scatter(nodal, x);
    }

    /// unit[(3 a + A) n_points + q] = flux_aJ dxi_A/dX_J
    MYOLINES_INLINE void to_unit(const T *flux, const int q, T *unit) const
    {
      for (int a = 0; a < 3; ++a)
        for (int A = 0; A < 3; ++A)
          unit[(3 * a + A) * n_points + q] =
              flux[3 * a] * inverse(q, 3 * A) + flux[3 * a + 1] * inverse(q, 3 * A + 1) + flux[3 * a + 2] * inverse(q, 3 * A + 2);
    }

    /// gradient_aJ = d x_a / d xi_A dxi_A/dX_J at point q, of evaluate_unit_gradient().
    MYOLINES_INLINE void from_unit(const T *unit, const int q, T *gradient) const
    {
      for (int a = 0; a < 3; ++a)
        for (int J = 0; J < 3; ++J)
          gradient[3 * a + J] = unit[3 * a * n_points + q] * inverse(q, J) + unit[(3 * a + 1) * n_points + q] * inverse(q, 3 + J) +
                                unit[(3 * a + 2) * n_points + q] * inverse(q, 6 + J);
    }

    const KernelTables &t;
    const KernelModel  &m;
    const KernelCells  &cells;
    const FibreTerms    fibres;
    const int           n_points;
    T                  *F;            ///< [n_points][9]
    T                  *F_rate;       ///< [n_points][9]
    T                  *work;         ///< [n_points][9]
    T                  *coefficients; ///< [9][9][n_points] of the tangent, else free
    T                  *values;       ///< [3][n_points]
    T                  *F_before;     ///< [n_points][9], of a step
    T                  *columns;      ///< [3][max_modes][3][n_nodes]
    T                  *of_step;      ///< see BatchStep
    T                   dilatation[max_modes];
    T                   pressure[max_modes];
    T                   linearised[max_modes]; ///< Pi(Psi_vol'(D) + Psi_vol''(D) (Pi(J) - D))
    T                   missing[max_modes];    ///< Pi(J) - D
    T                   earlier[max_modes];    ///< D at the beginning of a step
  };
} // namespace myolines
