// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

namespace myolines
{
  namespace
  {
    /// Dead load -p(t) along the outward normal at rest.
    class Pressure : public BoundaryCondition
    {
    public:
      Pressure(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , pressure_(node, "pressure")
      {
        facts_.part  = read_box(node);
        facts_.loads = true;
      }

      std::vector<const Drive *> drives() const override { return pressure_.drives(); }

      Vector3 load(const double t, const Side side, const FacePoint &point) const override
      {
        return point.area * (-pressure_.at(t, side) * point.normal);
      }

    private:
      const ProfiledLoad pressure_; ///< [Pa]
    };
  } // namespace

  BoundaryEntry pressure_condition()
  {
    scene::Schema schema("A dead load along the inward normal of the face at rest, per reference area.");
    ProfiledLoad::add(schema, "pressure", "Pa", "Force per reference area.");
    add_box(schema);
    return {"pressure",
            MuscleEnd::none,
            schema,
            {"pressure=2e4", "profile/type=sine", "profile/frequency=3", "profile/amplitude=1"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<Pressure>(node, reading); }};
  }
} // namespace myolines
