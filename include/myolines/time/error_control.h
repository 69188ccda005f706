// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/error_norm.h>
#include <myolines/time/step_control.h>

namespace myolines
{
  /// Limits of steps that are chosen by error.
  struct ErrorControlLimits
  {
    double       first_step;   ///< [s], > 0
    double       minimum_step; ///< [s]; 0: that of the number of digits
    double       maximum_step; ///< [s]; infinity: none
    double       safety;       ///< of the step that would just meet the tolerance, in (0, 1]
    double       growth;       ///< largest ratio of a step to the one before, > 1
    unsigned int rejections;   ///< in a row, before the run ends
  };

  /// Steps whose error is as large as tolerated, by a PI controller: with e the error relative to the tolerance, of order dt^k,
  ///
  ///     dt_next = safety e^(-0.7/k) (e_last/e)^(0.2/k) dt     (Gustafsson, doi:10.1145/198429.198437),
  ///
  /// between a fifth of dt and its growth limit. The first step of a run, and after a rejection the next one, forget e_last. An
  /// error too large: safety e^(-1/k) dt, and no growth directly after; for k the exponent that is observed where two such errors in
  /// a row show another (at jumps, and in stiff components). A failed solve: a quarter of dt. A step that was cut
  /// short to land somewhere does not shorten the next one. Steps grow only by a fifth or more, so that matrices of linear systems
  /// can be used again.
  class ErrorControl : public StepControl
  {
  public:
    /// @p exponent k, see error_exponent().
    ErrorControl(const ErrorControlLimits &limits, unsigned int exponent);

    double      propose(double t) const override;
    double      next_landing(double t) const override;
    void        accepted(double t, double dt, const StepReport &report) override;
    bool        rejected(double t, double dt, const StepReport &report) override;
    std::string advice() const override;
    void        save(Archive &archive) const override;
    void        load(const Archive &archive) override;

  private:
    /// k, or after two errors too large in a row, where the error does not fall like dt^k, the exponent that they show.
    double shown_exponent(double dt, double error) const;

    struct Refused
    {
      double dt    = 0; ///< 0: none
      double error = 0;
    };

    const ErrorControlLimits limits_;
    const double             k_;
    double                   step_;           ///< the next one [s]
    double                   last_error_ = 0; ///< 0: none
    unsigned int             rejections_ = 0; ///< since the last accepted step
    Refused                  refused_;        ///< the last step since then whose error was too large
  };

  /// Parameters of the step control `error`, in the list `time/control`.
  scene::Schema error_control_schema();

  /// What the list `time` asks for: its `step` is the first one. @throws InputError if its parameters contradict each other.
  ErrorControlLimits error_control_limits(const scene::Node &time);

  /// That of the list `time`, for a method whose estimates are O(dt^k), k = @p exponent.
  std::unique_ptr<StepControl> make_error_control(const scene::Node &time, unsigned int exponent);

  /// The norm that goes with the step control of the list `time`; none if its steps are not chosen by error.
  std::unique_ptr<ErrorNorm> make_error_norm(const scene::Node &time, const SemiDiscreteSystem &system);
} // namespace myolines
