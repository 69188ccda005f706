// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/midpoint_rule.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name      = "implicit midpoint";
      facts.summary   = "Forces in the middle between the ends of a step; conserves quadratic invariants, such as momenta.";
      facts.reference = "Hairer, Lubich and Wanner, Geometric Numerical Integration, doi:10.1007/3-540-30666-8, II.1.3 and IV.2";
      facts.order     = 2;
      facts.stability = "unconditional for linear systems, without damping";
      facts.unknowns  = MethodFacts::Unknowns::second_order;
      return facts;
    }
  } // namespace

  IntegratorEntry implicit_midpoint_entry() { return midpoint_entry(ForceEvaluation::averaged_state, facts()); }
} // namespace myolines
