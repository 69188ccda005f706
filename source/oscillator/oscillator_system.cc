// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/oscillator/oscillator_system.h>
#include <myolines/system/band_linearisation.h>
#include <myolines/system/file_drive.h>
#include <myolines/system/instants.h>

#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    std::shared_ptr<const Drive> read_drive(const scene::Node &system, const std::string &name, const std::string &unit)
    {
      return system.has(name) ? std::shared_ptr<const Drive>(make_drive(system.section(name), Driven{name, unit})) : nullptr;
    }
  } // namespace

  scene::Schema oscillator_schema()
  {
    using scene::Range;
    scene::Schema schema("One mass on a spring, m u'' + c (u' - s') + k (u - s) + k3 (u - s)^3 = f(t).");
    schema.number("mass", 1, "kg", Range::positive(), "Mass m.")
        .number("damping", 0, "N s/m", Range::not_negative(), "Damping c.")
        .number("stiffness", 1, "N/m", Range::any(), "Stiffness k.")
        .number("cubic stiffness", 0, "N/m^3", Range::any(), "Cubic stiffness k3.")
        .number("displacement", 1, "m", Range::any(), "Displacement at the start.")
        .number("velocity", 0, "m/s", Range::any(), "Velocity at the start.")
        .optional_section("force", drive_schema("force on the mass", "N"))
        .optional_section("support", drive_schema("displacement of the support", "m"));
    return schema;
  }

  OscillatorParameters read_oscillator(const scene::Node &system)
  {
    OscillatorParameters parameters;
    parameters.mass            = system.number("mass");
    parameters.damping         = system.number("damping");
    parameters.stiffness       = system.number("stiffness");
    parameters.cubic_stiffness = system.number("cubic stiffness");
    parameters.displacement    = system.number("displacement");
    parameters.velocity        = system.number("velocity");
    parameters.force           = read_drive(system, "force", "N");
    parameters.support         = read_drive(system, "support", "m");
    return parameters;
  }

  OscillatorSystem::OscillatorSystem(OscillatorParameters parameters, WorkLedger &ledger)
    : parameters_(std::move(parameters))
    , ledger_(ledger)
    , layout_(dealii::complete_index_set(parameters_.support ? 2 : 1), MPI_COMM_SELF)
  {
    if (parameters_.support)
      constraints_.add_line(1);
    constraints_.close();
    layout_.update_ghost_values();
  }

  Capabilities OscillatorSystem::capabilities() const
  {
    Capabilities capabilities;
    capabilities.rates             = parameters_.damping != 0;
    capabilities.linear            = parameters_.cubic_stiffness == 0;
    capabilities.symmetric_tangent = true;
    capabilities.energy            = true;
    capabilities.two_states        = true;
    capabilities.splits            = {{"linear", capabilities.linear ? "everything" : "everything but the cubic spring", ""}};
    return capabilities;
  }

  std::unique_ptr<SemiDiscreteSystem> OscillatorSystem::implicit_part(const std::string &split) const
  {
    if (split != "linear")
      return nullptr;
    OscillatorParameters part = parameters_;
    part.cubic_stiffness      = 0;
    return std::make_unique<OscillatorSystem>(part, ledger_);
  }

  std::size_t OscillatorSystem::n_unknowns() const { return layout_.size(); }

  State OscillatorSystem::initial_state(const double t0) const
  {
    State state{t0, layout_, layout_, layout_};
    state.u.local_element(0) = parameters_.displacement;
    state.v.local_element(0) = parameters_.velocity;
    prescribed(t0, Side::right, state);
    return state;
  }

  const Constraints &OscillatorSystem::constraints() const { return constraints_; }

  void OscillatorSystem::prescribed(const double t, const Side side, State &state) const
  {
    if (!parameters_.support)
      return;
    state.u.local_element(1) = parameters_.support->value(t, side);
    state.v.local_element(1) = parameters_.support->first_derivative(t, side);
    state.a.local_element(1) = parameters_.support->second_derivative(t, side);
  }

  namespace
  {
    /// Of the mass to the support.
    double difference(const Vector &x) { return x.size() == 2 ? x.local_element(0) - x.local_element(1) : x.local_element(0); }

    /// Of the spring.
    double force_of(const OscillatorParameters &p, const double stretch)
    {
      return stretch * (p.stiffness + p.cubic_stiffness * stretch * stretch);
    }
  } // namespace

  Evaluation OscillatorSystem::residual(const Point &point, Vector &r) const
  {
    ledger_.count("residual evaluations");
    const double stretch = difference(point.u), before = point.before != nullptr ? difference(*point.before) : stretch;
    const double middle = (before + stretch) / 2,
                 square = (before * before + stretch * stretch) / 2; // of s^4/4 the secant is square middle
    const double lost   = point.dissipation / 2 * (force_of(parameters_, stretch) - force_of(parameters_, before));
    const double spring =
        parameters_.damping * difference(point.v) + (parameters_.stiffness + parameters_.cubic_stiffness * square) * middle + lost;
    const double load = parameters_.force ? parameters_.force->value(point.t, point.side) : 0;

    r.local_element(0) = parameters_.mass * point.a.local_element(0) + spring - load;
    if (parameters_.support)
      r.local_element(1) = -spring;
    if (std::isfinite(r.local_element(0)))
      return {};
    r = std::numeric_limits<double>::quiet_NaN();
    return {false, "the force on the mass is not a finite number"};
  }

  std::unique_ptr<Linearisation> OscillatorSystem::make_linearisation() const
  {
    const unsigned int        n = layout_.size();
    std::vector<unsigned int> support;
    if (parameters_.support)
      support.push_back(1);
    return std::make_unique<StoredBands>(std::vector<unsigned int>(n, 2), n - 1, support, ledger_);
  }

  void OscillatorSystem::linearise(const Point &point, Linearisation &linearisation) const
  {
    ledger_.count("linearisations");
    const double stretch   = difference(point.u);
    const double at_end    = parameters_.stiffness + 3 * parameters_.cubic_stiffness * stretch * stretch;
    double       stiffness = at_end;
    if (point.before != nullptr)
      {
        const double before = difference(*point.before), middle = (before + stretch) / 2;
        const double square = (before * before + stretch * stretch) / 2;
        stiffness = (parameters_.stiffness + parameters_.cubic_stiffness * square) / 2 + parameters_.cubic_stiffness * stretch * middle +
                    point.dissipation / 2 * at_end;
      }
    auto &bands = dynamic_cast<StoredBands &>(linearisation);
    bands.begin();
    bands.mass(0, 0)     = parameters_.mass;
    const unsigned int n = layout_.size();
    for (unsigned int i = 0; i < n; ++i) // spring and damper between mass and support
      for (unsigned int j = 0; j < n; ++j)
        {
          bands.stiffness(i, j) = i == j ? stiffness : -stiffness;
          bands.damping(i, j)   = i == j ? parameters_.damping : -parameters_.damping;
        }
  }

  Energetics OscillatorSystem::energetics(const State &state, const Side side) const
  {
    const OscillatorParameters &p       = parameters_;
    const double                stretch = difference(state.u), rate = difference(state.v), velocity = state.v.local_element(0);
    Energetics                  now;
    now.energy = p.mass / 2 * velocity * velocity + stretch * stretch * (p.stiffness / 2 + p.cubic_stiffness / 4 * stretch * stretch);
    now.rates.dissipation = p.damping * rate * rate;
    if (p.force)
      now.rates.external += p.force->value(state.t, side) * velocity;
    if (p.support)
      now.rates.external -=
          (p.damping * rate + p.stiffness * stretch + p.cubic_stiffness * stretch * stretch * stretch) * state.v.local_element(1);
    return now;
  }

  std::vector<double> OscillatorSystem::events(const double t0, const double t1) const
  {
    std::vector<double> times;
    for (const auto &drive : {parameters_.force, parameters_.support})
      if (drive)
        for (const double t : drive->kinks(t0, t1))
          times.push_back(t);
    return one_list(std::move(times));
  }
} // namespace myolines
