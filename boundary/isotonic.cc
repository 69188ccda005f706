// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/face_as_one.h>
#include <myolines/scene/numbers.h>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;

    std::unique_ptr<TendonSpring> read_stop(const Node &node)
    {
      return node.has("stop") ? make_stop_spring(node.section("stop").number("stiffness")) : nullptr;
    }

    /// u.n = q on the whole face, moved by a given force F(t) along n, and by a stop -k max(0, q - position).
    class IsotonicFace : public FaceAsOne
    {
    public:
      IsotonicFace(const Node &node, const BoundaryReading &reading)
        : FaceAsOne(node, reading, read_stop(node))
        , force_(node, "force")
        , stop_(has_spring() ? node.section("stop").number("position") : 0)
      {
        facts_.loads = true;
        if (!has_spring())
          return;
        if (force_.size() < 0)
          node.refuse("force", "pulls the face away from its stop", "a number >= 0", "turn the \"direction\" instead");
        facts_.says_spring = "has a stop at " + scene::format_number(stop_) + " m";
        facts_.columns     = {"stop [N]"};
      }

      std::vector<const Drive *> drives() const override { return force_.drives(); }

      Vector3 load(const double t, const Side side, const FacePoint &point) const override
      {
        return point.area * (force_.at(t, side) / point.face_area * direction());
      }

      std::vector<double> own_columns(double, Side, const FaceReaction &reaction) const override
      {
        return has_spring() ? std::vector<double>{reaction.support * direction()} : std::vector<double>{};
      }

    private:
      double slack(double, Side) const override { return stop_; }

      const ProfiledLoad force_; ///< [N]
      const double       stop_;  ///< u.n where the face touches its stop [m]
    };
  } // namespace

  BoundaryEntry isotonic_condition()
  {
    scene::Schema schema("The face moves as one along a direction, as far as a given force takes it.");
    FaceAsOne::add(schema);
    ProfiledLoad::add(schema, "force", "N", "Force along n: positive where it pulls that way.");
    scene::Schema stop(
        "A stop for afterloaded contractions: the force -k max(0, q - position) along n keeps the face from moving farther.");
    stop.number("stiffness", std::nullopt, "N/m", Range::positive(), "k: the face stands beyond the stop by the force on it over k.")
        .number("position", 0, "m", Range::any(), "Motion q = u.n of the face where it touches the stop.");
    schema.optional_section("stop", stop);
    return {"isotonic",
            MuscleEnd::moved,
            schema,
            {"force=3", "direction=0.6 0.8 0", "stop/stiffness=1e5", "stop/position=-1e-3", "profile/type=sine", "profile/frequency=3",
             "profile/amplitude=1"},
            [](const Node &node, const BoundaryReading &reading) { return std::make_shared<IsotonicFace>(node, reading); }};
  }
} // namespace myolines
