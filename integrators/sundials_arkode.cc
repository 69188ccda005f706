#include <myolines/integrators/sundials_arkode_tables.h>
#include <myolines/integrators/sundials_integrator.h>
#include <myolines/time/start.h>

#include <arkode/arkode_arkstep.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "arkode";
      facts.summary =
          "ARKODE of SUNDIALS: explicit, diagonally implicit and additive Runge-Kutta methods by the names of their tables; steps "
          "given or chosen by error.";
      facts.reference         = "Reynolds et al., doi:10.1145/3594632; the papers of the tables are in the documentation of ARKODE";
      facts.order             = 3;
      facts.stability         = "that of the table; L-stable for the default one";
      facts.second_order_only = true;
      facts.restart           = MethodFacts::Restart::reinitialise;
      return facts;
    }

    /// Right-hand sides and matrices for ARKODE: M y' = f with M = (1, M), f = (v, -F). An additive method splits -F into -F_I of
    /// the implicit part and the rest. An iteration with the matrix M - g df_I/dy and the right-hand side b is
    ///
    ///     (M + g C + g^2 K) x_u = (M + g C) b_u + g b_v,    x_v = (x_u - b_u) / g.
    class ArkodeSystem
    {
    public:
      /// @p implicit is the form of the implicit part, or the whole.
      ArkodeSystem(FirstOrderForm &whole, FirstOrderForm &implicit, const SundialsContext &sundials)
        : whole_(whole)
        , implicit_(implicit)
        , newton_(sundials, [this](const double *b, double *x) { return solve(b, x); })
        , mass_(
              sundials, [this](const double *b, double *x) { return copy(b, x) && whole_.solve_mass(b + n(), x + n()); },
              [this](const double *x, double *y) {
                whole_.apply_mass(x + n(), y + n());
                return copy(x, y);
              })
        , force_(n())
        , other_(n())
      {}

      /// The memory of ARKODE for @p tables at (t, y), with this object as the data of its callbacks.
      void *create(const ArkodeTables &tables, const double t, N_Vector y, const SundialsContext &sundials)
      {
        const ARKRhsFn f_explicit = tables.additive() ? explicit_part : tables.explicit_ ? whole : nullptr;
        const ARKRhsFn f_implicit = tables.additive() ? implicit_part : tables.implicit ? whole : nullptr;
        void *const    memory     = ARKStepCreate(f_explicit, f_implicit, t, y, sundials);
        require_success(ARKStepSetTableName(memory, ("ARKODE_" + tables.implicit.value_or("DIRK_NONE")).c_str(),
                                            ("ARKODE_" + tables.explicit_.value_or("ERK_NONE")).c_str()),
                        "ARKStepSetTableName");
        ARKStepSetUserData(memory, this);
        require_success(ARKStepWFtolerances(memory, error_weights), "ARKStepWFtolerances");
        if (tables.implicit)
          {
            require_success(ARKStepSetLinearSolver(memory, newton_.solver(), newton_.matrix()), "ARKStepSetLinearSolver");
            require_success(ARKStepSetLinSysFn(memory, linearise), "ARKStepSetLinSysFn");
            // f of a stage from what the iteration found: f(z) would magnify what it left by the stiffness
            ARKStepSetDeduceImplicitRhs(memory, SUNTRUE);
            ARKStepSetMaxNonlinIters(memory, maximum_sundials_iterations);
            // fresh at every step: rates of convergence that earlier steps have shown pass a first iteration with a worse matrix
            ARKStepSetLSetupFrequency(memory, 1);
            ARKStepSetLinearSolutionScaling(memory, SUNFALSE); // solve() takes the present g
          }
        require_success(ARKStepSetMassLinearSolver(memory, mass_.solver(), mass_.matrix(), SUNFALSE), "ARKStepSetMassLinearSolver");
        require_success(ARKStepSetMassFn(memory, [](realtype, SUNMatrix, void *, N_Vector, N_Vector, N_Vector) { return 0; }),
                        "ARKStepSetMassFn");
        ARKStepSetInterpolantDegree(memory, 3); // its derivative at the end of a step is that of the equations, for nothing
        return memory_ = memory;
      }

      std::size_t n() const { return whole_.n_free(); }

      ErrorTolerances tolerances{};

      static int error_weights(N_Vector y, N_Vector weights, void *self)
      {
        const ArkodeSystem &system = *static_cast<ArkodeSystem *>(self);
        set_error_weights(system.tolerances, system.whole_, entries(y), entries(weights));
        return 0;
      }

    private:
      static int whole(const double t, N_Vector y, N_Vector f, void *self)
      {
        ArkodeSystem &system = *static_cast<ArkodeSystem *>(self);
        return system.right_hand_side(system.whole_, t, entries(y), entries(f)) ? 0 : 1;
      }

      static int implicit_part(const double t, N_Vector y, N_Vector f, void *self)
      {
        ArkodeSystem &system = *static_cast<ArkodeSystem *>(self);
        return system.right_hand_side(system.implicit_, t, entries(y), entries(f)) ? 0 : 1;
      }

      static int explicit_part(const double t, N_Vector y, N_Vector f, void *self)
      {
        ArkodeSystem     &system = *static_cast<ArkodeSystem *>(self);
        const std::size_t n      = system.n();
        if (!system.implicit_.residual(t, entries(y), nullptr, system.force_.data()) ||
            !system.whole_.residual(t, entries(y), nullptr, system.other_.data()))
          return 1;
        for (std::size_t i = 0; i < n; ++i)
          {
            entries(f)[i]     = 0;
            entries(f)[n + i] = system.force_[i] - system.other_[i];
          }
        return 0;
      }

      bool right_hand_side(FirstOrderForm &form, const double t, const double *y, double *f)
      {
        if (!form.residual(t, y, nullptr, force_.data()))
          return false;
        std::copy(y + n(), y + 2 * n(), f);
        std::transform(force_.begin(), force_.end(), f + n(), std::negate<>());
        return true;
      }

      static int linearise(const double t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, const int up_to_date, int *renewed, const double,
                           void *self, N_Vector, N_Vector, N_Vector)
      {
        ArkodeSystem &system = *static_cast<ArkodeSystem *>(self);
        if (!up_to_date)
          system.implicit_.linearise(t, entries(y), nullptr);
        *renewed = !up_to_date;
        return 0;
      }

      bool solve(const double *b, double *x)
      {
        double g = 0;
        ARKStepGetCurrentGamma(memory_, &g);
        implicit_.apply({0, g, 1}, b, force_.data());
        for (std::size_t i = 0; i < n(); ++i)
          force_[i] += g * b[n() + i];
        if (!implicit_.solve({g * g, g, 1}, force_.data(), x))
          return false;
        for (std::size_t i = 0; i < n(); ++i)
          x[n() + i] = (x[i] - b[i]) / g;
        return true;
      }

      bool copy(const double *from, double *to) const
      {
        std::copy(from, from + n(), to);
        return true;
      }

      FirstOrderForm     &whole_, &implicit_;
      SundialsMatrix      newton_, mass_;
      std::vector<double> force_, other_;
      void               *memory_ = nullptr; ///< of ARKODE, not ours
    };

    /// What both kinds of steps need, once the layout is known.
    struct ArkodeParts
    {
      ArkodeParts(const ArkodeTables &tables, const scene::Node &node, const IntegratorContext &context, FirstOrderForm &whole,
                  const SundialsContext &sundials, const State &layout)
        : implicit_system(tables.additive() ? context.system.implicit_part(node.text("split")) : nullptr)
        , implicit_form(implicit_system
                            ? std::make_unique<FirstOrderForm>(
                                  IntegratorContext{*implicit_system, context.solver, context.boundary_rates, context.ledger}, layout)
                            : nullptr)
        , system(whole, implicit_form ? *implicit_form : whole, sundials)
      {}

      void begin_piece(const double t)
      {
        if (implicit_form)
          implicit_form->begin_piece(t);
      }

      std::unique_ptr<SemiDiscreteSystem> implicit_system;
      std::unique_ptr<FirstOrderForm>     implicit_form;
      ArkodeSystem                        system;
    };

    /// Steps chosen by error.
    class AdaptiveArkode : public SundialsIntegrator
    {
    public:
      AdaptiveArkode(const scene::Node &node, const IntegratorContext &context, const ErrorControlLimits &limits)
        : SundialsIntegrator(context, limits)
        , node_(node)
        , context_(context)
        , tables_(arkode_tables(node, context.system))
      {}
      ~AdaptiveArkode() override { ARKStepFree(&memory_); }

    private:
      void allocate_solver(const State &layout) override
      {
        parts_.emplace(tables_, node_, context_, form(), sundials(), layout);
        parts_->system.tolerances = tolerances();
      }

      void begin(const double t, const double first_step) override
      {
        form().linearise_mass(t, entries(y()));
        parts_->begin_piece(t);
        ARKStepFree(&memory_);
        memory_ = parts_->system.create(tables_, t, y(), sundials());
        require_success(ARKStepSetErrHandlerFn(memory_, note_error, static_cast<SundialsIntegrator *>(this)), "ARKStepSetErrHandlerFn");
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

      const scene::Node          node_;
      const IntegratorContext    context_;
      const ArkodeTables         tables_;
      std::optional<ArkodeParts> parts_;
      void                      *memory_ = nullptr;
      double                     error_  = 0; ///< of the last step, relative to the tolerances
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
      ~FixedArkode() override { ARKStepFree(&memory_); }

      void start(State &state) override
      {
        allocate(state);
        start_piece(context_, form_->stage_solver(), state);
        consistent_acceleration(context_, form_->stage_solver(), Side::right, state);
        form_->begin_piece(state.t);
        parts_->begin_piece(state.t);
      }

      StepReport step(const double dt, State &state) override
      {
        allocate(state);
        form_->gather(state, entries(y_));
        if (memory_ == nullptr)
          create(state.t);
        else if (!going_on(state))
          require_success(ARKStepReset(memory_, state.t, y_.get()), "ARKStepReset");
        ARKStepSetFixedStep(memory_, dt);
        const double t_end = state.t + dt;
        ARKStepSetStopTime(memory_, t_end);
        message_.clear();
        double     t      = state.t;
        const int  flag   = ARKStepEvolve(memory_, t_end, y_.get(), &t, ARK_ONE_STEP);
        StepReport report = form_->take_counts();
        if (flag < 0 || ARKStepGetDky(memory_, t_end, 1, dy_.get()) < 0)
          {
            const std::string inner = form_->take_reason();
            report.outcome          = inner.empty() ? StepReport::Outcome::not_converged : StepReport::Outcome::inadmissible;
            report.reason           = message_ + (inner.empty() ? "" : " (" + inner + ")");
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

      void save(Archive &) const override {}
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
        parts_.emplace(tables_, node_, context_, *form_, *sundials_, state);
        const ErrorTolerances::Block newton{node_.number("relative tolerance"), node_.number("absolute tolerance")};
        parts_->system.tolerances = {newton, newton};
      }

      void create(const double t)
      {
        form_->linearise_mass(t, entries(y_));
        memory_ = parts_->system.create(tables_, t, y_.get(), *sundials_);
        require_success(ARKStepSetErrHandlerFn(
                            memory_,
                            [](int, const char *, const char *, char *text, void *self) { *static_cast<std::string *>(self) = text; },
                            &message_),
                        "ARKStepSetErrHandlerFn");
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
      std::optional<ArkodeParts>       parts_;
      void                            *memory_ = nullptr;
      std::vector<double>              end_; ///< y where the last step ended; empty: none
      double                           end_t_ = 0;
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
    entry.make = [](const scene::Node &node, const IntegratorContext &context) {
      require_first_order_form(facts(), node, context);
      return std::make_unique<FixedArkode>(node, context);
    };
    entry.make_self_paced = [](const scene::Node &node, const IntegratorContext &context, const ErrorControlLimits &limits) {
      require_first_order_form(facts(), node, context);
      if (arkode_tables(node).embedded_order() == 0)
        node.refuse("explicit table", "the table has no embedded formula to estimate errors with", "another table",
                    "or \"time/control/type\" = \"fixed\"");
      return std::make_unique<AdaptiveArkode>(node, context, limits);
    };
    entry.derived = [](const scene::Node &node) {
      const ArkodeTables tables = arkode_tables(node);
      return std::vector<std::string>{"order " + std::to_string(tables.order()) + ", embedded order " +
                                      std::to_string(tables.embedded_order()) + ", " + std::to_string(tables.stages()) + " stages"};
    };
    return entry;
  }
} // namespace myolines
