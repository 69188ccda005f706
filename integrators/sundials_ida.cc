// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_integrator.h>
#include <myolines/integrators/sundials_newton.h>
#include <myolines/time/start.h>

#include <idas/idas.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name         = "ida";
      facts.summary      = "IDA of SUNDIALS: implicit equations by BDF of variable order and step, with fixed leading coefficient; never "
                           "inverts the mass, and takes "
                           "systems of first order without inertia, too.";
      facts.reference    = "Hindmarsh et al., doi:10.1145/1089014.1089020; Brenan, Campbell and Petzold, doi:10.1137/1.9781611971224";
      facts.order        = 5;
      facts.stability    = "A-stable up to order 2, stiffly stable up to 5";
      facts.unknowns     = MethodFacts::Unknowns::first_or_second_order;
      facts.scheme_rates = false;
      facts.restart      = MethodFacts::Restart::reinitialise;
      return facts;
    }

    /// u' - v = 0, R(t, u, v, v') = 0. With c the leading coefficient of the formula, y' = c y + ..., a Newton iteration with the
    /// right-hand side b is
    ///
    ///     (K + c C + c^2 M) x_u = b_v + (C + c M) b_u,    x_v = c x_u - b_u.
    ///
    /// The first y' is consistent: v and the solution of M a = -F.
    class Ida : public SundialsIntegrator
    {
    public:
      Ida(const unsigned int maximum_order, const IntegratorContext &context, const ErrorControlLimits &limits)
        : SundialsIntegrator(context, limits)
        , maximum_order_(maximum_order)
      {}
      ~Ida() override { IDAFree(&memory_); }

    private:
      void allocate_solver(const State &) override
      {
        newton_.emplace(sundials(), [this](const double *b, double *x) { return solve(b, x); });
        right_.resize(form().n_free());
      }

      void begin(const double t, const double first_step) override
      {
        if (memory_ != nullptr)
          require_success(IDAReInit(memory_, t, y(), dy()), "IDAReInit");
        else
          create(t);
        IDASetInitStep(memory_, first_step);
      }

      void create(const double t)
      {
        memory_ = IDACreate(sundials());
        require_success(MYOLINES_KEEP_SUNDIALS_ERRORS(IDA, memory_, sundials(), message()), "to keep errors");
        require_success(IDAInit(memory_, residual, t, y(), dy()), "IDAInit");
        IDASetUserData(memory_, this);
        IDAWFtolerances(memory_, [](N_Vector y, N_Vector weights, void *self) {
          const Ida &ida = *static_cast<Ida *>(self);
          set_error_weights(ida.tolerances(), ida.form(), entries(y), entries(weights));
          return 0;
        });
        require_success(IDASetLinearSolver(memory_, newton_->solver(), newton_->matrix()), "IDASetLinearSolver");
        require_success(IDASetJacFn(memory_, linearise), "IDASetJacFn");
        newton_method_.emplace(sundials(), y(), form());
        require_success(IDASetNonlinearSolver(memory_, newton_method_->solver()), "IDASetNonlinearSolver");
        IDASetLinearSolutionScaling(memory_, SUNFALSE); // solve() takes the present c
        IDASetMaxOrd(memory_, maximum_order_);
        IDASetMinStep(memory_, limits().minimum_step);
        if (std::isfinite(limits().maximum_step))
          IDASetMaxStep(memory_, limits().maximum_step);
        IDASetMaxErrTestFails(memory_, limits().rejections);
        IDASetEtaMax(memory_, limits().growth);
        IDASetNonlinConvCoef(memory_, tolerances().solver_fraction);
      }

      int evolve(const double t_stop, double &t) override
      {
        newton_method_->begin_step(y());
        IDASetStopTime(memory_, t_stop);
        const int flag = IDASolve(memory_, t_stop, &t, y(), dy(), IDA_ONE_STEP);
        if (flag == IDA_TSTOP_RETURN)
          t = t_stop;
        return flag;
      }

      Statistics statistics() const override
      {
        Statistics now;
        IDAGetNumErrTestFails(memory_, &now.error_failures);
        IDAGetNumNonlinSolvConvFails(memory_, &now.solver_failures);
        IDAGetEstLocalErrors(memory_, work());
        now.estimated_error = size(work());
        return now;
      }

      double next_step() const override
      {
        double step = 0;
        IDAGetCurrentStep(memory_, &step);
        return step;
      }

      static int residual(const double t, N_Vector y, N_Vector dy, N_Vector r, void *self)
      {
        FirstOrderForm   &form = static_cast<Ida *>(self)->form();
        const std::size_t n    = form.n_free();
        for (std::size_t i = 0; i < n; ++i)
          entries(r)[i] = entries(dy)[i] - entries(y)[n + i];
        return form.residual(t, entries(y), entries(dy) + n, entries(r) + n) ? 0 : 1;
      }

      static int linearise(const double t, const double, N_Vector y, N_Vector dy, N_Vector, SUNMatrix, void *self, N_Vector, N_Vector,
                           N_Vector)
      {
        Ida &ida = *static_cast<Ida *>(self);
        ida.form().linearise(t, entries(y), entries(dy) + ida.form().n_free());
        return 0;
      }

      bool solve(const double *b, double *x)
      {
        const std::size_t n = form().n_free();
        double            c = 0;
        IDAGetCurrentCj(memory_, &c);
        form().apply({0, 1, c}, b, right_.data());
        for (std::size_t i = 0; i < n; ++i)
          right_[i] += b[n + i];
        if (!form().solve({1, c, c * c}, right_.data(), x))
          return false;
        for (std::size_t i = 0; i < n; ++i)
          x[n + i] = c * x[i] - b[i];
        return true;
      }

      const unsigned int            maximum_order_;
      std::optional<SundialsMatrix> newton_;
      std::optional<SundialsNewton> newton_method_;
      void                         *memory_ = nullptr;
      std::vector<double>           right_;
    };
  } // namespace

  IntegratorEntry sundials_ida_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.integer("maximum order", 5, scene::Range::closed(1, 5), "Of the formulas.");
    entry.make_self_paced = [](const scene::Node &node, const IntegratorContext &context, const ErrorControlLimits &limits) {
      return std::make_unique<Ida>(node.integer("maximum order"), context, limits);
    };
    return entry;
  }
} // namespace myolines
