// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/midpoint_rule.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "energy momentum";
      facts.summary =
          "The implicit midpoint rule with forces of two states: conserves energy and momenta of bodies that nothing drives or damps.";
      facts.reference  = "Simo and Tarnow, doi:10.1007/BF00913408; Gonzalez, doi:10.1016/S0045-7825(00)00189-4";
      facts.order      = 2;
      facts.stability  = "unconditional, by energy, where all forces have one; without damping";
      facts.unknowns   = MethodFacts::Unknowns::second_order;
      facts.two_states = true;
      return facts;
    }
  } // namespace

  /// M (v_1 - v_0)/dt + F(u_0, u_1) = 0, u_1 - u_0 = dt (v_0 + v_1)/2, with F (u_1 - u_0) = W(u_1) - W(u_0): the work of the forces is what
  /// kinetic energy loses. What is active or viscous, and loads, act as in the implicit midpoint rule.
  IntegratorEntry energy_momentum_entry() { return midpoint_entry(ForceEvaluation::two_states, facts()); }
} // namespace myolines
