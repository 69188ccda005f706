// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/particles/spring_pendulum.h>
#include <myolines/system/band_linearisation.h>

#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    using Plane = std::array<double, 2>;

    Plane place(const Vector &x) { return {{x.local_element(0), x.local_element(1)}}; }

    double distance(const Plane &x) { return std::hypot(x[0], x[1]); }
  } // namespace

  scene::Schema spring_pendulum_schema()
  {
    using scene::Range;
    scene::Schema schema("One mass in a plane on a spring from the origin, m x'' + k (r - L) x/r + m g e_y = 0 with r = |x|.");
    schema.number("mass", 1, "kg", Range::positive(), "Mass m.")
        .number("stiffness", 1e4, "N/m", Range::positive(), "Stiffness k of the spring.")
        .number("length", 1, "m", Range::not_negative(), "Length L of the spring at rest.")
        .number("gravity", 0, "m/s^2", Range::any(), "Gravity g, along -y.")
        .text("position", "1 0", "[m] Coordinates at the start.")
        .text("velocity", "0 1", "[m/s] Velocity at the start.");
    return schema;
  }

  SpringPendulumParameters read_spring_pendulum(const scene::Node &system)
  {
    const auto pair = [&](const std::string &name) {
      const std::vector<double> x = system.numbers(name, "two numbers: along x and y");
      if (x.size() != 2)
        system.refuse(name, "has " + std::to_string(x.size()) + " numbers", "two: along x and y");
      return Plane{{x[0], x[1]}};
    };
    SpringPendulumParameters p;
    p.mass      = system.number("mass");
    p.stiffness = system.number("stiffness");
    p.length    = system.number("length");
    p.gravity   = system.number("gravity");
    p.position  = pair("position");
    p.velocity  = pair("velocity");
    if (distance(p.position) == 0)
      system.refuse("position", "is the origin, where the spring has no direction", "a place beside the origin");
    return p;
  }

  SpringPendulum::SpringPendulum(const SpringPendulumParameters &parameters, WorkLedger &ledger)
    : parameters_(parameters)
    , ledger_(ledger)
    , layout_(dealii::complete_index_set(2), MPI_COMM_SELF)
  {
    constraints_.close();
    layout_.update_ghost_values();
  }

  Capabilities SpringPendulum::capabilities() const
  {
    Capabilities c;
    c.rates             = false;
    c.symmetric_tangent = true;
    c.energy            = true;
    c.two_states        = true;
    return c;
  }

  State SpringPendulum::initial_state(const double t0) const
  {
    State state{t0, layout_, layout_, layout_};
    for (const unsigned int c : {0, 1})
      {
        state.u.local_element(c) = parameters_.position[c];
        state.v.local_element(c) = parameters_.velocity[c];
      }
    return state;
  }

  Evaluation SpringPendulum::residual(const Point &point, Vector &r) const
  {
    ledger_.count("residual evaluations");
    const SpringPendulumParameters &p   = parameters_;
    const Plane                     end = place(point.u), begin = place(point.before != nullptr ? *point.before : point.u);
    const double                    lengths = distance(begin) + distance(end);
    const double tension = p.stiffness * (1 - 2 * p.length / lengths + point.dissipation * (distance(end) - distance(begin)) / lengths);
    for (const unsigned int c : {0, 1})
      r.local_element(c) = p.mass * (point.a.local_element(c) + (c == 1 ? p.gravity : 0)) + tension * (begin[c] + end[c]) / 2;
    if (std::isfinite(r.local_element(0)) && std::isfinite(r.local_element(1)))
      return {};
    r = std::numeric_limits<double>::quiet_NaN();
    return {false, "the spring has no direction"};
  }

  std::vector<Vector> SpringPendulum::rigid_motions(const Vector &w) const
  {
    Vector turned(w);
    turned.local_element(0) = -w.local_element(1);
    turned.local_element(1) = w.local_element(0);
    return {turned};
  }

  std::unique_ptr<Linearisation> SpringPendulum::make_linearisation() const
  {
    return std::make_unique<StoredBands>(std::vector<unsigned int>(2, 2), 1, std::vector<unsigned int>{}, ledger_);
  }

  /// Of one state 2 (x_0 + x_1)/2 and r_0 + r_1 change with x_1, of two only the half of them.
  void SpringPendulum::linearise(const Point &point, Linearisation &linearisation) const
  {
    ledger_.count("linearisations");
    const SpringPendulumParameters &p   = parameters_;
    const Plane                     end = place(point.u), begin = place(point.before != nullptr ? *point.before : point.u);
    const double                    r = distance(end), lengths = distance(begin) + r, share = point.before != nullptr ? 0.5 : 1;
    auto                           &bands = dynamic_cast<StoredBands &>(linearisation);
    bands.begin();
    for (const unsigned int i : {0, 1})
      for (const unsigned int j : {0, 1})
        {
          const double middle = (begin[i] + end[i]) / 2;
          bands.mass(i, j)    = i == j ? p.mass : 0;
          const double lost   = point.dissipation / lengths;
          const double slope  = 2 * (2 * p.length + 2 * point.dissipation * distance(begin)) / (lengths * lengths) * end[j] / r;
          bands.stiffness(i, j) =
              share * p.stiffness * ((i == j ? 1 - 2 * p.length / lengths + lost * (r - distance(begin)) : 0) + middle * slope);
        }
  }

  Energetics SpringPendulum::energetics(const State &state, Side) const
  {
    const SpringPendulumParameters &p = parameters_;
    const Plane                     x = place(state.u), v = place(state.v);
    const double                    stretch = distance(x) - p.length;
    return {p.mass * (v[0] * v[0] + v[1] * v[1]) / 2 + p.stiffness * stretch * stretch / 2 + p.mass * p.gravity * x[1], {}};
  }
} // namespace myolines
