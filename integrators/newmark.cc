// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/alpha_method.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name               = "newmark";
      facts.summary            = "Newmark's family: accelerations between the ends of a step are interpolated with weights beta and gamma.";
      facts.reference          = "Newmark, doi:10.1061/JMCEA3.0000098; thesis (4.4.4)";
      facts.order              = 2;
      facts.stability          = "unconditional for beta >= gamma/2 >= 1/4, without damping of high frequencies for gamma = 1/2";
      facts.unknowns           = MethodFacts::Unknowns::every_order_if_damped;
      facts.error_exponent     = 3;
      facts.estimates_velocity = false;
      return facts;
    }

    struct Preset
    {
      const char *name;
      double      beta, gamma;
      const char *summary;
    };
    constexpr Preset presets[] = {
        {"average acceleration", 0.25, 0.5,
         "beta = 1/4, gamma = 1/2, the trapezoidal rule: unconditionally stable, conserves the energy of linear systems."},
        {"linear acceleration", 1. / 6, 0.5, "beta = 1/6, gamma = 1/2: stable for omega dt <= 2 sqrt(3)."},
        {"fox goodwin", 1. / 12, 0.5, "beta = 1/12, gamma = 1/2: period error of fourth order; stable for omega dt <= sqrt(6)."},
        {"central difference", 0, 0.5,
         "beta = 0, gamma = 1/2, damping implicit: stable for omega dt <= 2; for a mass and damping matrix that is easily solved."},
    };

    AlphaCoefficients coefficients(const scene::Node &node)
    {
      const std::string name = node.text("preset");
      for (const Preset &preset : presets)
        if (preset.name == name)
          return {0, 0, preset.beta, preset.gamma};
      return {0, 0, node.number("beta"), node.number("gamma")};
    }

    /// Members that are stable only where everything is resolved begin with what they resolve.
    bool takes_long_steps(const std::string &preset) { return preset == "average acceleration" || preset == "own"; }

    scene::Schema schema()
    {
      using scene::Range;
      std::vector<std::pair<std::string, scene::Schema>> alternatives;
      for (const Preset &preset : presets)
        {
          scene::Schema schema(preset.summary);
          if (takes_long_steps(preset.name))
            declare_first_step(schema);
          alternatives.emplace_back(preset.name, schema);
        }
      scene::Schema own("beta and gamma as given here.");
      own.number("beta", std::nullopt, "-", Range::closed(0, 2), "Weight of a_1 in u_1, in dt^2.")
          .number("gamma", std::nullopt, "-", Range::closed(0.5, 2), "Weight of a_1 in v_1, in dt; 1/2 for second order.");
      declare_first_step(own);
      alternatives.emplace_back("own", own);
      scene::Schema schema(facts().summary);
      schema.variant("preset", "average acceleration", alternatives, "Member of the family.");
      return schema;
    }
  } // namespace

  IntegratorEntry newmark_entry()
  {
    IntegratorEntry entry;
    entry.facts   = facts();
    entry.schema  = schema();
    entry.derived = [](const scene::Node &node) { return describe(coefficients(node)); };
    entry.make    = [](const scene::Node &node, const IntegratorContext &context) {
      const FirstStep first = takes_long_steps(node.text("preset")) ? first_step(node) : FirstStep::own;
      return make_alpha_method(coefficients(node), ForceEvaluation::weighted_end_forces, first, facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
