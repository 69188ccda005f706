// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

namespace myolines
{
  namespace
  {
    /// Dead load per reference area T(t) along a direction.
    class DirectedTraction : public BoundaryCondition
    {
    public:
      DirectedTraction(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , traction_(node, "traction")
        , direction_(read_direction_of(node, reading))
      {
        facts_.part  = read_box(node);
        facts_.loads = true;
      }

      std::vector<const Drive *> drives() const override { return traction_.drives(); }

      Vector3 load(const double t, const Side side, const FacePoint &point) const override
      {
        return point.area * (traction_.at(t, side) * direction_);
      }

    private:
      const ProfiledLoad traction_; ///< [Pa]
      const Vector3      direction_;
    };
  } // namespace

  BoundaryEntry directed_traction_condition()
  {
    scene::Schema schema("A dead load along a direction, per reference area.");
    ProfiledLoad::add(schema, "traction", "Pa", "Force per reference area.");
    add_direction(schema, "Direction of the load");
    add_box(schema);
    return {"directed traction",
            MuscleEnd::moved,
            schema,
            {"traction=3e4", "direction=0.6 0 0.8", "profile/type=sine", "profile/frequency=3", "profile/amplitude=1"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<DirectedTraction>(node, reading); }};
  }
} // namespace myolines
