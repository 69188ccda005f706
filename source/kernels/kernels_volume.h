// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "kernels_state.h"

namespace myolines
{
  /// The volume of a batch: stiffness and compliance of its modes, columns of the displacements.
  template <InstructionSet isa, int n1>
  class BatchVolume : public BatchState<isa, n1>
  {
    using Base = BatchState<isa, n1>;
    using T    = Lanes<isa>;

  protected:
    using Base::add_moments;
    using Base::cells;
    using Base::clear;
    using Base::dilatation;
    using Base::evaluate_F;
    using Base::expand;
    using Base::F;
    using Base::F_rate;
    using Base::inverse;
    using Base::JxW;
    using Base::linearised;
    using Base::local;
    using Base::m;
    using Base::material;
    using Base::max_modes;
    using Base::mode;
    using Base::n_nodes;
    using Base::n_points;
    using Base::pressure;
    using Base::project;
    using Base::require_positive;
    using Base::t;
    using Base::volumetric_state;
    using Base::volumetric_stiffness;
    using Base::volumetric_stress;
    using Base::work;

  public:
    using Base::Base;

    /// mu = 2 dPsi/dI1 at a point of gradient F
    T shear(const int q) const
    {
      const T root = cbrt(Kinematics<T>(F + 9 * q).J);
      return T(2.) * Yeoh<T>(material(q) + material_yeoh).response(dot(F + 9 * q, F + 9 * q) / (root * root)).first + T(cells.law_shear);
    }

    /// Psi_vol'' of the state at a point as matrices have it. Softened it stays below a limit that goes with the shear modulus, so that
    /// p multigrid, whose coarse space locks, never sees a nearly incompressible matrix; the rest is left to GMRES.
    T volumetric_stiffness_of(const bool softened, const int q) const
    {
      const T full = volumetric_stiffness(q, expand(dilatation, q));
      if (!softened)
        return full;
      const T p = expand(pressure, q), mu = shear(q), limit = T(m.volume_limit) * (mu + select(p > T(0.), p, -p));
      return select(mu > T(0.), full * limit / (full + limit), full);
    }

    /// int Psi'' phi phi^T
    void stiffness_of_modes(const bool softened, T *E) const
    {
      const int n_modes = t.n_modes;
      clear(E, n_modes * n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          const T weight = volumetric_stiffness_of(softened, q) * JxW(q);
          for (int i = 0; i < n_modes; ++i)
            for (int j = 0; j < n_modes; ++j)
              E[i * n_modes + j] += weight * mode(q, i) * mode(q, j);
        }
    }

    /// S of VolumeLayout
    void volumetric_modes(const bool softened, T *S) const
    {
      T E[max_modes * max_modes], half[max_modes * max_modes];
      stiffness_of_modes(softened, E);
      const T *mass = reinterpret_cast<const T *>(cells.inverse_mode_mass);
      multiply(mass, E, half);
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

    /// R, upper triangular: R phi are orthonormal, R^T R = M_p^(-1), a Cholesky factorisation. In these modes the L2 norm of a pressure is
    /// the root of a plain sum of squares, whatever the shape of the cell.
    void orthonormal_modes(T *R) const
    {
      const T  *mass = reinterpret_cast<const T *>(cells.inverse_mode_mass);
      const int n    = t.n_modes;
      clear(R, n * n);
      for (int i = 0; i < n; ++i)
        for (int j = i; j < n; ++j)
          {
            T s = mass[i * n + j];
            for (int k = 0; k < i; ++k)
              s -= R[k * n + i] * R[k * n + j];
            R[i * n + j] = j == i ? sqrt(s) : s / R[i * n + i];
          }
    }

    /// R E R^T
    void to_orthonormal(const T *R, const T *E, T *orthonormal) const
    {
      const int n = t.n_modes;
      T         half[max_modes * max_modes];
      multiply(R, E, half);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          {
            orthonormal[i * n + j] = T(0.);
            for (int k = 0; k < n; ++k)
              orthonormal[i * n + j] += half[i * n + k] * R[j * n + k];
          }
    }

    /// x = R m
    void moments_to_orthonormal(const T *R, const T *moments, T *x) const
    {
      for (int i = 0; i < t.n_modes; ++i)
        {
          x[i] = T(0.);
          for (int j = i; j < t.n_modes; ++j)
            x[i] += R[i * t.n_modes + j] * moments[j];
        }
    }

    /// c = R^T x: coefficients of modes from those of the orthonormal ones
    void from_orthonormal(const T *R, const T *x, T *c) const
    {
      for (int i = 0; i < t.n_modes; ++i)
        {
          c[i] = T(0.);
          for (int j = 0; j <= i; ++j)
            c[i] += R[j * t.n_modes + i] * x[j];
        }
    }

    /// A symmetric positive definite matrix becomes its inverse, by Gauss and Jordan in its own place. Being definite it needs no pivoting,
    /// which lanes could not do each for itself.
    void invert(T *A) const
    {
      const int n = t.n_modes;
      for (int k = 0; k < n; ++k)
        {
          const T pivot = T(1.) / A[k * n + k];
          A[k * n + k]  = T(1.);
          for (int j = 0; j < n; ++j)
            A[k * n + j] *= pivot;
          for (int i = 0; i < n; ++i)
            if (i != k)
              {
                const T factor = A[i * n + k];
                A[i * n + k]   = T(0.);
                for (int j = 0; j < n; ++j)
                  A[i * n + j] -= factor * A[k * n + j];
              }
        }
    }

    /// The volume of a tangent, see VolumeLayout.
    void store_volume(T *at) const
    {
      const VolumeLayout layout(t.n_modes);
      T                 *R = at + layout.orthonormal, *C = at + layout.compliance;
      volumetric_modes(false, at + layout.stiffness);
      volumetric_modes(true, at + layout.softened);
      orthonormal_modes(R);
      T E[max_modes * max_modes], moments[max_modes], missing_p[max_modes], gap[max_modes], mu(0.), bulk(0.), volume(0.);
      stiffness_of_modes(false, E);
      to_orthonormal(R, E, C);
      invert(C);
      for (int i = 0; i < t.n_modes; ++i)
        missing_p[i] = linearised[i] - pressure[i];
      clear(moments, t.n_modes);
      for (int q = 0; q < n_points; ++q)
        {
          add_moments(expand(missing_p, q), q, moments);
          mu += shear(q) * JxW(q);
          bulk += volumetric_stiffness(q, expand(dilatation, q)) * JxW(q);
          volume += JxW(q);
        }
      moments_to_orthonormal(R, moments, gap);
      for (int i = 0; i < t.n_modes; ++i)
        {
          at[layout.residual + i] = T(0.);
          for (int j = 0; j < t.n_modes; ++j)
            at[layout.residual + i] += C[i * t.n_modes + j] * gap[j];
        }
      const T per_volume   = sqrt(cbrt(volume)) / volume; // a mean, times the root of the size of the cell
      at[layout.shear]     = mu * per_volume;
      at[layout.shear + 1] = bulk * per_volume;
    }

    /// See Kernels::advance.
    void advance(const T *dp, const double *trial_u, const double alpha, T *trial_z)
    {
      const T *D = local(), *p = D + t.n_modes;
      T       *D_t = trial_z, *p_t = D_t + t.n_modes;
      T        J[max_modes], projected[max_modes], moments[max_modes], change[max_modes], admissible(1.);
      T        R[max_modes * max_modes], E[max_modes * max_modes];
      orthonormal_modes(R);
      from_orthonormal(R, dp, change);
      evaluate_F(trial_u);
      clear(J, t.n_modes);
      clear(moments, t.n_modes);
      for (int i = 0; i < t.n_modes; ++i)
        {
          dilatation[i] = D[i];
          p_t[i]        = p[i] + T(alpha) * change[i];
          change[i] += p[i];
        }
      for (int q = 0; q < n_points; ++q)
        {
          const T of_trial = Kinematics<T>(F + 9 * q).J;
          require_positive(of_trial, admissible);
          add_moments(of_trial, q, J);
          add_moments(T(alpha) * (expand(change, q) - volumetric_stress(q, expand(D, q))), q, moments);
        }
      project(J, projected);
      stiffness_of_modes(false, E);
      invert(E);
      for (int i = 0; i < t.n_modes; ++i)
        {
          D_t[i] = D[i];
          for (int j = 0; j < t.n_modes; ++j)
            D_t[i] += E[i * t.n_modes + j] * moments[j];
        }
      for (int q = 0; q < n_points; ++q)
        {
          require_positive(expand(D_t, q), admissible);
          require_positive(expand(projected, q), admissible);
        }
      // There is no return value for each lane: a dilatation that is no number makes the residual there inadmissible.
      D_t[0] = select(admissible > T(0.), D_t[0], T(std::numeric_limits<double>::quiet_NaN()));
    }

    /// columns_m(n, b) = int phi_m field_b : Grad N_n with field_bJ JxW at [9 q + 3 b + J], [mode][component][node].
    void fill_columns(const T *field, T *columns)
    {
      const int n = 3 * n_nodes;
      clear(columns, t.n_modes * n);
      T *reference = work; // [3][n_points]
      for (int b = 0; b < 3; ++b)
        for (int i = 0; i < t.n_modes; ++i)
          {
            for (int q = 0; q < n_points; ++q)
              {
                const T *at = field + 9 * q + 3 * b;
                for (int A = 0; A < 3; ++A)
                  reference[A * n_points + q] =
                      mode(q, i) * (at[0] * inverse(q, 3 * A) + at[1] * inverse(q, 3 * A + 1) + at[2] * inverse(q, 3 * A + 2));
              }
            integrate<n1>(t, static_cast<T *>(nullptr), reference, columns + i * n + b * n_nodes);
          }
    }

    /// cof F JxW, [n_points][9].
    void cofactors(T *cof) const
    {
      for (int q = 0; q < n_points; ++q)
        {
          const Mat3<T> at = JxW(q) * cofactor(Mat3<T>::load(F + 9 * q));
          for (int i = 0; i < 9; ++i)
            cof[9 * q + i] = at.entry[i];
        }
    }

    /// AB for [n_modes][n_modes] and [n_modes][n].
    void combine(const T *A, const T *B, T *AB, const int n) const
    {
      for (int i = 0; i < t.n_modes; ++i)
        for (int j = 0; j < n; ++j)
          {
            T s(0.);
            for (int k = 0; k < t.n_modes; ++k)
              s += A[i * t.n_modes + k] * B[k * n + j];
            AB[i * n + j] = s;
          }
    }

    /// matrices += w A^T S B; @p A may be B, and SB is room for as many columns.
    void add_rank(const double w, const T *A, const T *B, T *SB, T *matrices) const
    {
      const int n_modes = t.n_modes, n = 3 * n_nodes;
      T         S[max_modes * max_modes];
      volumetric_modes(m.softened, S);
      for (int i = 0; i < n_modes * n_modes; ++i)
        S[i] *= T(w);
      combine(S, B, SB, n);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          for (int i = 0; i < n_nodes; ++i)
            for (int k = 0; k < n_modes; ++k)
              {
                const T  left  = A[k * n + a * n_nodes + i];
                const T *right = SB + k * n + b * n_nodes;
                T       *row   = matrices + ((3 * a + b) * n_nodes + i) * n_nodes;
                for (int j = 0; j < n_nodes; ++j)
                  row[j] += left * right[j];
              }
    }
  };
} // namespace myolines
