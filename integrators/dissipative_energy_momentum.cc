// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/first_step.h>
#include <myolines/time/rigid_part.h>

#include <sstream>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "dissipative energy momentum";
      facts.summary =
          "Energy momentum with dissipation of high frequencies in forces and velocities: keeps momenta, and energy never grows.";
      facts.reference  = "Armero and Romero, doi:10.1016/S0045-7825(00)00256-5 and doi:10.1016/S0045-7825(01)00233-X (EDMC-1)";
      facts.order      = 1;
      facts.stability  = "unconditional, by energy, where all forces have one";
      facts.unknowns   = MethodFacts::Unknowns::second_order;
      facts.two_states = true;
      return facts;
    }

    /// The dissipation chi of forces and velocities that leaves @p radius of a mode of infinite frequency.
    double chi_of(const scene::Node &node)
    {
      const double radius = node.number("spectral radius at infinity");
      return (1 - radius) / (1 + radius);
    }

    /// With chi in [0, 1], z = (u_1 - u_0)/dt and w = v_1 - v_0,
    ///
    ///     M w/dt + F(u_0, u_1) + F_chi(u_0, u_1) = 0,      z = (v_0 + v_1)/2 + chi/2 (1 - P) w:
    ///
    /// forces of two states with the dissipation Point::dissipation, and velocities with one that P, the projection on rigid motions, keeps
    /// from momenta. As P is made of z the velocity is a function of u_1, v_1 = v_0 + 2/(1 + chi) (1 + chi P)(z - v_0), and the work of a
    /// step leaves
    ///
    ///     E_1 - E_0 = -F_chi (u_1 - u_0) - chi/2 |(1 - P) w|_M^2.
    ///
    /// In linear systems that do not turn it is the theta method with theta = (1 + chi)/2.
    class DissipativeEnergyMomentum : public Integrator
    {
    public:
      DissipativeEnergyMomentum(const double chi, const IntegratorContext &context)
        : chi_(chi)
        , two_states_(!context.system.capabilities().linear)
        , turns_(chi != 0 && !context.system.rigid_motions(context.make_vector()).empty())
        , solver_(context)
        , starter_(FirstStep::own, solver_, context)
        , rigid_(context, solver_, 2 * chi / (1 + chi))
        , end_(context.make_state())
        , offset_(end_)
      {}

      void start(State &state) override { starter_.start(state); }

      StepReport step(const double dt, State &state) override
      {
        const double theta = (1 + chi_) / 2;
        combine(end_.u, {{1, &state.u}, {dt, &state.v}});
        combine(end_.v, {{1, &state.v}});
        end_.a = 0;
        combine(offset_.u, {{two_states_ ? 0 : 1 - theta, &state.u}});
        combine(offset_.v, {{1 - theta, &state.v}});
        offset_.a = 0;

        const Stage::Average average{state.t + dt / 2, &offset_, {two_states_ ? 1 : theta, theta, 1}};
        Stage                stage;
        stage.t       = state.t + dt;
        stage.c       = {1, 1 / (theta * dt), 1 / (theta * dt * dt)};
        stage.average = &average;
        if (two_states_)
          {
            stage.before      = &state.u;
            stage.dissipation = chi_;
          }
        if (turns_)
          {
            rigid_.begin(dt, state);
            stage.beyond      = &rigid_;
            stage.beyond_rate = 1 / dt;
          }
        return solver_.step(stage, end_, state);
      }

    private:
      const double chi_;
      const bool   two_states_, turns_;
      StageSolver  solver_;
      Starter      starter_;
      RigidPart    rigid_;
      State        end_, offset_;
    };

    std::vector<std::string> describe(const scene::Node &node)
    {
      const double       chi = chi_of(node);
      std::ostringstream text;
      text.precision(12);
      text << "chi = " << chi << " in forces and velocities; error constant of a step " << chi / 2 << " dt^2 u''";
      return {text.str(), chi == 0 ? "order 2 with these" : "order 1 with these"};
    }
  } // namespace

  IntegratorEntry dissipative_energy_momentum_entry()
  {
    using scene::Range;
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(facts().summary);
    entry.schema.number("spectral radius at infinity", 0.8, "-", Range::closed(0, 1),
                        "What is left per step of a mode of infinite frequency: 1 nothing is damped (energy momentum), 0 it is gone after "
                        "one step (in linear systems backward Euler).");
    entry.facts_of_parameters = [](const scene::Node &node) {
      MethodFacts with = facts();
      with.order       = chi_of(node) == 0 ? 2 : 1;
      return with;
    };
    entry.derived = describe;
    entry.make    = [](const scene::Node &node, const IntegratorContext &context) {
      IntegratorContext exact = context;
      exact.error_norm        = nullptr; // what is left of the equations is not conserved
      return std::make_unique<DissipativeEnergyMomentum>(chi_of(node), exact);
    };
    return entry;
  }
} // namespace myolines
