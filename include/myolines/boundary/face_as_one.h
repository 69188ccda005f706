// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/boundary/boundary_entries.h>
#include <myolines/boundary/tendon_spring.h>

#include <memory>

namespace myolines
{
  /// A face that moves as one along a direction n: u.n = q at all its points, which move across n freely or not at all. A spring may act
  /// on it: it pulls as the even traction F(s - q) n / A, whose resultant is F n.
  class FaceAsOne : public BoundaryCondition
  {
  public:
    static void add(scene::Schema &schema); ///< direction, across

    std::vector<Tie>     ties(const NodeSpace &) const override;
    Vector3              force(double t, Side side, const FacePoint &point, const FaceMotion &x) const override;
    ForceTangent         tangent(double t, Side side, const FacePoint &point, const FaceMotion &x) const override;
    Vector3              force_of_step(double t, Side side, const FacePoint &point, const FaceStep &x) const override;
    ForceTangent         tangent_of_step(double t, Side side, const FacePoint &point, const FaceStep &x) const override;
    double               energy(double t, Side side, const FacePoint &point, const FaceMotion &x) const override;
    std::vector<Vector3> held_directions(const Vector3 &) const override;

  protected:
    /// @p spring: nullptr for none.
    FaceAsOne(const scene::Node &node, const BoundaryReading &reading, std::shared_ptr<const TendonSpring> spring);

    const Vector3 &direction() const { return direction_; }                  ///< n
    bool           has_spring() const { return spring_ != nullptr; }         ///< whether a spring acts on it
    double         spring_length() const { return spring_->slack_length(); } ///< of it [m]

  private:
    /// s: where the face would stand without a force of the spring [m].
    virtual double slack(double t, Side side) const = 0;

    TendonSpring::Secant secant(double t, Side side, const FaceStep &x) const;

    const Vector3                             direction_;
    const bool                                held_across_;
    const std::shared_ptr<const TendonSpring> spring_;
  };
} // namespace myolines
