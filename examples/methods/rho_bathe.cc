// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/dirk_tables.h>
#include <myolines/time/first_step.h>

#include <sstream>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "rho bathe";
      facts.summary =
          "The rho-infinity composite method: a trapezoidal step to t + g dt, then a combination of all three slopes to t + dt.";
      facts.reference      = "Noh and Bathe, doi:10.1016/j.compstruc.2018.11.001; Bathe and Baig, doi:10.1016/j.compstruc.2005.08.001";
      facts.order          = 2;
      facts.stability      = "A-stable, damps high frequencies by the spectral radius; L-stable for 0, where it is tr-bdf2";
      facts.error_exponent = 3;
      return facts;
    }
  } // namespace

  IntegratorEntry rho_bathe_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.number("spectral radius", 0.5, "-", scene::Range::closed(0, 1),
                        "What is left of the highest frequencies after a step: 0 damps them at once, 1 not at all.");
    declare_first_step(entry.schema);
    entry.derived = [](const scene::Node &node) {
      std::ostringstream text;
      text << "first part ends at t + " << bathe_table(node.number("spectral radius")).c(1) << " dt; spectral radius at infinity "
           << node.number("spectral radius");
      return std::vector<std::string>{text.str()};
    };
    entry.make = [](const scene::Node &node, const IntegratorContext &context) {
      return make_dirk(bathe_table(node.number("spectral radius")), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
