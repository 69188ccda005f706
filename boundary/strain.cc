// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    using scene::Range;

    /// Extent of the body at rest along a unit vector [m].
    double extent_along(const Geometry &geometry, const Vector3 &direction)
    {
      double low = Box::infinity, high = -Box::infinity;
      for (const dealii::Point<3> &x : corners(geometry))
        {
          const double s = x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2];
          low            = std::min(low, s);
          high           = std::max(high, s);
        }
      return high - low;
    }

    /// u = reference length * strain(t) * direction.
    class StrainedFace : public BoundaryCondition
    {
    public:
      StrainedFace(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , direction_(read_direction_of(node, reading))
        , length_(node.has("reference length") ? node.number("reference length") : extent_along(reading.geometry, direction_))
        , strain_(make_drive(node.section("strain")))
      {
        refuse_values_outside(node.section("strain"), *strain_, Range{-1, 1e9, true, false}, "boundary strain");
        facts_.prescribed = read_components(node);
        facts_.strains    = true;
        for (unsigned int c = 0; c < 3; ++c)
          {
            facts_.moving[c] = direction_[c] != 0;
            if (facts_.moving[c] && !facts_.prescribed[c])
              node.refuse("direction", std::string("the motion has a component ") + axes[c] + " that is not prescribed",
                          "a direction within the components", std::string("add ") + axes[c] + " to \"components\"");
          }
      }

      std::vector<const Drive *> drives() const override { return {strain_.get()}; }

      Motion motion(const double t, const Side side) const override
      {
        const std::array<double, 3> strain{
            {strain_->value(t, side), strain_->first_derivative(t, side), strain_->second_derivative(t, side)}};
        std::array<Vector3, 3> all;
        for (unsigned int order = 0; order < 3; ++order)
          all[order] = length_ * strain[order] * direction_;
        return [all](const dealii::Point<3> &) { return all; };
      }

    private:
      const Vector3                direction_;
      const double                 length_; ///< that the strain refers to [m]
      std::shared_ptr<const Drive> strain_;
    };
  } // namespace

  BoundaryEntry strain_condition()
  {
    scene::Schema schema("The face moves by reference length * strain(t) along a direction; prescribed components across it stay zero.");
    add_components(schema);
    add_direction(schema, "Direction of the motion");
    schema
        .optional_number("reference length", "m", Range::positive(),
                         "Length that the strain refers to; default: that of the body along the direction.")
        .section("strain", drive_schema("boundary strain", "-"));
    return {"strain",
            MuscleEnd::moved,
            schema,
            {"strain/type=sine", "strain/amplitude=0.02", "strain/frequency=8"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<StrainedFace>(node, reading); }};
  }
} // namespace myolines
