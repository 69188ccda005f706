// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_arkode_system.h>
#include <myolines/integrators/sundials_integrator.h>
#include <myolines/time/start.h>

#include <arkode/arkode_arkstep.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "arkode";
      facts.summary =
          "ARKODE of SUNDIALS: explicit, diagonally implicit and additive Runge-Kutta methods by the names of their tables or by "
          "their coefficients; steps given or chosen by error.";
      facts.reference    = "Reynolds et al., doi:10.1145/3594632; the papers of the tables are in the documentation of ARKODE";
      facts.order        = 3;
      facts.stability    = "that of the table; L-stable for the default one";
      facts.unknowns     = MethodFacts::Unknowns::second_order;
      facts.scheme_rates = false;
      facts.restart      = MethodFacts::Restart::reinitialise;
      return facts;
    }

    /// What to say of an explicit method that needs @p steps of them (0: it was given a longer one).
    std::string unstable(const double stable_step, const double steps)
    {
      std::ostringstream text;
      text.precision(3);
      text << "the stable step of this explicit method is about " << stable_step << " s";
      if (steps > 0)
        text << ", " << steps << " of them up to the next event or the end";
      text << " (\"integrator/force\" = true tries it all the same; implicit methods do without)";
      return text.str();
    }

    /// Steps chosen by error.
    class AdaptiveArkode : public SundialsIntegrator
    {
    public:
      AdaptiveArkode(const scene::Node &node, const IntegratorContext &context, const ErrorControlLimits &limits)
        : SundialsIntegrator(context, limits)
        , node_(node)
        , tables_(arkode_tables(node, context.system))
      {}

    private:
      void allocate_solver(const State &layout) override
      {
        system_.emplace(tables_, tolerances(), node_, context(), form(), sundials(), layout);
      }

      void begin(const double t, const double first_step) override
      {
        memory_ = system_->begin(t, y());
        require_success(MYOLINES_KEEP_SUNDIALS_ERRORS(ARKStep, memory_, sundials(), message()), "to keep errors");
        ARKStepSetInitStep(memory_, first_step);
        ARKStepSetMinStep(memory_, limits().minimum_step);
        if (std::isfinite(limits().maximum_step))
          ARKStepSetMaxStep(memory_, limits().maximum_step);
        ARKStepSetMaxErrTestFails(memory_, limits().rejections);
        ARKStepSetSafetyFactor(memory_, 1); // next_step_by_error() has it
        ARKStepSetMaxGrowth(memory_, limits().growth);
        ARKStepSetNonlinConvCoef(memory_, tolerances().solver_fraction);
        ARKStepSetErrorBias(memory_, 1);
        require_success(ARKStepSetAdaptivityFn(memory_, next_step_by_error, this), "ARKStepSetAdaptivityFn");
      }

      std::string refusal(const double t, const double t_stop) override
      {
        if (node_.boolean("force"))
          return "";
        const double stable = system_->stable_step(t, y()), steps = (t_stop - t) / stable;
        if (std::isfinite(stable) && stable > 0) // the error is not always seen to grow, above all where velocities are not looked at
          ARKStepSetMaxStep(memory_, std::min(stable, limits().maximum_step));
        return steps > node_.integer("most explicit steps") ? unstable(stable, steps) : "";
      }

      int evolve(const double t_stop, double &t) override
      {
        ARKStepSetStopTime(memory_, t_stop);
        const int flag = ARKStepEvolve(memory_, t_stop, y(), &t, ARK_ONE_STEP);
        if (flag < 0)
          return flag;
        if (flag == ARK_TSTOP_RETURN)
          t = t_stop;
        return ARKStepGetDky(memory_, t, 1, dy());
      }

      Statistics statistics() const override
      {
        Statistics now;
        ARKStepGetNumErrTestFails(memory_, &now.error_failures);
        ARKStepGetNumNonlinSolvConvFails(memory_, &now.solver_failures);
        now.estimated_error = error_;
        return now;
      }

      double next_step() const override
      {
        double step = 0;
        ARKStepGetCurrentStep(memory_, &step);
        return step;
      }

      /// The PI controller of ErrorControl: 0.7 and 0.2 over the order of the estimate. @p e1 and @p e2 are the errors of the last step and
      /// of the one before; ARKODE limits the growth.
      static int next_step_by_error(N_Vector, double, const double h, double, double, const double e1, const double e2, double, int,
                                    const int p, double *next, void *self)
      {
        AdaptiveArkode &arkode = *static_cast<AdaptiveArkode *>(self);
        arkode.error_          = e1;
        const double now = std::max(e1, smallest_error), last = std::max(e2, smallest_error);
        *next = arkode.limits().safety * h * std::pow(now, -0.9 / (p + 1)) * std::pow(last, 0.2 / (p + 1));
        return 0;
      }

      static constexpr double smallest_error = 1e-6; ///< what is below is rounding

      const scene::Node           node_;
      const ArkodeTables          tables_;
      std::optional<ArkodeSystem> system_;
      void                       *memory_ = nullptr;
      double                      error_  = 0; ///< of the last step, relative to the tolerances
    };

    /// Steps as they are given; the error is not looked at. Every step begins from the state alone.
    class FixedArkode : public Integrator
    {
    public:
      FixedArkode(const scene::Node &node, const IntegratorContext &context)
        : node_(node)
        , context_(context)
        , tables_(arkode_tables(node, context.system))
      {}

      void start(State &state) override
      {
        allocate(state);
        form_->start_piece(state);
        form_->gather(state, entries(y_));
        create(state.t);
      }

      StepReport step(const double dt, State &state) override
      {
        allocate(state);
        form_->gather(state, entries(y_));
        if (memory_ == nullptr)
          create(state.t);
        else if (!going_on(state))
          require_success(ARKStepReset(memory_, state.t, y_.get()), "ARKStepReset");
        if (steps_since_estimate_ == 0 && !node_.boolean("force"))
          stable_step_ = system_->stable_step(state.t, y_.get());
        if (dt > stable_step_)
          {
            StepReport refused;
            refused.outcome = StepReport::Outcome::not_converged;
            refused.reason  = unstable(stable_step_, 0);
            return refused;
          }
        steps_since_estimate_ = (steps_since_estimate_ + 1) % SundialsIntegrator::steps_between_looks;
        ARKStepSetFixedStep(memory_, dt);
        const double t_end = state.t + dt;
        ARKStepSetStopTime(memory_, t_end);
        message_.clear();
        double            t      = state.t;
        const int         flag   = ARKStepEvolve(memory_, t_end, y_.get(), &t, ARK_ONE_STEP);
        StepReport        report = form_->take_counts();
        const std::string inner  = form_->take_reason();
        if (flag < 0 || ARKStepGetDky(memory_, t_end, 1, dy_.get()) < 0)
          {
            report.outcome = inner.empty() ? StepReport::Outcome::not_converged : StepReport::Outcome::inadmissible;
            report.reason  = message_ + (inner.empty() ? "" : " (" + inner + ")");
            report.advice  = "\"time/control/type\" = \"error\", with which steps are as short as the method needs them, or another method";
            end_.clear();
            return report;
          }
        const std::size_t n = form_->n_free();
        end_.assign(entries(y_), entries(y_) + 2 * n);
        const State &end = form_->state(t_end, entries(y_), entries(dy_) + n);
        state.t          = t_end;
        state.u          = end.u;
        state.v          = end.v;
        state.a          = end.a;
        end_t_           = t_end;
        return report;
      }

      void load(const Archive &) override { end_.clear(); }

    private:
      void allocate(const State &state)
      {
        if (form_)
          return;
        form_     = std::make_unique<FirstOrderForm>(context_, state);
        sundials_ = std::make_unique<SundialsContext>(form_->communicator());
        y_        = make_sundials_vector(*form_, *sundials_);
        dy_       = make_sundials_vector(*form_, *sundials_);
        const ErrorTolerances::Block newton{node_.number("relative tolerance"), node_.number("absolute tolerance")};
        system_.emplace(tables_, ErrorTolerances{newton, newton}, node_, context_, *form_, *sundials_, state);
      }

      void create(const double t)
      {
        memory_               = system_->begin(t, y_.get());
        steps_since_estimate_ = 0;
        require_success(MYOLINES_KEEP_SUNDIALS_ERRORS(ARKStep, memory_, *sundials_, message_), "to keep errors");
      }

      /// Whether the state is where the last step ended.
      bool going_on(const State &state) const
      {
        return state.t == end_t_ && !end_.empty() && std::equal(end_.begin(), end_.end(), entries(y_));
      }

      const scene::Node                node_;
      const IntegratorContext          context_;
      const ArkodeTables               tables_;
      std::unique_ptr<FirstOrderForm>  form_;
      std::unique_ptr<SundialsContext> sundials_;
      SundialsVector                   y_{nullptr, N_VDestroy}, dy_{nullptr, N_VDestroy};
      std::optional<ArkodeSystem>      system_;
      void                            *memory_ = nullptr;
      std::vector<double>              end_; ///< y where the last step ended; empty: none
      double                           end_t_                = 0;
      double                           stable_step_          = std::numeric_limits<double>::infinity(); ///< [s]
      unsigned int                     steps_since_estimate_ = 0;
      std::string                      message_;
    };
  } // namespace

  IntegratorEntry sundials_arkode_entry()
  {
    using scene::Range;
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    declare_arkode_tables(entry.schema);
    entry.schema
        .number("relative tolerance", 1e-10, "-", Range{0, 1, true, true},
                "Of Newton's method where steps are given: of the sizes of displacements and velocities.")
        .number("absolute tolerance", 1e-12, "m, m/s", Range::positive(), "The same beyond that.");
    entry.make = [](const scene::Node &node, const IntegratorContext &context) { return std::make_unique<FixedArkode>(node, context); };
    entry.make_self_paced = [](const scene::Node &node, const IntegratorContext &context, const ErrorControlLimits &limits) {
      if (const ArkodeTables tables = arkode_tables(node); tables.embedded_order() == 0)
        node.refuse(tables.own ? "embedded" : "explicit table", "the table has no embedded formula to estimate errors with",
                    tables.own ? "weights of order 1 or more" : "another table", "or \"time/control/type\" = \"fixed\"");
      return std::make_unique<AdaptiveArkode>(node, context, limits);
    };
    entry.facts_of_parameters = [](const scene::Node &node) {
      MethodFacts of_tables = facts();
      of_tables.order       = arkode_tables(node).order();
      return of_tables;
    };
    entry.derived = [](const scene::Node &node) {
      const ArkodeTables       tables = arkode_tables(node);
      std::vector<std::string> lines{"order " + std::to_string(tables.order()) + ", embedded order " +
                                     std::to_string(tables.embedded_order()) + ", " + std::to_string(tables.stages()) + " stages"};
      if (tables.own)
        for (const std::string &line : tell(facts_of(*tables.own)))
          lines.push_back(line);
      return lines;
    };
    return entry;
  }
} // namespace myolines
