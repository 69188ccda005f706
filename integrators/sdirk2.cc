// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/dirk_tables.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name    = "sdirk2";
      facts.summary = "Singly diagonally implicit Runge-Kutta of two stages, gamma = 1 - 1/sqrt(2): second order, damps all that is stiff.";
      facts.reference      = "Alexander, Diagonally implicit Runge-Kutta methods for stiff O.D.E.'s, doi:10.1137/0714068";
      facts.order          = 2;
      facts.stability      = "L-stable, stiffly accurate";
      facts.error_exponent = 2;
      return facts;
    }
  } // namespace

  IntegratorEntry sdirk2_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &node, const IntegratorContext &context) {
      return make_dirk(sdirk2_table(), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
