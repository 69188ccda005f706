// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/alpha_method.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name      = "generalized alpha";
      facts.summary   = "Inertia and force both between the ends of a step: least damping of low frequencies for a chosen one at infinity.";
      facts.reference = "Chung and Hulbert, doi:10.1115/1.2900803; Jansen, Whiting and Hulbert, doi:10.1016/S0045-7825(00)00203-6";
      facts.order     = 2;
      facts.stability = "unconditional";
      facts.unknowns  = MethodFacts::Unknowns::every_order_if_damped;
      facts.error_exponent     = 3;
      facts.estimates_velocity = false;
      facts.least_damping      = true;
      return facts;
    }

    AlphaCoefficients from_radius(const double radius)
    {
      return AlphaCoefficients::second_order((2 * radius - 1) / (radius + 1), radius / (radius + 1));
    }

    /// Jansen, Whiting and Hulbert weigh the end of a step, Chung and Hulbert the beginning.
    AlphaCoefficients coefficients(const scene::Node &node)
    {
      if (node.text("given by") == "spectral radius")
        return from_radius(node.number("spectral radius at infinity"));
      const double m = node.number("alpha m"), f = node.number("alpha f");
      const bool   weights_of_end = node.text("convention") == "jansen whiting hulbert";
      return AlphaCoefficients::second_order(weights_of_end ? 1 - m : m, weights_of_end ? 1 - f : f);
    }

    /// What ranges of single parameters cannot say.
    void check(const scene::Node &node)
    {
      const AlphaCoefficients c = coefficients(node);
      if (!(c.alpha_m <= c.alpha_f && c.alpha_f <= 0.5))
        node.refuse("alpha m", "the method is unstable with these coefficients",
                    "alpha m <= alpha f <= 1/2 as weights of the beginning of a step (chung hulbert)",
                    "in the convention \"jansen whiting hulbert\": alpha m >= alpha f >= 1/2");
    }

    scene::Schema schema()
    {
      using scene::Range;
      scene::Schema radius("One number determines all coefficients.");
      radius.number("spectral radius at infinity", 0.8, "-", Range::closed(0, 1),
                    "What is left per step of a mode of infinite frequency: 1 nothing is damped, 0 it is gone after one step.");
      scene::Schema coefficients("alpha_m and alpha_f; beta and gamma follow for second order.");
      coefficients.number("alpha m", std::nullopt, "-", Range::closed(-2, 2), "Weight of accelerations.")
          .number("alpha f", std::nullopt, "-", Range::closed(-2, 2), "Weight of forces.")
          .choice("convention", "chung hulbert", {"chung hulbert", "jansen whiting hulbert"},
                  "What \"alpha m\" and \"alpha f\" weigh: the beginning of a step, or its end.");
      scene::Schema schema(facts().summary);
      schema.variant("given by", "spectral radius", {{"spectral radius", radius}, {"coefficients", coefficients}},
                     "What determines the method.");
      declare_force_evaluation(schema, "weighted end forces");
      declare_first_step(schema);
      return schema;
    }
  } // namespace

  IntegratorEntry generalized_alpha_entry()
  {
    IntegratorEntry entry;
    entry.facts   = facts();
    entry.schema  = schema();
    entry.derived = [](const scene::Node &node) { return describe(coefficients(node)); };
    entry.make    = [](const scene::Node &node, const IntegratorContext &context) {
      check(node);
      return make_alpha_method(coefficients(node), force_evaluation(node), first_step(node), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
