// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <memory>

namespace myolines
{
  /// Force [N] of an elastic tendon, or of a stop, in one dimension against its elongation s [m].
  class TendonSpring
  {
  public:
    virtual ~TendonSpring() = default;

    virtual double force(double s) const  = 0;        ///< [N]
    virtual double slope(double s) const  = 0;        ///< [N/m]
    virtual double energy(double s) const = 0;        ///< integral of the force from 0 [J]
    virtual double slack_length() const { return 0; } ///< [m], 0: the law knows none

    /// The force of a step from s0 to s1, whose work is the change of energy.
    struct Secant
    {
      double force; ///< (energy(s1) - energy(s0))/(s1 - s0) [N]
      double slope; ///< its derivative by s1 [N/m]
    };
    virtual Secant secant(double s0, double s1) const = 0; ///< Between two elongations [m], also equal ones.
  };

  /// k s, of both signs.
  std::unique_ptr<TendonSpring> make_linear_spring(double stiffness);

  /// F0 sT(1 + s/L) with the curve of tendon and aponeurosis (A.2.4): F0 sT(1) = 0.01 F0 at slack length L.
  std::unique_ptr<TendonSpring> make_tendinous_spring(double force, double slack_length);

  /// F0 F_T(1 + s/L) with the curve of table A.4, that of the one-dimensional muscle-tendon unit: 0.0097 F0 at slack length L.
  std::unique_ptr<TendonSpring> make_hill_spring(double force, double slack_length);

  /// A stop: k s where s < 0, and no force elsewhere. The slope at s = 0 is that of the stop.
  std::unique_ptr<TendonSpring> make_stop_spring(double stiffness);

  /// Declaration of the list `spring`, and its reading.
  scene::Schema                 tendon_spring_schema();
  std::unique_ptr<TendonSpring> read_tendon_spring(const scene::Node &node); ///< Reads that list.
} // namespace myolines
