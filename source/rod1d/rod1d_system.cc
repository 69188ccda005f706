// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rod1d_element.h"

#include <myolines/system/band_linearisation.h>

#include <limits>
#include <numeric>

namespace myolines
{
  scene::Schema rod1d_schema()
  {
    using scene::Range;
    scene::Schema schema("Rod, rho u_tt = P(1 + u_x)_x, fixed at x = 0 and moved at x = L: u(L, t) = L strain(t).");
    schema.number("length", 0.1, "m", Range::positive(), "Length L.")
        .number("cross section", 1e-4, "m^2", Range::positive(), "Area; multiplies forces, not motions.")
        .number("density", 1060, "kg/m^3", Range::positive(), "Density rho.")
        .integer("elements", 8, Range::closed(1, 10000000), "Number of elements of equal length.")
        .integer("degree", 2, Range::closed(1, 3), "Polynomial degree of the elements.")
        .number("stiffness factor", 1, "-", Range::positive(),
                "Multiplies the stress; 2 makes what the thesis calls method of lines (errata 17, 18).")
        .section("material", rod_material_schema())
        .section("profile", drive_schema("strain of the rod", "-"));
    return schema;
  }

  Rod1dParameters read_rod1d(const scene::Node &system)
  {
    Rod1dParameters parameters;
    parameters.length           = system.number("length");
    parameters.area             = system.number("cross section");
    parameters.density          = system.number("density");
    parameters.n_elements       = system.integer("elements");
    parameters.degree           = system.integer("degree");
    parameters.stiffness_factor = system.number("stiffness factor");
    parameters.material         = read_rod_material(system.section("material"));
    parameters.strain           = make_drive(system.section("profile"));
    return parameters;
  }

  Rod1dSystem::Rod1dSystem(Rod1dParameters parameters, WorkLedger &ledger)
    : parameters_(std::move(parameters))
    , ledger_(ledger)
    , element_(std::make_unique<Element>(parameters_.degree, parameters_.length / parameters_.n_elements,
                                         parameters_.density * parameters_.area))
    , layout_(dealii::complete_index_set(parameters_.n_elements * parameters_.degree + 1), MPI_COMM_SELF)
  {
    constraints_.add_line(0);
    constraints_.add_line(layout_.size() - 1);
    constraints_.close();
    layout_.update_ghost_values();
  }

  Rod1dSystem::~Rod1dSystem() = default;

  Capabilities Rod1dSystem::capabilities() const
  {
    Capabilities capabilities;
    capabilities.rates             = false;
    capabilities.linear            = parameters_.material.linear;
    capabilities.symmetric_tangent = true;
    capabilities.energy            = true;
    capabilities.splits            = {
                   {"linear", parameters_.material.linear ? "everything" : "the inertia and the part mu (l - 1) of the stress, thesis (4.7.7)", ""}};
    return capabilities;
  }

  std::unique_ptr<SemiDiscreteSystem> Rod1dSystem::implicit_part(const std::string &split) const
  {
    if (split != "linear")
      return nullptr;
    Rod1dParameters part = parameters_;
    if (!part.material.linear)
      {
        part.material       = {};
        part.material.young = parameters_.material.mu;
      }
    return std::make_unique<Rod1dSystem>(part, ledger_);
  }

  State Rod1dSystem::initial_state(const double t0) const
  {
    State state{t0, layout_, layout_, layout_};
    prescribed(t0, Side::right, state);
    return state;
  }

  void Rod1dSystem::prescribed(const double t, const Side side, State &state) const
  {
    const unsigned int last = layout_.size() - 1;
    const double       L    = parameters_.length;
    for (Vector *x : {&state.u, &state.v, &state.a})
      x->local_element(0) = 0;
    state.u.local_element(last) = L * parameters_.strain->value(t, side);
    state.v.local_element(last) = L * parameters_.strain->first_derivative(t, side);
    state.a.local_element(last) = L * parameters_.strain->second_derivative(t, side);
  }

  Evaluation Rod1dSystem::residual(const Point &point, Vector &r) const
  {
    const WorkLedger::Timer timer(ledger_, "residual");
    ledger_.count("residual evaluations");
    const Element     &e        = *element_;
    const RodMaterial &material = parameters_.material;
    const double      *u = point.u.begin(), *a = point.a.begin();
    double            *force = r.begin(); // elements share their end nodes: the next one begins n - 1 entries on
    std::fill_n(force, r.size(), 0.);
    for (unsigned int k = 0; k < parameters_.n_elements; ++k, u += e.n - 1, a += e.n - 1, force += e.n - 1)
      {
        for (const Element::GaussPoint &q : e.points)
          {
            double strain = 0;
            for (unsigned int i = 0; i < e.n; ++i)
              strain += q.slope[i] * u[i];
            if (!material.admissible(strain))
              {
                r = std::numeric_limits<double>::quiet_NaN();
                return {false, "the stretch of the rod is not positive somewhere"};
              }
            const double stress = parameters_.stiffness_factor * parameters_.area * e.h * q.weight * material.stress(strain);
            for (unsigned int i = 0; i < e.n; ++i)
              force[i] += stress * q.slope[i];
          }
        for (unsigned int i = 0; i < e.n; ++i)
          for (unsigned int j = 0; j < e.n; ++j)
            force[i] += e.mass[i][j] * a[j];
      }
    return {};
  }

  std::unique_ptr<Linearisation> Rod1dSystem::make_linearisation() const
  {
    return std::make_unique<StoredBands>(std::vector<unsigned int>(layout_.size(), 2), parameters_.degree,
                                         std::vector<unsigned int>{0, static_cast<unsigned int>(layout_.size()) - 1}, ledger_);
  }

  void Rod1dSystem::linearise(const Point &point, Linearisation &linearisation) const
  {
    const WorkLedger::Timer timer(ledger_, "linearisation");
    ledger_.count("linearisations");
    auto          &bands = dynamic_cast<StoredBands &>(linearisation);
    const Element &e     = *element_;
    const double  *u     = point.u.begin();
    bands.begin();
    for (unsigned int k = 0, row = 0; k < parameters_.n_elements; ++k, u += e.n - 1, row += e.n - 1)
      {
        for (const Element::GaussPoint &q : e.points)
          {
            double strain = 0;
            for (unsigned int i = 0; i < e.n; ++i)
              strain += q.slope[i] * u[i];
            const double tangent = parameters_.stiffness_factor * parameters_.area * e.h * q.weight * parameters_.material.tangent(strain);
            for (unsigned int i = 0; i < e.n; ++i)
              for (unsigned int j = 0; j < e.n; ++j)
                bands.stiffness(row + i, row + j) += tangent * q.slope[i] * q.slope[j];
          }
        if (!bands.has_mass())
          for (unsigned int i = 0; i < e.n; ++i)
            for (unsigned int j = 0; j < e.n; ++j)
              bands.mass(row + i, row + j) += e.mass[i][j];
      }
  }

  std::vector<double> Rod1dSystem::events(const double t0, const double t1) const { return parameters_.strain->kinks(t0, t1); }

  Rod1dSystem::Energy Rod1dSystem::energy(const State &state) const
  {
    const Element &e = *element_;
    const double  *u = state.u.begin(), *v = state.v.begin();
    Energy         energy;
    for (unsigned int k = 0; k < parameters_.n_elements; ++k, u += e.n - 1, v += e.n - 1)
      {
        for (const Element::GaussPoint &q : e.points)
          {
            const double strain = std::inner_product(u, u + e.n, q.slope.begin(), 0.);
            energy.stored += parameters_.stiffness_factor * parameters_.area * e.h * q.weight * parameters_.material.energy(strain);
          }
        for (unsigned int i = 0; i < e.n; ++i)
          for (unsigned int j = 0; j < e.n; ++j)
            energy.kinetic += e.mass[i][j] * v[i] * v[j] / 2;
      }
    return energy;
  }

  /// The force of the end is its row of the residual.
  EnergyRates Rod1dSystem::energy_rates(const State &state) const
  {
    const Element    &e    = *element_;
    const std::size_t from = layout_.size() - e.n;
    const double     *u = state.u.begin() + from, *a = state.a.begin() + from;
    double            force = 0;
    for (const Element::GaussPoint &q : e.points)
      {
        const double strain = std::inner_product(u, u + e.n, q.slope.begin(), 0.);
        force += parameters_.stiffness_factor * parameters_.area * e.h * q.weight * parameters_.material.stress(strain) * q.slope[e.n - 1];
      }
    force += std::inner_product(a, a + e.n, e.mass[e.n - 1].begin(), 0.);
    return {0, 0, force * state.v.local_element(layout_.size() - 1)};
  }

  Energetics Rod1dSystem::energetics(const State &state, Side) const
  {
    const Energy now = energy(state);
    return {now.kinetic + now.stored, energy_rates(state)};
  }

  double Rod1dSystem::position(const unsigned int i) const { return parameters_.length * i / (layout_.size() - 1); }

  double Rod1dSystem::value(const Vector &u, const double x) const
  {
    const unsigned int k   = std::min(static_cast<unsigned int>(x / element_->h), parameters_.n_elements - 1);
    double             sum = 0;
    for (unsigned int a = 0; a < element_->n; ++a)
      sum += element_->shape(a, x / element_->h - k) * u.local_element(k * parameters_.degree + a);
    return sum;
  }
} // namespace myolines
