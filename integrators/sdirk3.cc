#include <myolines/time/dirk.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name      = "sdirk3";
      facts.summary   = "Singly diagonally implicit Runge-Kutta of three stages, gamma = 0.43587: third order, damps all that is stiff.";
      facts.reference = "Alexander, Diagonally implicit Runge-Kutta methods for stiff O.D.E.'s, doi:10.1137/0714068";
      facts.order     = 3;
      facts.stability = "L-stable, stiffly accurate";
      facts.error_exponent = 3;
      return facts;
    }

    /// gamma is the root of x^3 - 3 x^2 + 3/2 x - 1/6 in (1/6, 1/2): order 3 and L-stable. Every formula
    /// b - theta (1, -2, 1) is of second order, as the abscissas are equidistant; with theta = gamma it is that of the first two stages.
    /// A fifth of this makes error and tolerance agree in the muscle (doc/error_control.md).
    DirkTable table()
    {
      const double gamma = 0.43586652150845899942;
      const double b1    = -(6 * gamma * gamma - 16 * gamma + 1) / 4;
      const double b2    = (6 * gamma * gamma - 20 * gamma + 5) / 4;
      return {{{gamma}, {(1 - gamma) / 2, gamma}, {b1, b2, gamma}}, {gamma / 5, -2 * gamma / 5, gamma / 5}};
    }
  } // namespace

  IntegratorEntry sdirk3_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &node, const IntegratorContext &context) { return make_dirk(table(), facts(), node, context); };
    return entry;
  }
} // namespace myolines
