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

  IntegratorEntry implicit_midpoint_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    declare_composition(entry.schema);
    entry.facts_of_parameters = [](const scene::Node &node) { return facts_of_composition(facts(), node); };
    entry.make                = [](const scene::Node &node, const IntegratorContext &context) {
      return make_midpoint_rule(ForceEvaluation::averaged_state, facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
