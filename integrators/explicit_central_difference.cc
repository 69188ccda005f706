// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/stable_step.h>
#include <myolines/time/start.h>

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
      facts.name      = "explicit central difference";
      facts.summary   = "Velocity Verlet: forces at known states, one solve with the mass per step; refuses steps beyond the stable one.";
      facts.reference = "Hughes, The Finite Element Method (2000), 9.1 and 9.5; Hairer, Lubich and Wanner, doi:10.1017/S0962492902000144";
      facts.order     = 2;
      facts.stability = "omega^2 dt^2 + 8 xi omega dt <= 4";
      facts.unknowns  = MethodFacts::Unknowns::second_order;
      facts.solves    = MethodFacts::Solves::mass;
      return facts;
    }

    /// u_1 = u_0 + dt v_0 + dt^2/2 a_0, M a_1 = -F(t_1, u_1, v_0 + dt a_0), v_1 = v_0 + dt/2 (a_0 + a_1).
    ///
    /// The rates of F come from a predicted velocity, which keeps the second order and costs stability: for
    /// a + 2 xi omega v + omega^2 u = 0 an eigenvalue is -1 at (omega dt)^2 + 8 xi omega dt = 4. The stable step of a system
    /// is estimated from the largest eigenvalues of M^-1 K and M^-1 C.
    class ExplicitCentralDifference : public Integrator
    {
    public:
      ExplicitCentralDifference(const double safety, const unsigned int interval, const IntegratorContext &context)
        : safety_(safety)
        , interval_(interval)
        , context_(context)
        , solver_(context)
        , end_(context.make_state())
        , offset_(end_)
      {}

      void start(State &state) override
      {
        start_piece(context_, solver_, state);
        consistent_acceleration(context_, solver_, Side::right, state);
        steps_since_estimate_ = interval_;
      }

      StepReport step(const double dt, State &state) override
      {
        StepReport report;
        if (steps_since_estimate_ >= interval_)
          estimate(state, report);
        if (!report.accepted())
          return report;
        if (dt > stable_step_)
          {
            refuse(dt, report);
            return report;
          }
        advance(dt, state, report);
        report.initial_residual = report.final_residual = std::nullopt; // nobody looks at what is left of the equations
        if (report.accepted())
          ++steps_since_estimate_;
        return report;
      }

      void remember(Memory &memory) override
      {
        memory.keep("stable step", stable_step_);
        memory.keep("steps since the estimate", steps_since_estimate_);
      }

    private:
      void advance(const double dt, State &state, StepReport &report)
      {
        combine(end_.u, {{1, &state.u}, {dt, &state.v}, {dt * dt / 2, &state.a}});
        combine(end_.v, {{1, &state.v}, {dt / 2, &state.a}});
        end_.a    = 0;
        offset_.u = 0;
        offset_.a = 0;
        combine(offset_.v, {{1, &state.v}, {dt, &state.a}});

        const Stage::Average at{state.t + dt, &offset_, {1, 0, 1}};
        Stage                stage;
        stage.t       = state.t + dt;
        stage.c       = {0, dt / 2, 1};
        stage.average = &at;
        record(solver_.solve(stage, end_, state), report);
        if (report.accepted())
          swap(state, end_);
      }

      void refuse(const double dt, StepReport &report) const
      {
        std::ostringstream text;
        text << "the step " << dt << " s is longer than " << stable_step_ << " s, the stable step of \"" << facts().name
             << "\" (estimated, with its safety factor)";
        report.outcome      = StepReport::Outcome::not_converged;
        report.longest_step = stable_step_;
        report.reason       = text.str();
      }

      void estimate(const State &state, StepReport &report)
      {
        constexpr double   margin      = 1.01; // of the estimates
        LargestEigenvalues eigenvalues = largest_eigenvalues({state.t, Side::right, state.u, state.v, state.a}, context_, solver_, report);
        const double       stiffness   = margin * std::max(0., eigenvalues.stiffness);
        const double       rates       = margin * std::max(0., eigenvalues.rates);
        // dt^2 stiffness + 4 dt rates = 4
        const double limit    = rates + std::sqrt(rates * rates + stiffness);
        stable_step_          = limit > 0 ? safety_ * 2 / limit : std::numeric_limits<double>::infinity();
        steps_since_estimate_ = 0;
      }

      const double            safety_;
      const double            interval_;
      const IntegratorContext context_;
      StageSolver             solver_;
      double                  stable_step_          = 0; ///< [s]
      double                  steps_since_estimate_ = 0;
      State                   end_, offset_;
    };
  } // namespace

  IntegratorEntry explicit_central_difference_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.number("safety", 0.9, "-", scene::Range{0, 1, true, false}, "Part of the estimated stable step that may be used.")
        .integer("estimate interval", 100, scene::Range::closed(1, 1000000000), "Steps between two estimates of the stable step.");
    entry.make = [](const scene::Node &node, const IntegratorContext &context) {
      return std::make_unique<ExplicitCentralDifference>(node.number("safety"), node.integer("estimate interval"), context);
    };
    return entry;
  }
} // namespace myolines
