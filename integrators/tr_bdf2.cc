// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/dirk_tables.h>
#include <myolines/time/first_step.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name           = "tr-bdf2";
      facts.summary        = "A trapezoidal step to t + (2 - sqrt(2)) dt, then a backward difference of second order to t + dt.";
      facts.reference      = "Bank et al., doi:10.1109/T-ED.1985.22232; Hosea and Shampine, doi:10.1016/0168-9274(95)00115-8";
      facts.order          = 2;
      facts.stability      = "L-stable, stiffly accurate";
      facts.error_exponent = 3;
      return facts;
    }
  } // namespace

  IntegratorEntry tr_bdf2_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    declare_first_step(entry.schema);
    entry.make = [](const scene::Node &node, const IntegratorContext &context) {
      return make_dirk(tr_bdf2_table(), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
