// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

namespace myolines
{
  namespace
  {
    /// Pressure p(t) on the deformed face: -p J F^(-T) N per reference area.
    class FollowerPressure : public BoundaryCondition
    {
    public:
      FollowerPressure(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , pressure_(node, "pressure")
      {
        facts_.part    = read_box(node);
        facts_.pushes  = true;
        facts_.follows = true;
      }

      std::vector<const Drive *> drives() const override { return pressure_.drives(); }

      Vector3 force(const double t, const Side side, const FacePoint &, const FaceMotion &x) const override
      {
        return -pressure_.at(t, side) * x.area;
      }

      ForceTangent tangent(const double t, const Side side, const FacePoint &, const FaceMotion &) const override
      {
        ForceTangent k;
        for (unsigned int c = 0; c < 3; ++c)
          k.by_area[c][c] = pressure_.at(t, side);
        return k;
      }

      double power(const double t, const Side side, const FacePoint &point, const FaceMotion &x) const override
      {
        return force(t, side, point, x) * x.v;
      }

      std::optional<double> constant_pressure() const override
      {
        return pressure_.drives().empty() ? std::optional<double>(pressure_.at(0, Side::right)) : std::nullopt;
      }

    private:
      const ProfiledLoad pressure_; ///< [Pa]
    };
  } // namespace

  BoundaryEntry follower_pressure_condition()
  {
    scene::Schema schema("A pressure on the face as it moves: the force -p n per current area turns and grows with it.");
    ProfiledLoad::add(schema, "pressure", "Pa", "Force per current area, inwards where positive.");
    add_box(schema);
    return {"follower pressure",
            MuscleEnd::none,
            schema,
            {"pressure=2e5", "profile/type=sine", "profile/frequency=3", "profile/amplitude=1"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<FollowerPressure>(node, reading); }};
  }
} // namespace myolines
