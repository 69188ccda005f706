// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/face_as_one.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    /// Two unit vectors across n and each other, along the axes where n is.
    std::array<Vector3, 2> across_of(const Vector3 &n)
    {
      unsigned int largest = 0;
      for (unsigned int c = 1; c < 3; ++c)
        if (std::abs(n[c]) > std::abs(n[largest]))
          largest = c;
      Vector3 first;
      first[(largest + 1) % 3] = 1;
      first -= (first * n) * n;
      first /= first.norm();
      return {{first, cross_product_3d(n, first)}};
    }
  } // namespace

  void FaceAsOne::add(scene::Schema &schema)
  {
    add_direction(schema, "Direction n along which the face moves as one");
    schema.choice("across", "free", {"free", "held"}, "Whether points of the face may move across n.");
  }

  FaceAsOne::FaceAsOne(const scene::Node &node, const BoundaryReading &reading, std::shared_ptr<const TendonSpring> spring)
    : BoundaryCondition(reading.facts)
    , direction_(read_direction_of(node, reading))
    , held_across_(node.text("across") == "held")
    , spring_(std::move(spring))
  {
    facts_.ties         = true;
    facts_.moves_as_one = true;
    facts_.pushes       = has_spring();
    facts_.supports     = has_spring();
    facts_.says_tie     = std::string("moves as one") + (held_across_ ? ", held across" : "");
  }

  std::vector<Tie> FaceAsOne::ties(const NodeSpace &) const
  {
    std::vector<Tie> all{{direction_, true}};
    if (held_across_)
      for (const Vector3 &across : across_of(direction_))
        all.push_back({across});
    return all;
  }

  Vector3 FaceAsOne::force(const double t, const Side side, const FacePoint &point, const FaceMotion &x) const
  {
    return spring_->force(slack(t, side) - direction_ * x.u) / point.face_area * point.area * direction_;
  }

  ForceTangent FaceAsOne::tangent(const double t, const Side side, const FacePoint &point, const FaceMotion &x) const
  {
    ForceTangent k;
    k.by_u = spring_->slope(slack(t, side) - direction_ * x.u) / point.face_area * point.area * outer_product(direction_, direction_);
    return k;
  }

  TendonSpring::Secant FaceAsOne::secant(const double t, const Side side, const FaceStep &x) const
  {
    const double at = slack(t, side);
    return spring_->secant(at - direction_ * x.begin.u, at - direction_ * x.end.u);
  }

  Vector3 FaceAsOne::force_of_step(const double t, const Side side, const FacePoint &point, const FaceStep &x) const
  {
    return secant(t, side, x).force / point.face_area * point.area * direction_;
  }

  ForceTangent FaceAsOne::tangent_of_step(const double t, const Side side, const FacePoint &point, const FaceStep &x) const
  {
    ForceTangent k;
    k.by_u = secant(t, side, x).slope / point.face_area * point.area * outer_product(direction_, direction_);
    return k;
  }

  double FaceAsOne::energy(const double t, const Side side, const FacePoint &point, const FaceMotion &x) const
  {
    return point.area / point.face_area * spring_->energy(slack(t, side) - direction_ * x.u);
  }

  std::vector<Vector3> FaceAsOne::held_directions(const Vector3 &) const
  {
    return has_spring() ? std::vector<Vector3>{direction_} : std::vector<Vector3>{};
  }
} // namespace myolines
