// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/alpha_method.h>
#include <myolines/time/combination.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/start.h>

#include <cmath>
#include <complex>
#include <limits>
#include <sstream>

namespace myolines
{
  namespace
  {
    class AlphaMethod : public Integrator
    {
    public:
      AlphaMethod(const AlphaCoefficients &c, const ForceEvaluation force, const FirstStep first, const IntegratorContext &context)
        : c_(c)
        , keeps_force_(c.alpha_f != 0 && force == ForceEvaluation::weighted_end_forces)
        , averages_state_(c.alpha_f != 0 && force != ForceEvaluation::weighted_end_forces)
        , two_states_(force == ForceEvaluation::two_states && !context.system.capabilities().linear)
        , context_(context)
        , solver_(context)
        , starter_(first, solver_, context)
        , history_(context.make_vector())
        , zero_(history_)
        , force_(history_)
        , end_(context.make_state())
        , offset_(end_)
      {}

      void start(State &state) override
      {
        starter_.start(state);
        if (!keeps_force_ || starter_.takes_next_step())
          return;
        const Evaluation evaluation = force(state, Side::right, force_);
        if (!evaluation.admissible)
          throw SolveError("The force at the start cannot be computed: " + evaluation.reason + ".");
      }

      StepReport step(const double dt, State &state) override
      {
        StepReport report = starter_.takes_next_step() ? starter_.step(dt, state) : go_on(dt, state);
        if (report.accepted() && keeps_force_)
          keep_force(state, report);
        return report;
      }

      void remember(Memory &memory) override
      {
        starter_.remember(memory);
        if (keeps_force_)
          memory.keep("force at the last step", force_);
      }

    private:
      StepReport go_on(const double dt, State &state)
      {
        Stage stage;
        stage.t     = state.t + dt;
        stage.c     = predict(dt, state);
        stage.scale = keeps_force_ ? 1 - c_.alpha_f : 1;

        Stage::Average average{stage.t, &offset_, {1, 1, 1}};
        if (c_.alpha_m != 0 || c_.alpha_f != 0)
          {
            set_average(dt, state, stage, average);
            stage.average = &average;
          }
        if (two_states_)
          stage.before = &state.u;
        if (keeps_force_)
          {
            combine(history_, {{c_.alpha_f, &force_}});
            stage.history = &history_;
          }
        StepReport report;
        record(solver_.solve(stage, end_, state), report);
        if (context_.error_norm != nullptr && report.accepted())
          estimate(dt, state, report);
        if (report.accepted())
          swap(state, end_);
        return report;
      }

      /// Fills end_ with the predictors; returns the weights of d = u_1 - u~, or a_1 for beta = 0.
      Weights predict(const double dt, const State &state)
      {
        const double beta = c_.beta, gamma = c_.gamma;
        combine(end_.u, {{1, &state.u}, {dt, &state.v}, {dt * dt * (0.5 - beta), &state.a}});
        combine(end_.v, {{1, &state.v}, {dt * (1 - gamma), &state.a}});
        end_.a = 0;
        if (beta == 0)
          return {0, gamma * dt, 1};
        return {1, gamma / (beta * dt), 1 / (beta * dt * dt)};
      }

      /// With weighted forces the inertia is divided by the weight of the force at the end, which multiplies all of R.
      void set_average(const double dt, const State &state, const Stage &stage, Stage::Average &average)
      {
        const double alpha_f = averages_state_ ? c_.alpha_f : 0;
        combine(offset_.u, {{two_states_ ? 0 : alpha_f, &state.u}});
        combine(offset_.v, {{alpha_f, &state.v}});
        combine(offset_.a, {{c_.alpha_m / stage.scale, &state.a}});
        average.t      = stage.t - alpha_f * dt;
        average.weight = {two_states_ ? 1 : 1 - alpha_f, 1 - alpha_f, (1 - c_.alpha_m) / stage.scale};
      }

      void estimate(const double dt, const State &state, StepReport &report)
      {
        State &error = offset_;
        combine(error.u, {{dt * dt * error_constant(c_), &end_.a}, {-dt * dt * error_constant(c_), &state.a}});
        error.v = 0;
        if (c_.beta != 0) // else the matrix of the step does not know what is stiff
          record_estimate(solver_.damp(error), report);
        if (report.accepted())
          ErrorNorm::judge(context_.error_norm->of_step(error.u, nullptr, state, end_), report);
      }

      /// F(t, u, v) = R(t, u, v, 0).
      Evaluation force(const State &state, const Side side, Vector &f) const
      {
        return context_.system.residual({state.t, side, state.u, state.v, zero_}, f);
      }

      /// The end was admissible when the stage was solved, so this evaluation is as well.
      void keep_force(const State &state, StepReport &report)
      {
        record(force(state, Side::left, force_), report);
        if (!report.accepted())
          throw std::logic_error("an admissible state has become inadmissible: " + report.reason);
      }

      const AlphaCoefficients c_;
      const bool              keeps_force_;
      const bool              averages_state_;
      const bool              two_states_;
      const IntegratorContext context_;
      StageSolver             solver_;
      Starter                 starter_;
      Vector                  history_, zero_;
      Vector                  force_; ///< F at the last step
      State                   end_, offset_;
    };

    /// Where there is no inertia, or unknowns are of order 0 or 1, accelerations are what the formulas of a step make of displacements and
    /// velocities: those of the step before must fade.
    void require_damped_accelerations(const AlphaCoefficients &coefficients, const MethodFacts &facts, const scene::Node &integrator,
                                      const IntegratorContext &context)
    {
      const std::string why = why_no_accelerations(context.system);
      if (why.empty())
        return;
      if (spectral_radius_at_infinity(coefficients) > 1 - 1e-7)
        integrator.refuse("type", "with these parameters \"" + facts.name + "\" carries accelerations on undamped, but " + why,
                          "parameters with a spectral radius at infinity below 1, or another method", methods_hint);
      require_fitting_first_step(facts, integrator, context);
    }

    /// Larger modulus of the roots of x^2 - trace x + determinant.
    double larger_root(const double trace, const double determinant)
    {
      const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace / 4 - determinant));
      return std::max(std::abs(trace / 2 + root), std::abs(trace / 2 - root));
    }
  } // namespace

  AlphaCoefficients AlphaCoefficients::second_order(const double alpha_m, const double alpha_f)
  {
    const double x = 1 - alpha_m + alpha_f;
    return {alpha_m, alpha_f, x * x / 4, 0.5 - alpha_m + alpha_f};
  }

  unsigned int order(const AlphaCoefficients &c) { return std::abs(c.gamma - (0.5 - c.alpha_m + c.alpha_f)) < 1e-12 ? 2 : 1; }

  double error_constant(const AlphaCoefficients &c) { return c.beta + (c.alpha_m - c.alpha_f) / 2 - 1. / 6; }

  double amplification_of_scheme_rates(const AlphaCoefficients &c)
  {
    return c.beta == 0 ? 0 : larger_root(2 - (c.gamma + 0.5) / c.beta, 1 - (c.gamma - 0.5) / c.beta);
  }

  /// There u_1 = -alpha_f / (1 - alpha_f) u_0, and with u = 0 what is left is the recursion of v and a.
  double spectral_radius_at_infinity(const AlphaCoefficients &c)
  {
    if (c.beta == 0)
      return std::numeric_limits<double>::infinity();
    return std::max(amplification_of_scheme_rates(c), std::abs(c.alpha_f / (1 - c.alpha_f)));
  }

  std::vector<std::string> describe(const AlphaCoefficients &c)
  {
    std::ostringstream coefficients, order_text, stability;
    for (std::ostringstream *stream : {&coefficients, &stability})
      stream->precision(12);
    coefficients << "alpha_m = " << c.alpha_m << ", alpha_f = " << c.alpha_f << " (weights of the beginning of a step), beta = " << c.beta
                 << ", gamma = " << c.gamma;
    order_text << "order " << order(c) << " with these";
    const double radius = spectral_radius_at_infinity(c);
    // roots of modulus one in floating point may be double ones, with errors of half the digits
    if (radius < 1 + 1e-7)
      stability << "spectral radius at infinity " << radius << ", unconditionally stable for linear systems";
    else
      {
        stability << "conditionally stable";
        if (c.alpha_m == 0 && c.alpha_f == 0)
          stability << ": omega dt <= " << 1 / std::sqrt(c.gamma / 2 - c.beta) << " without damping";
      }
    return {coefficients.str(), order_text.str(), stability.str()};
  }

  std::unique_ptr<Integrator> make_alpha_method(const AlphaCoefficients &coefficients, const ForceEvaluation force, const FirstStep first,
                                                const MethodFacts &facts, const scene::Node &integrator, const IntegratorContext &context)
  {
    require_damped_accelerations(coefficients, facts, integrator, context);
    if (amplification_of_scheme_rates(coefficients) > 1 + 1e-7)
      refuse_scheme_rates(integrator, context);
    if (context.error_norm != nullptr && std::abs(error_constant(coefficients)) < 1e-6)
      integrator.refuse("type", "with these parameters the error of a step is of higher order than what estimates it",
                        "another \"time/control/type\", or other parameters", "beta + (alpha_m - alpha_f)/2 must not be 1/6");
    return std::make_unique<AlphaMethod>(coefficients, force, first, context);
  }

  void declare_force_evaluation(scene::Schema &schema, const std::string &fallback)
  {
    schema.choice("force evaluation", fallback, {"weighted end forces", "averaged state"},
                  "Force between the ends of a step: a weighted sum of the forces at both, or the force at the averaged state.");
  }

  ForceEvaluation force_evaluation(const scene::Node &integrator)
  {
    return integrator.text("force evaluation") == "averaged state" ? ForceEvaluation::averaged_state : ForceEvaluation::weighted_end_forces;
  }
} // namespace myolines
