// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/dirk.h>

#include <optional>

namespace myolines
{
  /// First step of a smooth piece, of methods that carry accelerations from step to step or whose first stage is explicit.
  ///
  /// Their formulas use a, and as those of the trapezoidal rule v, just after the beginning. Where a load or the velocity of a boundary has
  /// jumped, or where the state before was not in balance, both decay within much less than a step in a body with strong damping; the
  /// formulas take them for the whole step. An L-stable method whose stages are all implicit uses neither, and leaves accelerations that
  /// the step resolves.
  enum class FirstStep
  {
    l_stable, ///< a step of an L-stable method, sdirk2_table() or beyond order 2 sdirk3_table(); one does not change an order up to 4
    own       ///< the formulas of the method, from M a = -F
  };

  /// Begins smooth pieces for such a method.
  class Starter
  {
  public:
    /// Shares @p solver with the method, which is of @p order; the first @p steps of a piece are L-stable ones.
    Starter(FirstStep kind, StageSolver &solver, const IntegratorContext &context, unsigned int order = 2, unsigned int steps = 1);

    /// Of the beginning of a piece: see start_piece(), and with own formulas consistent_acceleration().
    void start(State &state);

    /// Begins a piece before it is due: a kink lies in the next step or a little beyond it, which is L-stable as well.
    void kink_ahead() { due_ = stepper_ ? steps_ + 1 : 0; }

    /// Whether the next step is one of the first of its piece and not by own formulas.
    bool takes_next_step() const { return due_ > 0; }

    /// An L-stable step, as Integrator::step.
    StepReport step(double dt, State &state);

    void remember(Memory &memory); ///< as TimeMethod::remember

  private:
    /// Velocities that jump at the beginning of the step make accelerations of its stages that mean nothing. With q the slope of v between
    /// the ends of the first and the last stage, which lie behind the jump, and D = (M + g C + g^2 K)^-1 M, g the weight of the last stage,
    /// a <- a - (1 - D)^k (a - q): what the step resolves keeps its acceleration, the rest gets the slope. q and D are accurate to first
    /// order, so that a keeps an error of order k + 1.
    void resolve_acceleration(State &state, StepReport &report);

    const IntegratorContext    context_;
    StageSolver               &solver_;
    std::optional<DirkStepper> stepper_; ///< none: own formulas
    unsigned int               passes_;  ///< k of resolve_acceleration()
    unsigned int               steps_;   ///< L-stable ones of a piece
    unsigned int               due_ = 0; ///< of those
  };

  /// Refuses (InputError) own formulas for a first step in a system without accelerations (has_accelerations()).
  void require_fitting_first_step(const MethodFacts &facts, const scene::Node &integrator, const IntegratorContext &context);

  /// The choice `first step`, and what was chosen.
  void      declare_first_step(scene::Schema &schema);
  FirstStep first_step(const scene::Node &integrator); ///< The choice that the list @p integrator makes.
} // namespace myolines
