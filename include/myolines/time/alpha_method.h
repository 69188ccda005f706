// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/first_step.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Coefficients of the generalized-alpha family in the convention of Chung and Hulbert (doi:10.1115/1.2900803), where
  /// alpha_m and alpha_f weigh the beginning of a step:
  ///
  ///     u_1 = u_0 + dt v_0 + dt^2 ((1/2 - beta) a_0 + beta a_1),    v_1 = v_0 + dt ((1 - gamma) a_0 + gamma a_1),
  ///     (1 - alpha_m) M a_1 + alpha_m M a_0 + F_f = 0,
  ///
  /// F_f the force between the ends, see ForceEvaluation. Newmark: alpha_m = alpha_f = 0; Hilber, Hughes and Taylor:
  /// alpha_m = 0; Wood, Bossak and Zienkiewicz: alpha_f = 0.
  struct AlphaCoefficients
  {
    double alpha_m = 0;    ///< < 1
    double alpha_f = 0;    ///< < 1
    double beta    = 0.25; ///< >= 0; 0: no stiffness in the matrix of a step
    double gamma   = 0.5;  ///< >= 1/2 for stability

    /// Second order with as much high-frequency damping as alpha_m, alpha_f allow: gamma = 1/2 - alpha_m + alpha_f,
    /// beta = (1 - alpha_m + alpha_f)^2 / 4.
    static AlphaCoefficients second_order(double alpha_m, double alpha_f);
  };

  /// F_f of a step; they differ for nonlinear systems only.
  enum class ForceEvaluation
  {
    weighted_end_forces, ///< (1 - alpha_f) F(t_1, u_1, v_1) + alpha_f F(t_0, u_0, v_0)
    averaged_state,      ///< F at (1 - alpha_f) (t_1, u_1, v_1) + alpha_f (t_0, u_0, v_0), also for prescribed unknowns
    two_states           ///< the force of u_0 and u_1 (Point::before) at averages of t and v; alpha_f = 1/2
  };

  /// 2 if gamma = 1/2 - alpha_m + alpha_f, else 1.
  unsigned int order(const AlphaCoefficients &coefficients);

  /// The error of u in a step is error_constant dt^2 (a_1 - a_0) + O(dt^4), beta + (alpha_m - alpha_f)/2 - 1/6, as the accelerations
  /// belong to the instants t + (alpha_m - alpha_f) dt. Without alpha_m, alpha_f this is the estimate of Zienkiewicz and Xie
  /// (doi:10.1002/eqe.4290200907).
  double error_constant(const AlphaCoefficients &coefficients);

  /// Largest amplification per step of a mode whose frequency tends to infinity; infinite for beta = 0.
  double spectral_radius_at_infinity(const AlphaCoefficients &coefficients);

  /// Largest amplification per step of the velocity of a prescribed motion that follows the formulas (scheme rates).
  double amplification_of_scheme_rates(const AlphaCoefficients &coefficients);

  /// Coefficients, order and spectral radius in words, for `check`.
  std::vector<std::string> describe(const AlphaCoefficients &coefficients);

  /// One nonlinear solve per step; for the first guess see StageSolver::step().
  /// @throws InputError (at the parameters of @p integrator) if the system or the boundary rates do not fit.
  std::unique_ptr<Integrator> make_alpha_method(const AlphaCoefficients &coefficients, ForceEvaluation force, FirstStep first,
                                                const MethodFacts &facts, const scene::Node &integrator, const IntegratorContext &context);

  /// The choice `force evaluation`, and what was chosen.
  void            declare_force_evaluation(scene::Schema &schema, const std::string &fallback);
  ForceEvaluation force_evaluation(const scene::Node &integrator); ///< The choice that the list @p integrator makes.
} // namespace myolines
