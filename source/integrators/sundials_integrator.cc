// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_integrator.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/start.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    std::string without_dots(std::string text)
    {
      while (!text.empty() && (text.back() == '.' || text.back() == ' '))
        text.pop_back();
      return text;
    }
  } // namespace

  SundialsIntegrator::SundialsIntegrator(const IntegratorContext &context, const ErrorControlLimits &limits)
    : context_(context)
    , limits_(limits)
    , y_(nullptr, N_VDestroy)
    , dy_(nullptr, N_VDestroy)
    , work_(nullptr, N_VDestroy)
    , weights_(nullptr, N_VDestroy)
  {}

  const ErrorTolerances &SundialsIntegrator::tolerances() const { return context_.error_norm->tolerances(); }

  void SundialsIntegrator::allocate(const State &state)
  {
    if (form_)
      return;
    form_     = std::make_unique<FirstOrderForm>(context_, state);
    sundials_ = std::make_unique<SundialsContext>(form_->communicator());
    for (SundialsVector *x : {&y_, &dy_, &work_, &weights_})
      *x = make_sundials_vector(*form_, *sundials_);
    allocate_solver(state);
  }

  void SundialsIntegrator::begin_at(const State &state, const double first_step)
  {
    const std::size_t n = form_->n_free();
    form_->gather(state, entries(y_), entries(dy_) + n);
    std::copy(entries(y_) + n, entries(y_) + 2 * n, entries(dy_));
    counted_ = {};
    begin(state.t, first_step);
    begun_            = true;
    steps_since_look_ = 0;
  }

  void SundialsIntegrator::start(State &state)
  {
    allocate(state);
    form_->start_piece(state);
    begin_at(state, started_ || step_after_load_ ? 0 : std::min(limits_.first_step, limits_.maximum_step));
    started_ = true;
  }

  StepReport SundialsIntegrator::advance(const double t_stop, State &state)
  {
    allocate(state);
    if (!begun_)
      begin_at(state, step_after_load_.value_or(0));
    message_.clear();
    if (steps_since_look_ == 0)
      message_ = refusal(state.t, t_stop);
    steps_since_look_ = (steps_since_look_ + 1) % steps_between_looks;
    if (!message_.empty())
      {
        StepReport refused;
        refused.outcome = StepReport::Outcome::not_converged;
        refused.reason  = message_;
        return refused;
      }
    double t    = state.t;
    int    flag = evolve(t_stop, t);
    // inadmissible explicit stages end SUNDIALS' own attempts: begin anew with shorter steps
    for (unsigned int retry = 0; flag < 0 && form_->has_reason() && retry < limits_.rejections; ++retry)
      {
        const double shorter = next_step() / 4;
        if (!(shorter > limits_.minimum_step) || state.t + shorter == state.t)
          break;
        context_.ledger.count("rejected steps");
        form_->take_reason();
        begin_at(state, shorter);
        steps_since_look_ = 1;
        flag              = evolve(t_stop, t);
      }
    StepReport        report = form_->take_counts();
    const std::string inner  = form_->take_reason();
    if (flag >= 0 && t <= state.t)
      message_ = "the step is below the rounding of time";
    if (flag < 0 || t <= state.t)
      {
        begun_         = false;
        report.outcome = StepReport::Outcome::not_converged;
        report.reason  = without_dots(message_) + (inner.empty() ? "" : " (" + inner + ")");
        return report;
      }
    const Statistics now  = statistics();
    report.error_estimate = now.estimated_error;
    context_.ledger.count("rejected steps", now.error_failures - counted_.error_failures);
    context_.ledger.count("nonlinear convergence failures", now.solver_failures - counted_.solver_failures);
    counted_ = now;

    const State &end = form_->state(t, entries(y_), entries(dy_) + form_->n_free());
    state.t          = t;
    state.u          = end.u;
    state.v          = end.v;
    state.a          = end.a;
    return report;
  }

  void SundialsIntegrator::save(Archive &archive) const { archive.put("next step", begun_ ? next_step() : 0); }

  void SundialsIntegrator::load(const Archive &archive)
  {
    begun_           = false;
    step_after_load_ = archive.has_numbers("next step") ? archive.number("next step") : 0;
  }

  double SundialsIntegrator::size(N_Vector error) const
  {
    set_error_weights(tolerances(), *form_, entries(y()), entries(weights_.get()));
    return N_VWrmsNorm(error, weights_.get());
  }
} // namespace myolines
