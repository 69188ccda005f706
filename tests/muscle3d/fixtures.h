// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/conditions.h"

#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/muscle3d_system.h>

#include <deal.II/grid/grid_tools.h>

#include <random>

namespace myolines::test
{
  /// A drive that does not change.
  class ConstantDrive : public Drive
  {
  public:
    explicit ConstantDrive(const double value)
      : value_(value)
    {}
    double              value(double, Side) const override { return value_; }
    double              first_derivative(double, Side) const override { return 0; }
    double              second_derivative(double, Side) const override { return 0; }
    std::vector<double> kinks(double, double) const override { return {}; }

  private:
    double value_;
  };

  /// The ends of a block along x, both held.
  inline BoundaryConditions held_ends() { return {held(1, "x y z", "moving end"), held(0, "x y z", "fixed end")}; }

  /// The same of the block @p p, the right end moved along x by the strain offset + amplitude sin(2 pi frequency t + phase).
  inline BoundaryConditions pulled_ends(const Muscle3dParameters &p, const double amplitude, const double frequency, const double phase = 0,
                                        const double offset = 0)
  {
    const Condition pulled =
        condition("strain", 1,
                  {"strain/type=sine", set("strain/amplitude", amplitude), set("strain/frequency", frequency), set("strain/phase", phase),
                   set("strain/offset", offset), set("reference length", p.geometry.size[0])},
                  "moving end");
    return {pulled, held(0, "x y z", "fixed end")};
  }

  /// The strain height/2 (1 - cos(10 pi t)).
  inline BoundaryConditions slowly_pulled_ends(const Muscle3dParameters &p, const double height)
  {
    return pulled_ends(p, height / 2, 5, -90, height / 2);
  }

  /// A small pennate block, fully active, no boundary conditions.
  inline Muscle3dParameters small_block(const unsigned int degree = 2, const unsigned int n_points = 3, const unsigned int refinement = 1)
  {
    Muscle3dParameters p;
    p.degree                   = degree;
    p.n_points                 = n_points;
    p.geometry.refinement      = refinement;
    p.muscle().fibre.direction = {{std::cos(0.5), 0.1, std::sin(0.5)}};
    double length              = 0;
    for (const double d : p.muscle().fibre.direction)
      length += d * d;
    for (double &d : p.muscle().fibre.direction)
      d /= std::sqrt(length);
    p.activation = std::make_shared<ConstantDrive>(0.7);
    return p;
  }

  /// Shears and bends the mesh so that no cell is a parallelepiped.
  inline dealii::Point<3> distort(const dealii::Point<3> &x)
  {
    return {x[0] + 0.1 * x[1] + 8 * x[1] * x[2], x[1] + 6 * x[0] * x[2], x[2] + 0.05 * x[0] + 5 * x[0] * x[1]};
  }

  /// Fills owned entries with uniform random numbers in [-amplitude, amplitude].
  inline void randomise(Vector &x, const double amplitude, const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
    for (const auto i : x.locally_owned_elements())
      x(i) = uniform(generator);
  }
} // namespace myolines::test
