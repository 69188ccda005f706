#pragma once

#include <myolines/scene/scene.h>

#include <memory>

namespace myolines
{
  /// Force [N] of an elastic tendon in one dimension against its elongation s [m].
  class TendonSpring
  {
  public:
    virtual ~TendonSpring() = default;

    virtual double force(double s) const  = 0; ///< [N]
    virtual double slope(double s) const  = 0; ///< [N/m]
    virtual double energy(double s) const = 0; ///< integral of the force from 0 [J]
  };

  /// k s, of both signs.
  std::unique_ptr<TendonSpring> make_linear_spring(double stiffness);

  /// F0 sT(1 + s/L) with the curve of tendon and aponeurosis (A.2.4): F0 sT(1) = 0.01 F0 at slack length L.
  std::unique_ptr<TendonSpring> make_tendinous_spring(double force, double slack_length);

  /// Declaration of the list `spring`, and its reading.
  scene::Schema                 tendon_spring_schema();
  std::unique_ptr<TendonSpring> read_tendon_spring(const scene::Node &node);
} // namespace myolines
