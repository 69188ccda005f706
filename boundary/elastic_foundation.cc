// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    using scene::Range;

    /// Springs per reference area: -k u - k_n (u.N) N.
    class ElasticFoundation : public BoundaryCondition
    {
    public:
      ElasticFoundation(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , stiffness_(node.number("stiffness"))
        , normal_stiffness_(node.number("normal stiffness"))
      {
        if (stiffness_ == 0 && normal_stiffness_ == 0)
          node.refuse("stiffness", "the springs have no stiffness", "a \"stiffness\" or a \"normal stiffness\" above zero");
        facts_.part        = read_box(node);
        facts_.pushes      = true;
        facts_.supports    = true;
        facts_.says_spring = "stands on an elastic foundation";
      }

      Vector3 force(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return -point.area * (stiffness_ * x.u + normal_stiffness_ * (x.u * point.normal) * point.normal);
      }

      ForceTangent tangent(double, Side, const FacePoint &point, const FaceMotion &) const override
      {
        ForceTangent k;
        k.by_u = normal_stiffness_ * point.area * outer_product(point.normal, point.normal);
        for (unsigned int c = 0; c < 3; ++c)
          k.by_u[c][c] += stiffness_ * point.area;
        return k;
      }

      double energy(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return point.area / 2 * (stiffness_ * x.u.norm_square() + normal_stiffness_ * std::pow(x.u * point.normal, 2));
      }

      std::vector<Vector3> held_directions(const Vector3 &normal) const override
      {
        std::vector<Vector3> held;
        if (normal_stiffness_ > 0)
          held.push_back(normal);
        if (stiffness_ > 0)
          held.insert(held.end(), {Vector3({1, 0, 0}), Vector3({0, 1, 0}), Vector3({0, 0, 1})});
        return held;
      }

    private:
      const double stiffness_, normal_stiffness_; ///< k, k_n [Pa/m]
    };
  } // namespace

  BoundaryEntry elastic_foundation_condition()
  {
    scene::Schema schema(
        "Springs between the face and the ground, per reference area: the force is -k u - k_n (u.N) N, N the normal at rest.");
    schema.number("stiffness", 0, "Pa/m", Range::not_negative(), "k, in all directions.")
        .number("normal stiffness", 0, "Pa/m", Range::not_negative(), "k_n, along the normal, added to the other.");
    add_box(schema);
    return {"elastic foundation",
            MuscleEnd::none,
            schema,
            {"stiffness=3e7", "normal stiffness=1e8"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<ElasticFoundation>(node, reading); }};
  }
} // namespace myolines
