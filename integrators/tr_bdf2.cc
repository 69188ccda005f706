#include <myolines/time/first_step.h>

#include <cmath>

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

    /// As a Runge-Kutta method whose first stage is the beginning of the step; both implicit stages have the weight d. The
    /// embedded formula is of third order (Hosea and Shampine, table 1).
    DirkTable table()
    {
      const double d = 1 - std::sqrt(0.5), w = std::sqrt(0.125);
      return {{{0}, {d, d}, {w, w, d}}, {w - (1 - w) / 3, w - (3 * w + 1) / 3, d - d / 3}};
    }
  } // namespace

  IntegratorEntry tr_bdf2_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    declare_first_step(entry.schema);
    entry.make = [](const scene::Node &node, const IntegratorContext &context) { return make_dirk(table(), facts(), node, context); };
    return entry;
  }
} // namespace myolines
