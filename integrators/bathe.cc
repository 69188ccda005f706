#include <myolines/time/first_step.h>

#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "bathe";
      facts.summary =
          "The rho-infinity composite method: a trapezoidal step to t + g dt, then a combination of all three slopes to t + dt.";
      facts.reference      = "Noh and Bathe, doi:10.1016/j.compstruc.2018.11.001; Bathe and Baig, doi:10.1016/j.compstruc.2005.08.001";
      facts.order          = 2;
      facts.stability      = "A-stable, damps high frequencies by the spectral radius; L-stable for 0, where it is tr-bdf2";
      facts.error_exponent = 3;
      return facts;
    }

    /// With s = sqrt(2 + 2 rho) the published parameters are g = 2/(2 + s) for the end of the first part, and the weights
    ///
    ///     q_1 = s/4,   q_0 = 1/2 + (g - 1) q_1,   q_2 = 1/2 - g q_1 = g/2
    ///
    /// of the slopes at t, t + g dt and t + dt: both parts solve with one matrix. The embedded formula is the quadrature of third order
    /// with these abscissas; as stages are of second order, it makes a method of third order.
    DirkTable table(const double rho)
    {
      const double s = std::sqrt(2 + 2 * rho), g = 2 / (2 + s), d = g / 2, q1 = s / 4, q0 = 0.5 + (g - 1) * q1;
      const double middle = 1 / (6 * g * (1 - g)), last = 0.5 - g * middle;
      return {{{0}, {d, d}, {q0, q1, d}}, {q0 - (1 - middle - last), q1 - middle, d - last}};
    }
  } // namespace

  IntegratorEntry bathe_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.number("spectral radius", 0.5, "-", scene::Range::closed(0, 1),
                        "What is left of the highest frequencies after a step: 0 damps them at once, 1 not at all.");
    declare_first_step(entry.schema);
    entry.derived = [](const scene::Node &node) {
      std::ostringstream text;
      text << "first part ends at t + " << table(node.number("spectral radius")).c(1) << " dt; spectral radius at infinity "
           << node.number("spectral radius");
      return std::vector<std::string>{text.str()};
    };
    entry.make = [](const scene::Node &node, const IntegratorContext &context) {
      return make_dirk(table(node.number("spectral radius")), facts(), node, context);
    };
    return entry;
  }
} // namespace myolines
