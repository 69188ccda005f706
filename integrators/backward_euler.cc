// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/dirk.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name      = "backward euler";
      facts.summary   = "Implicit Euler for u and v: robust, strongly dissipative, one nonlinear solve per step.";
      facts.reference = "Hairer and Wanner, Solving Ordinary Differential Equations II, doi:10.1007/978-3-642-05221-7, IV.3";
      facts.order     = 1;
      facts.stability = "L-stable";
      return facts;
    }
  } // namespace

  /// v_1 = (u_1 - u_0)/dt, a_1 = (v_1 - v_0)/dt, R(t_1, u_1, v_1, a_1) = 0: the implicit method of one stage.
  IntegratorEntry backward_euler_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &node, const IntegratorContext &context) { return make_dirk({{{1}}}, facts(), node, context); };
    return entry;
  }
} // namespace myolines
