// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/alpha_method.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name               = "hht alpha";
      facts.summary            = "Hilber, Hughes and Taylor: Newmark's formulas with the force taken between the ends of a step.";
      facts.reference          = "Hilber, Hughes and Taylor, doi:10.1002/eqe.4290050306; thesis (4.5.1)";
      facts.order              = 2;
      facts.stability          = "unconditional, spectral radius at infinity (1 + alpha)/(1 - alpha)";
      facts.unknowns           = MethodFacts::Unknowns::every_order_if_damped;
      facts.error_exponent     = 3;
      facts.estimates_velocity = false;
      return facts;
    }

    /// (1 + alpha) F_1 - alpha F_0 in the convention of the authors and of the thesis.
    AlphaCoefficients coefficients(const scene::Node &node) { return AlphaCoefficients::second_order(0, -node.number("alpha")); }
  } // namespace

  IntegratorEntry hht_alpha_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.number("alpha", -0.1, "-", scene::Range::closed(-1. / 3, 0),
                        "Weight of the force at the beginning of a step is -alpha; 0: average acceleration, -1/3: most damping.");
    declare_force_evaluation(entry.schema, "weighted end forces");
    declare_first_step(entry.schema);
    entry.derived = [](const scene::Node &node) { return describe(coefficients(node)); };
    entry.make    = [](const scene::Node &node, const IntegratorContext &context) {
      return make_alpha_method(coefficients(node), force_evaluation(node), first_step(node), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
