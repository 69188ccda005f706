// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/stage.h>

namespace myolines
{
  /// State at the beginning of a run, as the system gives it. With scheme rates and an impulse prescribed unknowns start from
  /// v = a = 0, so that a motion that starts with a velocity gives the body an impulse in the first step, as in the thesis
  /// (errata 21); with exact rates and an impulse v = 0 is what the boundary jumps from in start_piece().
  State starting_state(const SemiDiscreteSystem &system, double t0, BoundaryRates rates, StartVelocity start_velocity);

  /// The equilibrium at the end of @p stage, which has c_v = c_a = 0, from @p rest, a state at rest: R(u) = (1 - s) R(rest) with s rising
  /// to 1, first by @p part, by less where a solve fails and by more where it does not. On success @p rest is the equilibrium; a failure
  /// tells the s that was too much. Ledger: "load steps".
  NonlinearReport raise_loads(const IntegratorContext &context, StageSolver &solver, Stage stage, double part, State &rest);

  /// Makes the displacement of @p state the one at rest: R(t, u, 0, 0) = 0 with the loads and prescribed displacements of the right
  /// limit at its time; u need not be close, and v and a stay. Newton's method starts from the undeformed body, all at once; where
  /// that fails the loads are raised in parts (raise_loads()). Ledger: "starts from equilibrium". @throws SolveError if no part gets on.
  void start_from_equilibrium(const IntegratorContext &context, State &state);

  /// Beginning of a smooth piece. Prescribed unknowns of @p state take their right limits, unless scheme rates and an impulse
  /// are asked for. With exact rates and an impulse the velocities of the free unknowns jump too, M_ff dv_f = -M_fc dv_c, where
  /// the system has inertia. @throws SolveError if the mass cannot be inverted.
  void start_piece(const IntegratorContext &context, StageSolver &solver, State &state);

  /// a of @p state from M a = -F(t, u, v), for methods that begin from accelerations; those of prescribed unknowns stay.
  /// @throws SolveError if that cannot be solved.
  void consistent_acceleration(const IntegratorContext &context, StageSolver &solver, Side side, State &state);

  /// Where to look for another method.
  constexpr const char *methods_hint = "`myolines list methods` tells which methods and systems go together";

  /// Whether every unknown of @p system has an acceleration, M a = -F: there is inertia, and none is of order 0 or 1.
  bool has_accelerations(const SemiDiscreteSystem &system);

  /// Why not: "the system has no inertia", for a sentence.
  std::string why_no_accelerations(const SemiDiscreteSystem &system);

  /// Refuses (InputError at the parameter type of @p integrator) a system that a method of these facts does not take: one without those
  /// accelerations, and boundaries that move by the formulas of a method that has none.
  void require_fit(const MethodFacts &facts, const scene::Node &integrator, const IntegratorContext &context);

  /// Refuses scheme rates on constrained unknowns. With the parameters of @p integrator the formulas of the method make a
  /// prescribed motion grow without bound: it acts like a spring of infinite stiffness on a method of limited stability.
  void refuse_scheme_rates(const scene::Node &integrator, const IntegratorContext &context);
} // namespace myolines
