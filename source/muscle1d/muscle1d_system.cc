// SPDX-License-Identifier: LGPL-2.1-or-later
#include "muscle1d_element.h"

#include <myolines/muscle1d/muscle_tendon_unit.h>
#include <myolines/system/band_linearisation.h>
#include <myolines/system/instants.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    unsigned int n_free_nodes(const Muscle1dParameters &p) { return p.n_elements * p.degree - (p.tendon ? 0 : 1); }

    bool is_continuum(const Muscle1dParameters &p) { return p.mass_of != MassOf::none && p.mass_of != MassOf::points; }

    double consistent_part(const MassOf mass_of) { return mass_of == MassOf::consistent ? 1 : mass_of == MassOf::blended ? 1. / 3 : 0; }

    unsigned int n_unknowns_of(const Muscle1dParameters &p) { return n_free_nodes(p) + (p.activation == nullptr ? p.n_elements : 0); }

    /// What the residual balances and what rounding leaves of it, over F_0 and squared, see Evaluation.
    struct SizeOfResidual
    {
      /// A @p part of an element; @p units: its stretch is known to so many units of rounding, as displacements of nodes differ by it.
      void add(const double part, const HillForce::Value &f, const double units)
      {
        const double change = std::numeric_limits<double>::epsilon() * units * (1 + std::abs(f.by_stretch)); // F_0 is a stiffness too
        forces += part * f.force * f.force;
        rounding += part * change * change;
      }
      double forces = 0, rounding = 0;
    };

    constexpr double front_rate = 8; ///< strain rates beyond it, over e_0, are those of fronts

    /// A geometric series whose last term is @p grading times the first, of mean 1.
    std::vector<double> graded_lengths(const unsigned int n, const double grading)
    {
      std::vector<double> lengths(n, 1.);
      for (unsigned int e = 1; e < n; ++e)
        lengths[e] = std::pow(grading, e / (n - 1.));
      const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.);
      for (double &length : lengths)
        length *= n / sum;
      return lengths;
    }
  } // namespace

  Muscle1dSystem::Muscle1dSystem(Muscle1dParameters parameters, WorkLedger &ledger)
    : parameters_(std::move(parameters))
    , ledger_(ledger)
    , element_(std::make_unique<Element>(parameters_.degree, parameters_.optimal_length / parameters_.n_elements,
                                         is_continuum(parameters_) ? parameters_.degree + 1 : parameters_.degree,
                                         is_continuum(parameters_) ? parameters_.mass / parameters_.optimal_length : 0,
                                         consistent_part(parameters_.mass_of)))
    , lengths_(graded_lengths(parameters_.n_elements, parameters_.grading))
    , point_mass_(parameters_.mass_of == MassOf::points ? parameters_.mass / n_free_nodes(parameters_) : 0)
    , layout_(dealii::complete_index_set(n_unknowns_of(parameters_)), MPI_COMM_SELF)
  {
    if (!parameters_.initial_displacement.empty() && parameters_.initial_displacement.size() != n_free_nodes(parameters_))
      throw std::logic_error("there must be one initial displacement for each free node");
    constraints_.close();
    layout_.update_ghost_values();
  }

  Muscle1dSystem::~Muscle1dSystem() = default;

  Capabilities Muscle1dSystem::capabilities() const
  {
    const bool   massless = parameters_.mass_of == MassOf::none;
    Capabilities capabilities;
    capabilities.inertia           = !massless;
    capabilities.symmetric_tangent = !solves_activation();
    if (massless)
      capabilities.orders = {1};
    else if (solves_activation())
      capabilities.orders = {1, 2};
    return capabilities;
  }

  unsigned int Muscle1dSystem::of_node(const unsigned int node) const
  {
    return solves_activation() ? node + (node - 1) / parameters_.degree : node - 1;
  }

  State Muscle1dSystem::initial_state(const double t0) const
  {
    State state{t0, layout_, layout_, layout_};
    for (unsigned int i = 0; i < parameters_.initial_displacement.size(); ++i)
      state.u.local_element(of_node(i + 1)) = parameters_.initial_displacement[i];
    if (parameters_.balanced_stretch)
      stretch_evenly(parameters_.balanced_stretch(t0) - parameters_.initial_stretch, state.u);
    if (solves_activation())
      for (unsigned int e = 0; e < parameters_.n_elements; ++e)
        state.u.local_element(of_activation(e)) =
            parameters_.optimal_length * parameters_.zajac.steady(parameters_.excitation->value(t0, Side::right));
    return state;
  }

  void Muscle1dSystem::stretch_evenly(const double strain, Vector &u) const
  {
    const std::vector<dealii::Point<1>> nodes = dealii::QGaussLobatto<1>(parameters_.degree + 1).get_points();
    double                              begin = 0;
    for (unsigned int e = 0; e < parameters_.n_elements; ++e)
      {
        const double length = lengths_[e] * parameters_.optimal_length / parameters_.n_elements;
        for (unsigned int i = 1; i <= parameters_.degree; ++i)
          if (const unsigned int node = e * parameters_.degree + i; is_free(node))
            u.local_element(of_node(node)) += strain * (begin + length * nodes[i](0));
        begin += length;
      }
  }

  double Muscle1dSystem::element_activation(const unsigned int element, const double t, const Vector &u) const
  {
    return solves_activation() ? u.local_element(of_activation(element)) / parameters_.optimal_length : parameters_.activation->value(t);
  }

  double Muscle1dSystem::reynolds_number() const
  {
    const Muscle1dParameters &p = parameters_;
    // Density and stress over a cross-section, which cancels.
    return musculoskeletal_reynolds_number(p.mass / p.optimal_length, p.optimal_length, p.force.maximum_strain_rate, p.maximum_force);
  }

  HillForce::Value Muscle1dSystem::element_force(const unsigned int element, const double stretch, const double rate,
                                                 const double activation) const
  {
    const Muscle1dParameters &p      = parameters_;
    HillForce::Value          f      = p.force(stretch, rate, activation);
    const double              e      = rate / p.force.maximum_strain_rate;
    const double              excess = std::abs(e) - front_rate;
    if (p.front_viscosity > 0 && excess > 0)
      {
        const double h      = lengths_[element] / (p.n_elements * p.degree);
        const double factor = p.front_viscosity * reynolds_number() * h * h;
        f.force += std::copysign(factor * excess * excess, e);
        f.by_rate += 2 * factor * excess / p.force.maximum_strain_rate;
      }
    return f;
  }

  void Muscle1dSystem::scatter(const Vector &x, std::vector<double> &nodes) const
  {
    nodes.assign(n_nodes(), 0.);
    const double *from = x.begin();
    for (unsigned int node = 1; node <= n_free_nodes(parameters_); ++node)
      {
        if (solves_activation() && (node - 1) % parameters_.degree == 0)
          ++from;
        nodes[node] = *from++;
      }
  }

  Evaluation Muscle1dSystem::residual(const Point &point, Vector &r) const
  {
    const WorkLedger::Timer timer(ledger_, "residual");
    ledger_.count("residual evaluations");
    const Muscle1dParameters &p       = parameters_;
    const auto                refused = [&](const std::string &reason) {
      r = std::numeric_limits<double>::quiet_NaN();
      return Evaluation{false, reason};
    };

    std::vector<double> u, v, a, force(n_nodes(), 0.);
    scatter(point.u, u);
    scatter(point.v, v);
    const double   given = solves_activation() ? 0 : p.activation->value(point.t, point.side);
    SizeOfResidual size;
    for (unsigned int e = 0, begin = 0; e < p.n_elements; ++e, begin += p.degree)
      {
        const double activation = solves_activation() ? element_activation(e, point.t, point.u) : given;
        const double node_step  = lengths_[e] * element_->h / p.degree;
        for (const Element::GaussPoint &q : element_->points)
          {
            const double stretch = p.initial_stretch + Element::sum(q, &u[begin]) / lengths_[e];
            if (!(stretch > 0) || !std::isfinite(stretch))
              return refused("the stretch of the muscle is not positive somewhere");
            const HillForce::Value f = element_force(e, stretch, Element::sum(q, &v[begin]) / lengths_[e], activation);
            for (unsigned int i = 0; i < element_->n; ++i)
              force[begin + i] += f.force * q.weight * q.slope[i];
            size.add(q.weight / element_->h, f, p.initial_stretch + std::abs(u[begin]) / node_step);
          }
      }
    for (double &f : force)
      f *= p.maximum_force;
    const double pull = p.tendon ? p.maximum_force * tendon(point.t, point.side, u.back()).value : 0;
    force.back() -= pull;
    add_inertia(point.a, a, force);
    for (unsigned int node = 1; node <= n_free_nodes(p); ++node)
      r.local_element(of_node(node)) = force[node];
    if (solves_activation())
      for (unsigned int e = 0; e < p.n_elements; ++e)
        {
          const double rate = point.v.local_element(of_activation(e)) / p.optimal_length;
          r.local_element(of_activation(e)) =
              p.maximum_force * p.zajac.time_constant *
              (rate - p.zajac.rate(p.excitation->value(point.t, point.side), element_activation(e, point.t, point.u)));
        }
    return {true, "", p.maximum_force * std::sqrt(size.forces) + pull, 0, p.maximum_force * std::sqrt(size.rounding)};
  }

  void Muscle1dSystem::add_inertia(const Vector &acceleration, std::vector<double> &a, std::vector<double> &force) const
  {
    if (parameters_.mass_of == MassOf::none)
      return;
    scatter(acceleration, a);
    if (parameters_.mass_of == MassOf::points)
      for (unsigned int node = 1; node < n_nodes(); ++node)
        force[node] += point_mass_ * a[node];
    else
      for (unsigned int begin = 0; begin + 1 < n_nodes(); begin += parameters_.degree)
        for (unsigned int i = 0; i < element_->n; ++i)
          for (unsigned int j = 0; j < element_->n; ++j)
            force[begin + i] += lengths_[begin / parameters_.degree] * element_->mass[i][j] * a[begin + j];
  }

  hill::Curve Muscle1dSystem::tendon(const double t, const Side side, const double end) const
  {
    const Tendon &tendon = *parameters_.tendon;
    return hill::tendon((tendon.unit_length->value(t, side) - parameters_.initial_stretch * parameters_.optimal_length - end) /
                        tendon.optimal_length);
  }

  std::unique_ptr<Linearisation> Muscle1dSystem::make_linearisation() const
  {
    std::vector<unsigned int> orders(layout_.size(), parameters_.mass_of == MassOf::none ? 1 : 2);
    if (solves_activation())
      for (unsigned int e = 0; e < parameters_.n_elements; ++e)
        orders[of_activation(e)] = 1;
    return std::make_unique<StoredBands>(orders, parameters_.degree + (solves_activation() ? 1 : 0), std::vector<unsigned int>{}, ledger_);
  }

  void Muscle1dSystem::linearise(const Point &point, Linearisation &linearisation) const
  {
    const WorkLedger::Timer timer(ledger_, "linearisation");
    ledger_.count("linearisations");
    const Muscle1dParameters &p     = parameters_;
    auto                     &bands = dynamic_cast<StoredBands &>(linearisation);
    bands.begin();
    const double        given = solves_activation() ? 0 : p.activation->value(point.t, point.side);
    std::vector<double> u, v;
    scatter(point.u, u);
    scatter(point.v, v);
    for (unsigned int e = 0; e < p.n_elements; ++e)
      {
        const double       activation = solves_activation() ? element_activation(e, point.t, point.u) : given;
        const unsigned int own = of_activation(e), begin = e * p.degree;
        for (const Element::GaussPoint &q : element_->points)
          {
            const HillForce::Value f    = element_force(e, p.initial_stretch + Element::sum(q, &u[begin]) / lengths_[e],
                                                        Element::sum(q, &v[begin]) / lengths_[e], activation);
            const double           unit = p.maximum_force * q.weight, per_length = unit / lengths_[e];
            for (unsigned int i = 0; i < element_->n; ++i)
              {
                if (!is_free(begin + i))
                  continue;
                const unsigned int row = of_node(begin + i);
                for (unsigned int j = 0; j < element_->n; ++j)
                  if (is_free(begin + j))
                    {
                      const unsigned int column = of_node(begin + j);
                      bands.stiffness(row, column) += per_length * f.by_stretch * q.slope[i] * q.slope[j];
                      bands.damping(row, column) += per_length * f.by_rate * q.slope[i] * q.slope[j];
                    }
                if (solves_activation())
                  bands.stiffness(row, own) += unit * f.by_activation * q.slope[i] / p.optimal_length;
              }
          }
        if (solves_activation())
          {
            bands.stiffness(own, own) = p.maximum_force * p.zajac.decay(p.excitation->value(point.t, point.side)) / p.optimal_length;
            bands.damping(own, own)   = p.maximum_force * p.zajac.time_constant / p.optimal_length;
          }
      }
    if (!bands.has_mass())
      add_mass(bands);
    if (p.tendon)
      {
        const unsigned int end = of_node(n_nodes() - 1);
        bands.stiffness(end, end) += p.maximum_force / p.tendon->optimal_length * tendon(point.t, point.side, u.back()).slope;
      }
  }

  void Muscle1dSystem::add_mass(StoredBands &bands) const
  {
    if (point_mass_ > 0)
      for (unsigned int node = 1; node < n_nodes(); ++node)
        if (is_free(node))
          bands.mass(of_node(node), of_node(node)) = point_mass_;
    if (!element_->mass.empty())
      for (unsigned int begin = 0; begin + 1 < n_nodes(); begin += parameters_.degree)
        for (unsigned int i = 0; i < element_->n; ++i)
          for (unsigned int j = 0; j < element_->n; ++j)
            if (is_free(begin + i) && is_free(begin + j))
              bands.mass(of_node(begin + i), of_node(begin + j)) += lengths_[begin / parameters_.degree] * element_->mass[i][j];
  }

  std::vector<double> Muscle1dSystem::events(const double t0, const double t1) const
  {
    std::vector<double> kinks;
    const auto          add = [&](const Drive *drive) {
      if (drive != nullptr)
        for (const double t : drive->kinks(t0, t1))
          kinks.push_back(t);
    };
    add(solves_activation() ? parameters_.excitation.get() : parameters_.activation.get());
    add(parameters_.tendon ? parameters_.tendon->unit_length.get() : nullptr);
    return one_list(std::move(kinks));
  }
} // namespace myolines
