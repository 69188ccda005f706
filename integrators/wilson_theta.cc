// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/first_step.h>
#include <myolines/time/start.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name    = "wilson theta";
      facts.summary = "Linear acceleration over theta dt, of which dt is kept; loads are met at t + theta dt, beyond the end of the step.";
      facts.reference    = "Wilson, Farhoomand and Bathe, doi:10.1002/eqe.4290010305";
      facts.order        = 2;
      facts.stability    = "unconditional for theta >= (1 + sqrt(3))/2, overshoots at large steps";
      facts.unknowns     = MethodFacts::Unknowns::second_order;
      facts.scheme_rates = false;
      return facts;
    }

    /// With linear acceleration between t_0 and t_0 + theta dt the values there are, in those at t_1 = t_0 + dt,
    ///
    ///     a_theta = (1 - theta) a_0 + theta a_1,   v_theta = v_0 + theta dt a_0 + theta^2 (v_1 - v_0 - dt a_0),
    ///     u_theta = u_0 + theta dt v_0 + (theta dt)^2/2 a_0 + theta^3 (u_1 - u_0 - dt v_0 - dt^2/2 a_0),
    ///
    /// so that the unknown belongs to the end of the step, and prescribed unknowns are met at t_1.
    ///
    /// Forces at t_1 are nowhere in balance: they hold K dt v_0 of stiff modes. Velocities of an L-stable step in which forces have jumped
    /// mean nothing there, those of a second one do, so that pieces begin with two. Steps whose t_theta lies beyond a kink, where loads
    /// are others, are L-stable, too.
    class WilsonTheta : public Integrator
    {
    public:
      WilsonTheta(const double theta, const FirstStep first, const IntegratorContext &context)
        : theta_(theta)
        , system_(context.system)
        , solver_(context)
        , starter_(first, solver_, context, 2, 2)
        , end_(context.make_state())
        , offset_(end_)
      {}

      void start(State &state) override { starter_.start(state); }

      StepReport step(const double dt, State &state) override
      {
        if (!system_.events(state.t, state.t + theta_ * dt).empty())
          starter_.kink_ahead();
        return starter_.takes_next_step() ? starter_.step(dt, state) : go_on(dt, state);
      }

      void remember(Memory &memory) override { starter_.remember(memory); }

    private:
      StepReport go_on(const double dt, State &state)
      {
        combine(end_.u, {{1, &state.u}, {dt, &state.v}, {dt * dt / 3, &state.a}});
        combine(end_.v, {{1, &state.v}, {dt / 2, &state.a}});
        end_.a = 0;

        const double q = theta_, q2 = q * q, q3 = q2 * q;
        combine(offset_.u, {{1 - q3, &state.u}, {(q - q3) * dt, &state.v}, {(q2 - q3) * dt * dt / 2, &state.a}});
        combine(offset_.v, {{1 - q2, &state.v}, {(q - q2) * dt, &state.a}});
        combine(offset_.a, {{1 - q, &state.a}});

        const Stage::Average average{state.t + q * dt, &offset_, {q3, q2, q}};
        Stage                stage;
        stage.t       = state.t + dt;
        stage.c       = {1, 3 / dt, 6 / (dt * dt)};
        stage.average = &average;
        return solver_.step(stage, end_, state);
      }

      const double              theta_;
      const SemiDiscreteSystem &system_;
      StageSolver               solver_;
      Starter                   starter_;
      State                     end_, offset_;
    };
  } // namespace

  IntegratorEntry wilson_theta_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.number("theta", 1.4, "-", scene::Range::closed(1.37, 2), "Length of the collocation interval in steps.");
    declare_first_step(entry.schema);
    entry.derived = [](const scene::Node &) {
      return std::vector<std::string>{
          "the equations are met beyond the ends of steps: forces ring where steps do not resolve what activation "
          "and boundaries of a muscle do"};
    };
    entry.make = [](const scene::Node &node, const IntegratorContext &context) {
      return std::make_unique<WilsonTheta>(node.number("theta"), first_step(node), context);
    };
    return entry;
  }
} // namespace myolines
