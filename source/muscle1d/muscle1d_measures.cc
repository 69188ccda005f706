// SPDX-License-Identifier: LGPL-2.1-or-later
#include "muscle1d_element.h"

#include <sstream>

namespace myolines
{
  std::vector<std::string> Muscle1dSystem::plan() const
  {
    const Muscle1dParameters &p = parameters_;
    std::vector<std::string>  lines;
    const auto                add = [&](const std::string &what, const double value, const std::string &unit) {
      std::ostringstream line;
      line.precision(13);
      line << what << ": " << value << (unit.empty() ? "" : " ") << unit;
      lines.push_back(line.str());
    };
    add("optimal length of the muscle", p.optimal_length, "m");
    if (p.tendon)
      add("optimal length of the tendon", p.tendon->optimal_length, "m");
    add("length of the muscle at the start", p.initial_stretch * p.optimal_length, "m");
    add("maximum isometric force F_0", p.maximum_force, "N");
    add("mass of the muscle", p.mass, "kg");
    if (p.grading != 1)
      {
        add("length of the first element", lengths_.front() * element_->h, "m");
        add("length of the last element", lengths_.back() * element_->h, "m");
      }
    add("musculoskeletal Reynolds number", reynolds_number(), "");
    return lines;
  }

  double Muscle1dSystem::activation(const double t, const Vector &u) const { return element_activation(0, t, u); }

  double Muscle1dSystem::muscle_stretch(const Vector &u) const
  {
    return parameters_.initial_stretch + end_displacement(u) / parameters_.optimal_length;
  }

  double Muscle1dSystem::muscle_strain_rate(const Vector &v) const
  {
    return end_displacement(v) / (parameters_.optimal_length * parameters_.force.maximum_strain_rate);
  }

  std::vector<double> Muscle1dSystem::element_stretches(const Vector &u) const
  {
    std::vector<double> stretches, nodes;
    scatter(u, nodes);
    for (unsigned int e = 0, begin = 0; e < parameters_.n_elements; ++e, begin += parameters_.degree)
      stretches.push_back(parameters_.initial_stretch + (nodes[begin + parameters_.degree] - nodes[begin]) / (lengths_[e] * element_->h));
    return stretches;
  }

  double Muscle1dSystem::tendon_stretch(const double t, const Vector &u) const
  {
    const double muscle = parameters_.initial_stretch * parameters_.optimal_length + end_displacement(u);
    return (parameters_.tendon->unit_length->value(t) - muscle) / parameters_.tendon->optimal_length;
  }

  std::vector<double> Muscle1dSystem::element_forces(const double t, const Vector &u, const Vector &v) const
  {
    std::vector<double> forces, displacements, velocities;
    scatter(u, displacements);
    scatter(v, velocities);
    const Element::GaussPoint &q = element_->points.front();
    for (unsigned int e = 0, begin = 0; e < parameters_.n_elements; ++e, begin += parameters_.degree)
      forces.push_back(element_force(e, parameters_.initial_stretch + Element::sum(q, &displacements[begin]) / lengths_[e],
                                     Element::sum(q, &velocities[begin]) / lengths_[e], element_activation(e, t, u))
                           .force);
    return forces;
  }
} // namespace myolines
