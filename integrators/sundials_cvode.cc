// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_integrator.h>
#include <myolines/integrators/sundials_newton.h>
#include <myolines/time/start.h>

#include <cvodes/cvodes.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "cvode";
      facts.summary =
          "CVODE of SUNDIALS: multistep methods of variable order and step, BDF for stiff systems and Adams-Moulton for others.";
      facts.reference    = "Hindmarsh et al., doi:10.1145/1089014.1089020; Byrne and Hindmarsh, doi:10.1145/355626.355636";
      facts.order        = 5;
      facts.stability    = "BDF: A-stable up to order 2, stiffly stable up to 5; Adams: bounded";
      facts.unknowns     = MethodFacts::Unknowns::second_order;
      facts.scheme_rates = false;
      facts.restart      = MethodFacts::Restart::reinitialise;
      return facts;
    }

    struct Choices
    {
      bool         adams;
      bool         fixed_point;
      unsigned int maximum_order;
      bool         stability_limit_detection;
    };

    /// y' = (v, -M^-1 F). A Newton iteration with the matrix I - g dy'/dy and the right-hand side b is, with the same shifted matrix as
    /// in every other method,
    ///
    ///     (M + g C + g^2 K) x_u = (M + g C) b_u + g M b_v,    x_v = (x_u - b_u) / g.
    class Cvode : public SundialsIntegrator
    {
    public:
      Cvode(const Choices &choices, const IntegratorContext &context, const ErrorControlLimits &limits)
        : SundialsIntegrator(context, limits)
        , choices_(choices)
      {}
      ~Cvode() override
      {
        CVodeFree(&memory_);
        SUNNonlinSolFree(fixed_point_);
      }

    private:
      void allocate_solver(const State &) override
      {
        newton_.emplace(sundials(), [this](const double *b, double *x) { return solve(b, x); });
        force_.resize(form().n_free());
        mass_times_.resize(form().n_free());
      }

      /// The first time it takes the layout from y().
      void begin(const double t, const double first_step) override
      {
        form().linearise_mass(t, entries(y()));
        if (memory_ != nullptr)
          require_success(CVodeReInit(memory_, t, y()), "CVodeReInit");
        else
          create(t);
        CVodeSetInitStep(memory_, first_step);
      }

      void create(const double t)
      {
        memory_ = CVodeCreate(choices_.adams ? CV_ADAMS : CV_BDF, sundials());
        require_success(MYOLINES_KEEP_SUNDIALS_ERRORS(CVode, memory_, sundials(), message()), "to keep errors");
        require_success(CVodeInit(memory_, right_hand_side, t, y()), "CVodeInit");
        CVodeSetUserData(memory_, this);
        CVodeWFtolerances(memory_, [](N_Vector y, N_Vector weights, void *self) {
          const Cvode &cvode = *static_cast<Cvode *>(self);
          set_error_weights(cvode.tolerances(), cvode.form(), entries(y), entries(weights));
          return 0;
        });
        if (choices_.fixed_point)
          {
            fixed_point_ = SUNNonlinSol_FixedPoint(y(), 0, sundials());
            require_success(CVodeSetNonlinearSolver(memory_, fixed_point_), "CVodeSetNonlinearSolver");
          }
        else
          {
            require_success(CVodeSetLinearSolver(memory_, newton_->solver(), newton_->matrix()), "CVodeSetLinearSolver");
            require_success(CVodeSetLinSysFn(memory_, linearise), "CVodeSetLinSysFn");
            CVodeSetLinearSolutionScaling(memory_, SUNFALSE); // solve() takes the present g
            newton_method_.emplace(sundials(), y(), form());
            require_success(CVodeSetNonlinearSolver(memory_, newton_method_->solver()), "CVodeSetNonlinearSolver");
          }
        CVodeSetMaxOrd(memory_, choices_.maximum_order);
        CVodeSetStabLimDet(memory_, choices_.stability_limit_detection);
        CVodeSetMinStep(memory_, limits().minimum_step);
        if (std::isfinite(limits().maximum_step))
          CVodeSetMaxStep(memory_, limits().maximum_step);
        CVodeSetMaxErrTestFails(memory_, limits().rejections);
        CVodeSetEtaMax(memory_, limits().growth);
        CVodeSetNonlinConvCoef(memory_, tolerances().solver_fraction);
        CVodeSetMaxHnilWarns(memory_, -1);
      }

      int evolve(const double t_stop, double &t) override
      {
        CVodeSetStopTime(memory_, t_stop);
        if (newton_method_)
          newton_method_->begin_step(y());
        const int flag = CVode(memory_, t_stop, y(), &t, CV_ONE_STEP);
        if (flag < 0)
          return flag;
        if (flag == CV_TSTOP_RETURN)
          t = t_stop;
        return CVodeGetDky(memory_, t, 1, dy());
      }

      Statistics statistics() const override
      {
        Statistics now;
        CVodeGetNumErrTestFails(memory_, &now.error_failures);
        CVodeGetNumNonlinSolvConvFails(memory_, &now.solver_failures);
        CVodeGetEstLocalErrors(memory_, work());
        now.estimated_error = size(work());
        return now;
      }

      double next_step() const override
      {
        double step = 0;
        CVodeGetCurrentStep(memory_, &step);
        return step;
      }

      static int right_hand_side(const double t, N_Vector y, N_Vector dy, void *self)
      {
        Cvode            &cvode = *static_cast<Cvode *>(self);
        FirstOrderForm   &form  = cvode.form();
        const std::size_t n     = form.n_free();
        double           *v = entries(y) + n, *a = entries(dy) + n;
        if (!form.residual(t, entries(y), nullptr, cvode.force_.data()) || !form.solve_mass(cvode.force_.data(), a))
          return 1;
        for (std::size_t i = 0; i < n; ++i)
          {
            entries(dy)[i] = v[i];
            a[i]           = -a[i];
          }
        return 0;
      }

      static int linearise(const double t, N_Vector y, N_Vector dy, SUNMatrix, const int up_to_date, int *renewed, const double, void *self,
                           N_Vector, N_Vector, N_Vector)
      {
        Cvode &cvode = *static_cast<Cvode *>(self);
        if (!up_to_date)
          cvode.form().linearise(t, entries(y), entries(dy) + cvode.form().n_free());
        *renewed = !up_to_date;
        return 0;
      }

      bool solve(const double *b, double *x)
      {
        const std::size_t n = form().n_free();
        double            g = 0;
        CVodeGetCurrentGamma(memory_, &g);
        form().apply({0, g, 1}, b, force_.data());
        form().apply({0, 0, g}, b + n, mass_times_.data());
        std::transform(force_.begin(), force_.end(), mass_times_.begin(), force_.begin(), std::plus<>());
        if (!form().solve({g * g, g, 1}, force_.data(), x))
          return false;
        for (std::size_t i = 0; i < n; ++i)
          x[n + i] = (x[i] - b[i]) / g;
        return true;
      }

      const Choices                 choices_;
      std::optional<SundialsMatrix> newton_;
      std::optional<SundialsNewton> newton_method_;
      SUNNonlinearSolver            fixed_point_ = nullptr;
      void                         *memory_      = nullptr;
      std::vector<double>           force_, mass_times_;
    };
  } // namespace

  IntegratorEntry sundials_cvode_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.choice("formula", "bdf", {"bdf", "adams"}, "Backward differentiation, or Adams-Moulton for systems that are not stiff.")
        .choice("iteration", "newton", {"newton", "fixed point"}, "How the implicit formula is solved; fixed points need no tangent.")
        .integer("maximum order", 5, scene::Range::closed(1, 12), "At most 5 for bdf, 12 for adams.")
        .boolean("stability limit detection", false, "Lowers the order of bdf where an oscillation would be unstable at the present one.");
    entry.make_self_paced = [](const scene::Node &node, const IntegratorContext &context, const ErrorControlLimits &limits) {
      const bool adams = node.text("formula") == "adams";
      if (!adams && node.integer("maximum order") > 5)
        node.refuse("maximum order", "bdf has no order above 5", "1 to 5");
      if (adams && node.boolean("stability limit detection"))
        node.refuse("stability limit detection", "is for bdf only", "false");
      return std::make_unique<Cvode>(Choices{adams, node.text("iteration") == "fixed point",
                                             static_cast<unsigned int>(node.integer("maximum order")),
                                             node.boolean("stability limit detection")},
                                     context, limits);
    };
    return entry;
  }
} // namespace myolines
