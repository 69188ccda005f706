// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>
#include <myolines/scene/numbers.h>
#include <myolines/system/file_drive.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::Node;

    /// A matrix as a function of time with two derivatives.
    struct MatrixInTime
    {
      Matrix3 value, first, second;
    };

    MatrixInTime operator*(const MatrixInTime &A, const MatrixInTime &B)
    {
      return {A.value * B.value, A.first * B.value + A.value * B.first, A.second * B.value + 2. * A.first * B.first + A.value * B.second};
    }

    /// Of a number.
    struct NumberInTime
    {
      double value = 0, first = 0, second = 0;
    };

    /// I + sin(a) K + (1 - cos(a)) K^2, K x = axis x x (Rodrigues): the rotation by a(t) [rad] about a unit vector.
    MatrixInTime rotation_about(const Vector3 &axis, const NumberInTime &a)
    {
      Matrix3 K, unit;
      for (unsigned int c = 0; c < 3; ++c)
        {
          unit[c][c]                  = 1;
          K[(c + 2) % 3][(c + 1) % 3] = axis[c];
          K[(c + 1) % 3][(c + 2) % 3] = -axis[c];
        }
      const Matrix3 K2 = K * K;
      const double  s = std::sin(a.value), c = std::cos(a.value);
      const Matrix3 slope = c * K + s * K2, bend = -s * K + c * K2;
      return {unit + s * K + (1 - c) * K2, a.first * slope, a.second * slope + a.first * a.first * bend};
    }

    /// x = p + d(t) + R(t) (X - p).
    class RigidMotion : public BoundaryCondition
    {
    public:
      RigidMotion(const Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , point_(read_point(node, reading))
        , axes_(read_axes(node))
      {
        std::istringstream order(node.text("order"));
        for (std::string axis; order >> axis;)
          order_.push_back(std::find(axes.begin(), axes.end(), axis) - axes.begin());
        for (unsigned int i = 0; i < 3; ++i)
          {
            translation_[i] = read(node, std::string("translation ") + axes[i], "m");
            rotation_[i]    = read(node, std::string("rotation ") + axes[i], "degree");
          }
        if (drives().empty())
          node.refuse("type", "nothing says how the face moves", "one list of \"translation x\" to \"rotation z\" at least",
                      "what does not move is \"fixed\"");
        const bool turns  = rotation_[0] || rotation_[1] || rotation_[2];
        facts_.prescribed = {{true, true, true}};
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < 3; ++i)
            facts_.moving[c] = facts_.moving[c] || turns || (translation_[i] && axes_[i][c] != 0);
        std::ostringstream says;
        says << "moves as a rigid body" << (turns ? " about (" : "");
        for (unsigned int c = 0; c < 3 && turns; ++c)
          says << scene::format_number(point_[c]) << (c < 2 ? " " : ") m");
        facts_.says_motion = says.str();
        for (const char *axis : axes)
          facts_.columns.push_back(std::string("moment ") + axis + " [N m]");
      }

      std::vector<const Drive *> drives() const override
      {
        std::vector<const Drive *> all;
        for (const auto *three : {&translation_, &rotation_})
          for (const auto &drive : *three)
            if (drive)
              all.push_back(drive.get());
        return all;
      }

      Motion motion(const double t, const Side side) const override
      {
        const std::array<Vector3, 3> d = translation(t, side);
        MatrixInTime                 R = rotation_about(axes_[0], {});
        for (const std::size_t i : order_)
          R = R * rotation_about(axes_[i], at(rotation_[i], t, side, degree));
        return [p = point_, d, R](const dealii::Point<3> &X) {
          const Vector3 arm = Vector3(X) - p;
          return std::array<Vector3, 3>{{d[0] + R.value * arm - arm, d[1] + R.first * arm, d[2] + R.second * arm}};
        };
      }

      /// Moment about the point where it now is.
      std::vector<double> own_columns(const double t, const Side side, const FaceReaction &reaction) const override
      {
        const Vector3 moment = reaction.moment - cross_product_3d(point_ + translation(t, side)[0], reaction.constraint);
        return {moment[0], moment[1], moment[2]};
      }

    private:
      using Drives                   = std::array<std::shared_ptr<const Drive>, 3>;
      static constexpr double degree = dealii::numbers::PI / 180;

      static std::shared_ptr<const Drive> read(const Node &node, const std::string &list, const std::string &unit)
      {
        return node.has(list) ? make_drive(node.section(list), Driven{list, unit}) : nullptr;
      }

      static Vector3 read_point(const Node &node, const BoundaryReading &reading)
      {
        if (!node.has("point"))
          return face_centre(reading.geometry, reading.facts.face);
        const std::array<double, 3> p = read_vector(node, "point");
        if (!std::isfinite(p[0] + p[1] + p[2]))
          node.refuse("point", "is not finite", "three numbers separated by spaces");
        return Vector3({p[0], p[1], p[2]});
      }

      /// Right-handed unit vectors; the second given one is made perpendicular to the first.
      static std::array<Vector3, 3> read_axes(const Node &node)
      {
        const auto given = [&](const std::string &name, const Vector3 &fallback) {
          if (!node.has(name))
            return fallback;
          const std::array<double, 3> v = read_direction(node, name);
          return Vector3({v[0], v[1], v[2]});
        };
        if (node.has("axis x") != node.has("axis y"))
          node.refuse(node.has("axis x") ? "axis y" : "axis x", "is missing, where the other axis is given",
                      "three numbers, or neither axis");
        const Vector3 x = given("axis x", Vector3({1, 0, 0}));
        Vector3       y = given("axis y", Vector3({0, 1, 0}));
        y -= (x * y) * x;
        if (y.norm() < 1e-3)
          node.refuse("axis y", "has the direction of \"axis x\"", "a direction across it");
        y /= y.norm();
        return {{x, y, cross_product_3d(x, y)}};
      }

      static NumberInTime at(const std::shared_ptr<const Drive> &drive, const double t, const Side side, const double unit)
      {
        if (!drive)
          return {};
        return {unit * drive->value(t, side), unit * drive->first_derivative(t, side), unit * drive->second_derivative(t, side)};
      }

      /// d and its derivatives.
      std::array<Vector3, 3> translation(const double t, const Side side) const
      {
        std::array<Vector3, 3> d;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const NumberInTime s = at(translation_[i], t, side, 1);
            d[0] += s.value * axes_[i];
            d[1] += s.first * axes_[i];
            d[2] += s.second * axes_[i];
          }
        return d;
      }

      const Vector3                point_; ///< p, at rest [m]
      const std::array<Vector3, 3> axes_;
      std::vector<std::size_t>     order_;                  ///< of the factors of R
      Drives                       translation_, rotation_; ///< nullptr: zero
    };
  } // namespace

  BoundaryEntry rigid_motion_condition()
  {
    scene::Schema schema(
        "The face moves as a rigid body: x = p + d(t) + R(t) (X - p), p a point of the body at rest. Rotations are about the axes "
        "that the ones before have turned: with the order x y z, R = R_x R_y R_z.");
    schema.optional_text("point", "Point p [m] at rest, three numbers, for example \"0.03 0.005 0\"; default: the centre of the face.")
        .choice("order", "x y z", {"x y z", "x z y", "y x z", "y z x", "z x y", "z y x"}, "Order of the rotations.")
        .optional_text("axis x", "Direction of the axis x of translations and rotations, for example \"1 1 0\"; default: that of the body.")
        .optional_text("axis y", "Direction of the axis y, made perpendicular to that of x, for example \"0 1 0\"; z is across both.");
    for (const char *axis : axes)
      schema.optional_section(std::string("translation ") + axis, drive_schema(std::string("translation along ") + axis, "m"));
    for (const char *axis : axes)
      schema.optional_section(std::string("rotation ") + axis, drive_schema(std::string("rotation about ") + axis, "degree"));
    return {"rigid motion",
            MuscleEnd::moved,
            schema,
            {"point=0.01 0.02 -0.01", "order=y z x", "axis x=0.8 0.6 0", "axis y=0 0 1", "translation x/type=sine",
             "translation x/amplitude=0.0002", "translation x/frequency=3", "rotation x/type=sine", "rotation x/amplitude=1",
             "rotation x/frequency=2", "rotation y/type=sine", "rotation y/amplitude=0.8", "rotation y/frequency=3",
             "rotation z/type=power", "rotation z/amplitude=2e3", "rotation z/exponent=3"},
            [](const Node &node, const BoundaryReading &reading) { return std::make_shared<RigidMotion>(node, reading); }};
  }
} // namespace myolines
