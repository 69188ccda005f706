// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/archive.h>
#include <myolines/time/integrator.h>

#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// Proposes step sizes; the loop shortens them to land on events and on the end.
  /// After a rejected step, rejected() says whether to go on; the loop restores nothing (a failed step leaves the state).
  class StepControl
  {
  public:
    virtual ~StepControl() = default;

    /// Size of the next step from @p t [s], > 0.
    virtual double propose(double t) const = 0;

    /// End of the planned step that begins at or contains @p t, at which the loop must land (schedules, cut-backs), or
    /// +infinity. Keeps sub-steps of a cut-back on the grid of the plan.
    virtual double next_landing(double t) const = 0;

    virtual void accepted(double t, double dt, const StepReport &report) = 0; ///< tells of an accepted step

    /// Shrinks the step. False if the bounds of the control are reached; the loop then ends with the reason.
    virtual bool rejected(double t, double dt, const StepReport &report) = 0;

    /// What to try where the control gives up, for a sentence.
    virtual std::string advice() const = 0;

    virtual void save(Archive &archive) const = 0; ///< for a checkpoint
    virtual void load(const Archive &archive) = 0; ///< from a checkpoint

  protected:
    /// Whether a step from @p t is more than round-off of the time.
    static bool moves_time(const double t, const double dt) { return t + dt / 8 > t; }
  };

  /// Parameters of the list `time`: start, end, step or steps, control, boundary rates, start velocity, events.
  scene::Schema time_schema();

  ///@{
  /// What the list `time` says of moving boundaries, and of the start.
  BoundaryRates boundary_rates(const scene::Node &time);
  StartVelocity start_velocity(const scene::Node &time);
  bool          starts_from_equilibrium(const scene::Node &time);
  ///@}

  /// Piece "count x size" of a schedule such as "4 x 0.025; 8 x 0.0125".
  struct SchedulePiece
  {
    unsigned int count; ///< of steps
    double       size;  ///< [s]
  };
  /// @throws InputError unless the list `time` has one of `step` and `steps`.
  void require_steps(const scene::Node &time);

  /// @throws InputError (through node.refuse) if the text is not a schedule.
  std::vector<SchedulePiece> parse_schedule(const std::string &text, const scene::Node &node, const std::string &parameter);

  /// The control a scene asks for:
  /// - fixed: the planned steps; a rejected one ends the run.
  /// - cut back: after a rejection half the step; after an accepted sub-step it grows again by `growth factor`, up to the
  ///   planned size, in equal sub-steps that land on the planned end. Gives up below `minimum step` or after
  ///   `maximum cuts` halvings without a success.
  /// - error: see ErrorControl. @p error_exponent is that of the method (error_control.h); no other control needs it.
  /// @throws InputError if start, end, step and steps contradict each other.
  std::unique_ptr<StepControl> make_step_control(const scene::Node &time, unsigned int error_exponent = 0);
} // namespace myolines
