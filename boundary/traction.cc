// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>
#include <myolines/scene/formula.h>

namespace myolines
{
  namespace
  {
    /// Dead load per reference area T(x, y, z, t).
    class Traction : public BoundaryCondition
    {
    public:
      Traction(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , traction_(read_formulas(node, "traction "))
      {
        facts_.part  = read_box(node);
        facts_.loads = true;
      }

      Vector3 load(const double t, Side, const FacePoint &point) const override
      {
        Vector3 T;
        for (unsigned int c = 0; c < 3; ++c)
          T[c] = traction_.zero(c) ? 0 : traction_(c, point.place, t);
        return point.area * T;
      }

    private:
      const VectorFormula traction_; ///< [Pa]
    };
  } // namespace

  BoundaryEntry traction_condition()
  {
    scene::Schema schema("A dead load per reference area.");
    add_formulas(schema, "traction ", "Traction [Pa]");
    add_box(schema);
    return {"traction",
            MuscleEnd::moved,
            schema,
            {"traction x=3e4*(1+t)", "traction z=1e5*y"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<Traction>(node, reading); }};
  }
} // namespace myolines
