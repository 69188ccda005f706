// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/particles/mass_chain.h>
#include <myolines/system/band_linearisation.h>
#include <myolines/system/file_drive.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    /// As many as there are masses, each in [0, infinity), or (0, infinity).
    std::vector<double> read_chain(const scene::Node &system, const std::string &name, const std::size_t size, const bool may_be_zero)
    {
      const std::vector<double> values = system.numbers(name, "numbers with blanks between");
      if (size > 0 && values.size() != size)
        system.refuse(name, "has " + std::to_string(values.size()) + " numbers, there are " + std::to_string(size) + " masses",
                      "one for each mass, that of the spring before it");
      for (const double value : values)
        if (!(may_be_zero ? value >= 0 : value > 0))
          system.refuse(name, "has a number that is " + std::string(may_be_zero ? "negative" : "not positive"),
                        may_be_zero ? "numbers >= 0" : "numbers > 0");
      return values;
    }
  } // namespace

  scene::Schema mass_chain_schema()
  {
    scene::Schema schema(
        "Masses in a row with springs between them, behind a support that moves; the model problem of Bathe and Noh (2012).");
    schema.text("masses", "1 1", "[kg] From the support on, with blanks between.")
        .text("stiffnesses", "1e7 1", "[N/m] Of the springs, the one at the support first.")
        .text("dampings", "0 0", "[N s/m] Of the dampers beside the springs.")
        .number("support mass", 0, "kg", scene::Range::not_negative(), "A mass that moves with the support; it counts in the force only.")
        .section("support", drive_schema("displacement of the support", "m"));
    return schema;
  }

  MassChainParameters read_mass_chain(const scene::Node &system)
  {
    MassChainParameters p;
    p.masses       = read_chain(system, "masses", 0, false);
    p.stiffnesses  = read_chain(system, "stiffnesses", p.masses.size(), false);
    p.dampings     = read_chain(system, "dampings", p.masses.size(), true);
    p.support_mass = system.number("support mass");
    p.support      = make_drive(system.section("support"), Driven{"displacement of the support", "m"});
    return p;
  }

  MassChain::MassChain(MassChainParameters parameters, WorkLedger &ledger)
    : parameters_(std::move(parameters))
    , ledger_(ledger)
    , layout_(dealii::complete_index_set(size() + 1), MPI_COMM_SELF)
  {
    constraints_.add_line(0);
    constraints_.close();
    layout_.update_ghost_values();
  }

  Capabilities MassChain::capabilities() const
  {
    Capabilities c;
    c.rates             = std::any_of(parameters_.dampings.begin(), parameters_.dampings.end(), [](const double x) { return x != 0; });
    c.linear            = true;
    c.symmetric_tangent = true;
    c.energy            = true;
    return c;
  }

  State MassChain::initial_state(const double t0) const
  {
    State state{t0, layout_, layout_, layout_};
    prescribed(t0, Side::right, state);
    return state;
  }

  void MassChain::prescribed(const double t, const Side side, State &state) const
  {
    state.u.local_element(0) = parameters_.support->value(t, side);
    state.v.local_element(0) = parameters_.support->first_derivative(t, side);
    state.a.local_element(0) = parameters_.support->second_derivative(t, side);
  }

  Evaluation MassChain::residual(const Point &point, Vector &r) const
  {
    ledger_.count("residual evaluations");
    double largest = 0;
    for (unsigned int i = 0; i <= size(); ++i)
      r.local_element(i) = mass(i) * point.a.local_element(i);
    for (unsigned int i = 1; i <= size(); ++i)
      {
        const double force = parameters_.stiffnesses[i - 1] * (point.u.local_element(i) - point.u.local_element(i - 1)) +
                             parameters_.dampings[i - 1] * (point.v.local_element(i) - point.v.local_element(i - 1));
        r.local_element(i) += force;
        r.local_element(i - 1) -= force;
        largest = std::max(largest, std::isfinite(r.local_element(i)) ? 0. : 1.);
      }
    if (largest == 0)
      return {};
    r = std::numeric_limits<double>::quiet_NaN();
    return {false, "the force on a mass is not a finite number"};
  }

  std::unique_ptr<Linearisation> MassChain::make_linearisation() const
  {
    return std::make_unique<StoredBands>(std::vector<unsigned int>(size() + 1, 2), 1, std::vector<unsigned int>{0}, ledger_);
  }

  void MassChain::linearise(const Point &, Linearisation &linearisation) const
  {
    ledger_.count("linearisations");
    auto &bands = dynamic_cast<StoredBands &>(linearisation);
    bands.begin();
    for (unsigned int i = 0; i <= size(); ++i)
      bands.mass(i, i) = mass(i);
    for (unsigned int i = 1; i <= size(); ++i)
      for (const unsigned int a : {i - 1, i})
        for (const unsigned int b : {i - 1, i})
          {
            bands.stiffness(a, b) += a == b ? parameters_.stiffnesses[i - 1] : -parameters_.stiffnesses[i - 1];
            bands.damping(a, b) += a == b ? parameters_.dampings[i - 1] : -parameters_.dampings[i - 1];
          }
  }

  Energetics MassChain::energetics(const State &state, const Side side) const
  {
    Energetics now;
    for (unsigned int i = 1; i <= size(); ++i)
      {
        const double v = state.v.local_element(i), stretch = state.u.local_element(i) - state.u.local_element(i - 1);
        const double rate = v - state.v.local_element(i - 1);
        now.energy += mass(i) / 2 * v * v + parameters_.stiffnesses[i - 1] / 2 * stretch * stretch;
        now.rates.dissipation += parameters_.dampings[i - 1] * rate * rate;
      }
    Vector r(state.u);
    residual({state.t, side, state.u, state.v, state.a}, r);
    const double v = state.v.local_element(0);
    now.energy += mass(0) / 2 * v * v;
    now.rates.external = r.local_element(0) * v;
    return now;
  }

  std::vector<std::string> MassChain::names() const
  {
    std::vector<std::string> names{"Support"};
    for (unsigned int i = 1; i <= size(); ++i)
      names.push_back("Mass " + std::to_string(i));
    return names;
  }
} // namespace myolines
