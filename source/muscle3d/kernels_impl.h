#pragma once

#include "kernels_point.h"
#include "kernels_sum_factorisation.h"

namespace myolines
{
  /// One batch at work: its state at the Gauss points, in scratch storage.
  template <InstructionSet isa, int n1>
  class BatchWork
  {
    using T                      = Lanes<isa>;
    static constexpr int n_nodes = n1 * n1 * n1;
    static constexpr int max_modes = 10;

  public:
    static std::size_t scratch_size(const int n, const int /*n_modes*/)
    {
      // Three gradients, the coefficients of the tangent, values of three components, and the volumetric columns.
      return std::size_t(n_lanes) * (n * n * n * (9 + 9 + 9 + 81 + 3) + 2 * max_modes * 3 * n_nodes);
    }

    BatchWork(const KernelTables &tables, const KernelModel &model, const KernelCells &cells, double *scratch)
      : t(tables)
      , m(model)
      , cells(cells)
      , n_points(t.n_points_1d * t.n_points_1d * t.n_points_1d)
      , F(reinterpret_cast<T *>(scratch))
      , F_rate(F + 9 * n_points)
      , work(F_rate + 9 * n_points)
      , coefficients(work + 9 * n_points)
      , values(coefficients + 81 * n_points)
      , columns(values + 3 * n_points)
    {}

    static bool residual(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *v, const double *a, double *r, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      return work.add_residual(u, v, a, r);
    }

    static void apply(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double w[3], const double *u, const double *v, const double *x, double *y, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.add_apply(w, u, v, x, y);
    }

    static void element_matrices(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double w[3], const double *u, const double *v, double *matrices, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.fill_matrices(w, u, v, reinterpret_cast<T *>(matrices));
    }

    static void points(const KernelTables &t, const KernelModel &m, const KernelCells &c, const double *u, const double *v, double *values, double *scratch)
    {
      BatchWork work(t, m, c, scratch);
      work.fill_points(u, v, reinterpret_cast<T *>(values));
    }

  private:
    const T &inverse(const int q, const int k) const { return reinterpret_cast<const T *>(cells.geometry + std::size_t(q) * cells.geometry_stride)[k]; }
    T        JxW(const int q) const { return inverse(q, 9) * T(t.weight[q]); }
    T        mode(const int q, const int i) const { return T(t.modes[q * t.n_modes + i]); }

    void gather(const double *x, T *nodal) const
    {
      for (int i = 0; i < n_nodes; ++i)
        for (int lane = 0; lane < n_lanes; ++lane)
          {
            const double *at = x + 3 * std::size_t(cells.nodes[i * n_lanes + lane]);
            for (int c = 0; c < 3; ++c)
              nodal[c * n_nodes + i].v[lane] = at[c];
          }
    }

    void scatter(const T *nodal, double *x) const
    {
      for (int i = 0; i < n_nodes; ++i)
        for (int lane = 0; lane < cells.n_filled; ++lane)
          {
            double *at = x + 3 * std::size_t(cells.nodes[i * n_lanes + lane]);
            for (int c = 0; c < 3; ++c)
              at[c] += nodal[c * n_nodes + i].v[lane];
          }
    }

    /// gradient[9 q + 3 a + J] = d x_a / d X_J, and the values if wanted ([3][n_points]).
    void evaluate_gradient(const double *x, T *gradient, T *value = nullptr)
    {
      T nodal[3 * n_nodes];
      gather(x, nodal);
      for (int a = 0; a < 3; ++a)
        {
          T *reference = work; // [3][n_points]
          interpolate<n1>(t, nodal + a * n_nodes, value ? value + a * n_points : nullptr, reference);
          for (int q = 0; q < n_points; ++q)
            for (int J = 0; J < 3; ++J)
              gradient[9 * q + 3 * a + J] = reference[q] * inverse(q, J) + reference[n_points + q] * inverse(q, 3 + J) + reference[2 * n_points + q] * inverse(q, 6 + J);
        }
    }

    void evaluate_values(const double *x)
    {
      T nodal[3 * n_nodes];
      gather(x, nodal);
      for (int a = 0; a < 3; ++a)
        interpolate<n1>(t, nodal + a * n_nodes, values + a * n_points, static_cast<T *>(nullptr));
    }

    void evaluate_F(const double *u)
    {
      evaluate_gradient(u, F);
      for (int q = 0; q < n_points; ++q)
        for (int i = 0; i < 9; i += 4)
          F[9 * q + i] += T(1.);
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

    static void clear(T *x, const int n)
    {
      for (int i = 0; i < n; ++i)
        x[i] = T(0.);
    }

    /// Dilatation D_h = Pi(J) and pressure p_h = Pi(Psi_vol'(D_h)). False if J <= 0, D_h <= 0 or NaN in a filled lane.
    bool volumetric_state()
    {
      T    moments[max_modes];
      T    admissible(1.);
      const auto require_positive = [&](const T &x) { admissible = select(x > T(0.), admissible, T(-1.)); };
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F + 9 * q);
          require_positive(k.J);
          add_moments(k.J, q, moments);
        }
      project(moments, dilatation);
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const T D = expand(dilatation, q);
          require_positive(D);
          add_moments(T(0.5 * m.tissue.bulk_modulus) * (D - T(1.) / D), q, moments);
        }
      project(moments, pressure);
      for (int lane = 0; lane < cells.n_filled; ++lane)
        if (admissible.v[lane] < 0)
          return false;
      return true;
    }

    /// Adds sum_q P : Grad N_i (flux[9 q + 3 a + J] = P_aJ JxW) and sum_q N_i values (if given) to x.
    void add_integral(T *flux, const T *value, double *x)
    {
      T nodal[3 * n_nodes];
      clear(nodal, 3 * n_nodes);
      T *reference = coefficients;
      for (int a = 0; a < 3; ++a)
        {
          if (flux)
            for (int q = 0; q < n_points; ++q)
              for (int A = 0; A < 3; ++A)
                reference[A * n_points + q] =
                  flux[9 * q + 3 * a] * inverse(q, 3 * A) + flux[9 * q + 3 * a + 1] * inverse(q, 3 * A + 1) + flux[9 * q + 3 * a + 2] * inverse(q, 3 * A + 2);
          integrate<n1>(t, value ? value + a * n_points : nullptr, flux ? reference : nullptr, nodal + a * n_nodes);
        }
      scatter(nodal, x);
    }

    bool add_residual(const double *u, const double *v, const double *a, double *r)
    {
      evaluate_F(u);
      if (!volumetric_state())
        return false;
      if (m.rate)
        evaluate_gradient(v, F_rate);
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F + 9 * q);
          const PointLaw<T>   law(m, k, F_rate + 9 * q, expand(pressure, q));
          T                   P[9];
          law.stress(P);
          const T weight = JxW(q);
          for (int i = 0; i < 9; ++i)
            work[9 * q + i] = P[i] * weight;
        }
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
          const T weight = T(factor * m.tissue.density) * JxW(q);
          for (int a = 0; a < 3; ++a)
            values[a * n_points + q] *= weight;
        }
    }

    void add_apply(const double w[3], const double *u, const double *v, const double *x, double *y)
    {
      const bool inertia = m.inertia && w[2] != 0, stiffness = w[0] != 0 || (w[1] != 0 && m.rate);
      if (stiffness)
        {
          evaluate_F(u);
          volumetric_state();
          if (m.rate)
            evaluate_gradient(v, F_rate);
          T *dF = coefficients + 9 * n_points; // the first 9 n are wanted by add_integral
          evaluate_gradient(x, dF);
          T dp[max_modes];
          volumetric_change(dF, dp);
          for (int q = 0; q < n_points; ++q)
            {
              const Kinematics<T> k(F + 9 * q);
              const PointLaw<T>   law(m, k, F_rate + 9 * q, expand(pressure, q));
              T                   LF[9], dP[9];
              if (m.rate)
                law.curvature(F_rate + 9 * q, LF);
              law.tangent(dF + 9 * q, T(w[0]) * expand(dp, q), LF, w[0], w[1], dP);
              const T weight = JxW(q);
              for (int i = 0; i < 9; ++i)
                work[9 * q + i] = dP[i] * weight;
            }
        }
      if (inertia)
        {
          evaluate_values(x);
          weigh_values(w[2]);
        }
      if (stiffness || inertia)
        add_integral(stiffness ? work : nullptr, inertia ? values : nullptr, y);
    }

    /// dp_h = Pi(Psi_vol''(D_h) Pi(cof F : dF))
    void volumetric_change(const T *dF, T *dp) const
    {
      T moments[max_modes], dD[max_modes];
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const Kinematics<T> k(F + 9 * q);
          add_moments(k.J * dot(k.H, dF + 9 * q), q, moments);
        }
      project(moments, dD);
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        add_moments(volumetric_stiffness(q) * expand(dD, q), q, moments);
      project(moments, dp);
    }

    /// Psi_vol'' at a point
    T volumetric_stiffness(const int q) const
    {
      const T D = expand(dilatation, q);
      return T(0.5 * m.tissue.bulk_modulus) * (T(1.) + T(1.) / (D * D));
    }

    void fill_matrices(const double w[3], const double *u, const double *v, T *matrices)
    {
      clear(matrices, 9 * n_nodes * n_nodes);
      const bool inertia = m.inertia && w[2] != 0, stiffness = w[0] != 0 || (w[1] != 0 && m.rate);
      if (inertia)
        for (int q = 0; q < n_points; ++q)
          values[q] = T(w[2] * m.tissue.density) * JxW(q);
      if (stiffness)
        {
          evaluate_F(u);
          volumetric_state();
          if (m.rate)
            evaluate_gradient(v, F_rate);
          for (int q = 0; q < n_points; ++q)
            {
              const Kinematics<T> k(F + 9 * q);
              const PointLaw<T>   law(m, k, F_rate + 9 * q, expand(pressure, q));
              T                   LF[9];
              if (m.rate)
                law.curvature(F_rate + 9 * q, LF);
              law.coefficients(&inverse(q, 0), LF, w[0], w[1], JxW(q), coefficients + q, 9 * n_points, n_points);
            }
        }
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          if (stiffness || (inertia && a == b))
            integrate_pairs<n1>(t,
                                stiffness ? coefficients + (3 * a + b) * 9 * n_points : nullptr,
                                n_points,
                                inertia && a == b ? values : nullptr,
                                matrices + (3 * a + b) * n_nodes * n_nodes);
      if (w[0] != 0)
        add_volumetric_rank(w[0], matrices);
    }

    /// matrices += w B^T S B, B_m(n, b) = int phi_m cof F : Grad N_n e_b, S = M_p^(-1) [int Psi'' phi phi^T] M_p^(-1).
    void add_volumetric_rank(const double w, T *matrices)
    {
      const int n_modes = t.n_modes, n = 3 * n_nodes;
      T *       B = columns, *SB = columns + max_modes * n; // [mode][component][node]
      clear(B, n_modes * n);
      T *reference = work; // [3][n_points]
      for (int b = 0; b < 3; ++b)
        for (int i = 0; i < n_modes; ++i)
          {
            for (int q = 0; q < n_points; ++q)
              {
                const Kinematics<T> k(F + 9 * q);
                const T             weight = mode(q, i) * JxW(q) * k.J;
                for (int A = 0; A < 3; ++A)
                  reference[A * n_points + q] =
                    weight * (k.H[3 * b] * inverse(q, 3 * A) + k.H[3 * b + 1] * inverse(q, 3 * A + 1) + k.H[3 * b + 2] * inverse(q, 3 * A + 2));
              }
            integrate<n1>(t, static_cast<T *>(nullptr), reference, B + i * n + b * n_nodes);
          }

      T S[max_modes * max_modes];
      volumetric_modes(w, S);
      for (int i = 0; i < n_modes; ++i)
        for (int j = 0; j < n; ++j)
          {
            T s(0.);
            for (int k = 0; k < n_modes; ++k)
              s += S[i * n_modes + k] * B[k * n + j];
            SB[i * n + j] = s;
          }
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          for (int i = 0; i < n_nodes; ++i)
            for (int k = 0; k < n_modes; ++k)
              {
                const T  left = B[k * n + a * n_nodes + i];
                const T *right = SB + k * n + b * n_nodes;
                T *      row   = matrices + ((3 * a + b) * n_nodes + i) * n_nodes;
                for (int j = 0; j < n_nodes; ++j)
                  row[j] += left * right[j];
              }
    }

    /// S of add_volumetric_rank, times w.
    void volumetric_modes(const double w, T *S) const
    {
      const int n_modes = t.n_modes;
      T         moments[max_modes * max_modes], half[max_modes * max_modes];
      clear(moments, n_modes * n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const T weight = T(w) * volumetric_stiffness(q) * JxW(q);
          for (int i = 0; i < n_modes; ++i)
            for (int j = 0; j < n_modes; ++j)
              moments[i * n_modes + j] += weight * mode(q, i) * mode(q, j);
        }
      const T *mass = reinterpret_cast<const T *>(cells.inverse_mode_mass);
      multiply(mass, moments, half);
      multiply(half, mass, S);
    }

    void multiply(const T *x, const T *y, T *xy) const
    {
      const int n = t.n_modes;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          {
            T s(0.);
            for (int k = 0; k < n; ++k)
              s += x[i * n + k] * y[k * n + j];
            xy[i * n + j] = s;
          }
    }

    void fill_points(const double *u, const double *v, T *out)
    {
      T *displacement = coefficients, *velocity = coefficients + 3 * n_points;
      evaluate_gradient(u, F, displacement);
      for (int q = 0; q < n_points; ++q)
        for (int i = 0; i < 9; i += 4)
          F[9 * q + i] += T(1.);
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

    const KernelTables &t;
    const KernelModel & m;
    const KernelCells & cells;
    const int           n_points;
    T *                 F;            ///< [n_points][9]
    T *                 F_rate;       ///< [n_points][9]
    T *                 work;         ///< [n_points][9]
    T *                 coefficients; ///< [9][9][n_points] of the tangent, else free
    T *                 values;       ///< [3][n_points]
    T *                 columns;      ///< [2][n_modes][3][n_nodes]
    T                   dilatation[max_modes];
    T                   pressure[max_modes];
  };

  template <InstructionSet isa, int n1>
  constexpr Kernels make_kernels()
  {
    using Work = BatchWork<isa, n1>;
    return {&Work::residual, &Work::apply, &Work::element_matrices, &Work::points, &Work::scratch_size};
  }
} // namespace myolines
