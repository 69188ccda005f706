// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    /// Springs that only push, per reference area: -k max(u.N, 0) N.
    class Buffer : public BoundaryCondition
    {
    public:
      Buffer(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , stiffness_(node.number("stiffness"))
      {
        facts_.part        = read_box(node);
        facts_.pushes      = true;
        facts_.supports    = true;
        facts_.says_spring = "leans against a buffer";
      }

      Vector3 force(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return -point.area * stiffness_ * depth(point, x) * point.normal;
      }

      ForceTangent tangent(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        ForceTangent k;
        if (depth(point, x) > 0)
          k.by_u = stiffness_ * point.area * outer_product(point.normal, point.normal);
        return k;
      }

      double energy(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return point.area / 2 * stiffness_ * depth(point, x) * depth(point, x);
      }

    private:
      static double depth(const FacePoint &point, const FaceMotion &x) { return std::max(x.u * point.normal, 0.); }

      const double stiffness_; ///< k [Pa/m]
    };
  } // namespace

  BoundaryEntry buffer_entry()
  {
    scene::Schema schema(
        "Springs between the face and a wall that it leans against, per reference area: the force is -k max(u.N, 0) N, N the "
        "outward normal at rest. They do not pull.");
    schema.number("stiffness", std::nullopt, "Pa/m", scene::Range::positive(), "k.");
    add_box(schema);
    return {"buffer", MuscleEnd::none, schema, {"stiffness=1e8"}, [](const scene::Node &node, const BoundaryReading &reading) {
              return std::make_shared<Buffer>(node, reading);
            }};
  }
} // namespace myolines
