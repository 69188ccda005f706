// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/alpha_method.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name               = "wbz alpha";
      facts.summary            = "Wood, Bossak and Zienkiewicz: Newmark's formulas with the inertia taken between the ends of a step.";
      facts.reference          = "Wood, Bossak and Zienkiewicz, doi:10.1002/nme.1620151011";
      facts.order              = 2;
      facts.stability          = "unconditional, spectral radius at infinity (1 + alpha)/(1 - alpha)";
      facts.unknowns           = MethodFacts::Unknowns::every_order_if_damped;
      facts.error_exponent     = 3;
      facts.estimates_velocity = false;
      return facts;
    }

    /// (1 - alpha) M a_1 + alpha M a_0, alpha <= 0.
    AlphaCoefficients coefficients(const scene::Node &node) { return AlphaCoefficients::second_order(node.number("alpha"), 0); }
  } // namespace

  IntegratorEntry wbz_alpha_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.number("alpha", -0.1, "-", scene::Range::closed(-1, 0),
                        "Weight of the acceleration at the beginning of a step; 0: average acceleration, -1: most damping.");
    declare_first_step(entry.schema);
    entry.derived = [](const scene::Node &node) { return describe(coefficients(node)); };
    entry.make    = [](const scene::Node &node, const IntegratorContext &context) {
      return make_alpha_method(coefficients(node), ForceEvaluation::weighted_end_forces, first_step(node), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
