// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/error_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    constexpr double shortest  = 0.2;                    ///< ratio of steps
    constexpr double failed    = 0.25;                   ///< ratio of steps after a solve that failed
    constexpr double worthless = 1.2;                    ///< ratio of steps below which a longer one is not worth it
    constexpr double integral = 0.7, proportional = 0.2; ///< gains: the closed loop has the poles 0.5 and -0.4
    constexpr double smallest = 1e-6;                    ///< error that counts: what is below is rounding

    /// rtol and atol of a block.
    ErrorTolerances::Block block(const scene::Node &node)
    {
      const ErrorTolerances::Block tolerances{node.number("relative tolerance"), node.number("absolute tolerance")};
      if (tolerances.relative == 0 && tolerances.absolute == 0)
        node.refuse("relative tolerance", "both tolerances are zero", "at least one of them > 0");
      return tolerances;
    }

    scene::Schema block_schema(const std::string &doc, const double relative, const double absolute, const std::string &unit)
    {
      using scene::Range;
      scene::Schema schema(doc);
      schema.number("relative tolerance", relative, "-", Range{0, 1, false, true}, "Tolerated error of a step, of the size of the block.")
          .number("absolute tolerance", absolute, unit, Range::not_negative(), "Tolerated error of a step beyond that, root mean square.");
      return schema;
    }
  } // namespace

  ErrorControl::ErrorControl(const ErrorControlLimits &limits, const unsigned int exponent)
    : limits_(limits)
    , k_(exponent)
    , step_(std::min(limits.first_step, limits.maximum_step))
  {}

  double ErrorControl::propose(double) const { return step_; }

  double ErrorControl::next_landing(double) const { return std::numeric_limits<double>::infinity(); }

  void ErrorControl::accepted(double, const double dt, const StepReport &report)
  {
    const double error  = std::max(report.error_estimate.value(), smallest);
    const double last   = last_error_ > 0 && rejections_ == 0 ? last_error_ : error;
    const double wanted = limits_.safety * std::pow(error, -(integral + proportional) / k_) * std::pow(last, proportional / k_);
    double       ratio  = std::clamp(wanted, shortest, rejections_ > 0 ? 1. : limits_.growth);
    if (ratio > 1 && ratio < worthless && limits_.growth > worthless)
      ratio = 1;
    const bool cut_short = dt < 0.99 * step_;
    step_                = std::min(cut_short ? std::max(step_, ratio * dt) : ratio * dt, limits_.maximum_step);
    step_                = std::max(step_, limits_.minimum_step);
    if (!cut_short)
      last_error_ = error;
    rejections_ = 0;
    refused_    = {};
  }

  bool ErrorControl::rejected(const double t, const double dt, const StepReport &report)
  {
    if (report.outcome == StepReport::Outcome::error_too_large && std::isfinite(*report.error_estimate))
      {
        const double error = *report.error_estimate;
        step_              = dt * std::clamp(limits_.safety * std::pow(error, -1 / shown_exponent(dt, error)), shortest, limits_.safety);
        refused_           = {dt, error};
      }
    else
      step_ = dt * failed;
    ++rejections_;
    return step_ >= limits_.minimum_step && moves_time(t, step_) && rejections_ <= limits_.rejections;
  }

  double ErrorControl::shown_exponent(const double dt, const double error) const
  {
    if (refused_.dt <= dt || refused_.error <= error)
      return refused_.dt > dt ? 1. / k_ : k_;
    return std::clamp(std::log(refused_.error / error) / std::log(refused_.dt / dt), 1. / k_, k_);
  }

  std::string ErrorControl::advice() const
  {
    return "larger tolerances or a smaller \"minimum step\" in \"time/control\", or more \"solver/nonlinear/maximum iterations\"";
  }

  /// A run is kept after accepted steps, when nothing has been rejected.
  void ErrorControl::save(Archive &archive) const { archive.put_numbers("step control: step, last error", {step_, last_error_}); }

  void ErrorControl::load(const Archive &archive)
  {
    if (!archive.has_numbers("step control: step, last error")) // the run to resume had another control
      return;
    const std::vector<double> &memory = archive.numbers("step control: step, last error");
    step_                             = std::min(memory.at(0), limits_.maximum_step);
    last_error_                       = memory.at(1);
  }

  scene::Schema error_control_schema()
  {
    using scene::Range;
    scene::Schema schema(
        "Steps as long as the estimated error of each allows; a step whose error is too large, or that fails, is repeated with a "
        "shorter one. \"time/step\" is the first one that is tried.");
    schema
        .section("displacement",
                 block_schema("Error of the displacements; size: root mean square over the free unknowns.", 1e-3, 1e-6, "m"))
        .optional_section("velocity",
                          block_schema("Error of the velocities; where the list is not written they are not looked at.", 1e-2, 1e-3, "m/s"))
        .number("solver fraction", 0.05, "-", Range{0, 1, true, false},
                "Newton's method may end where what remains is this part of the tolerances: more digits would be lost in the error of the "
                "step.")
        .number("safety factor", 0.9, "-", Range::closed(0.2, 1),
                "Of the step that would just meet the tolerance; multistep methods that choose their steps themselves have their own.")
        .number("growth factor", 2, "-", Range{1, 10, true, false},
                "Largest ratio of a step to the one before; methods that choose their steps themselves grow faster at a start.")
        .number("minimum step", 0, "s", Range::not_negative(),
                "The run ends rather than take a smaller step; only landings shorten steps further.")
        .optional_number("maximum step", "s", Range::positive(), "Steps are never longer.")
        .integer("maximum rejections", 20, Range::closed(1, 1000), "Largest number of times a step is repeated before the run ends.");
    return schema;
  }

  ErrorControlLimits error_control_limits(const scene::Node &time)
  {
    const scene::Node &control = time.section("control");
    if (time.has("steps") || !time.has("step"))
      time.refuse(time.has("steps") ? "steps" : "step", "steps are chosen by error (\"time/control/type\")",
                  "\"step\" [s], the first step that is tried",
                  time.has("steps") ? "no \"steps\": --unset time/steps --set time/step=SIZE" : "no \"steps\"");
    if (!(time.number("end") > time.number("start")))
      time.refuse("end", "the end does not come after the start", "a time later than \"start\" [s]");
    const ErrorControlLimits limits{time.number("step"),
                                    control.number("minimum step"),
                                    control.has("maximum step") ? control.number("maximum step") : std::numeric_limits<double>::infinity(),
                                    control.number("safety factor"),
                                    control.number("growth factor"),
                                    static_cast<unsigned int>(control.integer("maximum rejections"))};
    if (limits.minimum_step > std::min(limits.first_step, limits.maximum_step))
      control.refuse("minimum step", "is larger than the first or the maximum step", "minimum step <= step, maximum step");
    return limits;
  }

  std::unique_ptr<StepControl> make_error_control(const scene::Node &time, const unsigned int exponent)
  {
    return std::make_unique<ErrorControl>(error_control_limits(time), exponent);
  }

  std::unique_ptr<ErrorNorm> make_error_norm(const scene::Node &time, const SemiDiscreteSystem &system)
  {
    const scene::Node &control = time.section("control");
    if (control.text("type") != "error")
      return nullptr;
    ErrorTolerances tolerances;
    tolerances.displacement = block(control.section("displacement"));
    if (control.has("velocity"))
      tolerances.velocity = block(control.section("velocity"));
    tolerances.solver_fraction = control.number("solver fraction");
    return std::make_unique<ErrorNorm>(tolerances, system);
  }
} // namespace myolines
