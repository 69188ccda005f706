// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/face_as_one.h>
#include <myolines/system/file_drive.h>

namespace myolines
{
  namespace
  {
    using scene::Node;

    /// u.n = q on the whole face, pulled by a tendon whose far end moves by d(t) along n: F(d - q).
    class TendonFace : public FaceAsOne
    {
    public:
      TendonFace(const Node &node, const BoundaryReading &reading)
        : FaceAsOne(node, reading, read_tendon_spring(node.section("spring")))
      {
        if (node.has("motion"))
          motion_ = make_drive(node.section("motion"), Driven{"motion", "m"});
        facts_.says_spring = "is pulled by a tendon";
      }

      std::vector<const Drive *> drives() const override
      {
        return motion_ ? std::vector<const Drive *>{motion_.get()} : std::vector<const Drive *>{};
      }

      /// Of the far end.
      double power(const double t, const Side side, const FacePoint &point, const FaceMotion &x) const override
      {
        return motion_ ? force(t, side, point, x) * direction() * motion_->first_derivative(t, side) : 0;
      }

      std::optional<std::array<double, 2>> tendon(const double t, const Side side, const Vector3 &u) const override
      {
        return std::array<double, 2>{{slack(t, side) - direction() * u, spring_length()}};
      }

    private:
      double slack(const double t, const Side side) const override { return motion_ ? motion_->value(t, side) : 0; }

      std::shared_ptr<const Drive> motion_; ///< [m]
    };
  } // namespace

  BoundaryEntry tendon_spring_condition()
  {
    scene::Schema schema("The face moves as one along a direction, pulled by a tendon in series. The tendon is slack at rest, its far "
                         "end moves along n.");
    FaceAsOne::add(schema);
    schema.section("spring", tendon_spring_schema()).optional_section("motion", drive_schema("motion of the far end of the tendon", "m"));
    return {"tendon spring",
            MuscleEnd::moved,
            schema,
            {"direction=0.8 0 0.6", "spring/type=tendinous", "spring/force=20", "spring/slack length=0.05", "motion/type=sine",
             "motion/frequency=3", "motion/amplitude=0.004"},
            [](const Node &node, const BoundaryReading &reading) { return std::make_shared<TendonFace>(node, reading); }};
  }
} // namespace myolines
