// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/scene/numbers.h>
#include <myolines/system/drive_types.h>
#include <myolines/system/instants.h>
#include <myolines/system/steered_drive.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    std::shared_ptr<const Drive> constant_course(const double value)
    {
      return std::make_shared<PiecewiseDrive>(PiecewiseDrive::constant(value));
    }
  } // namespace

  Steering::Steering(std::string path, std::string where, Driven driven, const double value)
    : path_(std::move(path))
    , where_(std::move(where))
    , driven_(std::move(driven))
  {
    begin_with(value);
  }

  void Steering::refuse(const std::string &what, const std::string &expected) const
  {
    throw InputError(InputProblem{where_, what, expected, ""});
  }

  void Steering::require(const double value) const
  {
    if (!std::isfinite(value) || !driven_.range.contains(value))
      refuse(scene::format_number(value) + " [" + driven_.unit + "] is out of range",
             "a number [" + driven_.unit + "] " + driven_.range.text());
  }

  void Steering::go_to(const double value, const double t, const double duration)
  {
    require(value);
    if (!(duration >= 0) || !std::isfinite(duration))
      refuse("a duration of " + scene::format_number(duration) + " s", "a time >= 0 [s]");
    if (duration == 0)
      return follow(constant_course(value), t);
    const std::vector<PiecewiseDrive::ControlPoint> points{{t, courses_.now->value(t, Side::left)}, {t + duration, value}};
    if (!(duration > 4 * PiecewiseDrive::tolerance(points)))
      refuse(scene::format_number(duration) + " s vanish beside the time " + scene::format_number(t) + " s", "a longer time, or 0");
    follow(std::make_shared<PiecewiseDrive>(PiecewiseDrive::lines(points)), t);
  }

  void Steering::follow(std::shared_ptr<const Drive> course, const double t)
  {
    require(course->value(t, Side::right));
    // A second word at the same instant replaces the first one; what came before that instant stays.
    std::shared_ptr<const Drive> before = same_time(t, courses_.since) ? courses_.before : courses_.now;
    courses_                            = {std::move(before), std::move(course), t};
  }

  void Steering::begin_with(const double value) { begin_with(constant_course(value), 0); }

  void Steering::begin_with(std::shared_ptr<const Drive> course, const double t)
  {
    require(course->value(t, Side::right));
    courses_ = {course, course, std::numeric_limits<double>::lowest()};
  }

  SteeredDrive::SteeredDrive(std::shared_ptr<Steering> steering)
    : steering_(std::move(steering))
  {}

  const Drive &SteeredDrive::course(const double t, const Side side) const
  {
    const Steering::Courses &courses = steering_->courses();
    return has_begun(courses.since, t, side, time_tolerance(t)) ? *courses.now : *courses.before;
  }

  double SteeredDrive::value(const double t, const Side side) const { return course(t, side).value(t, side); }

  double SteeredDrive::first_derivative(const double t, const Side side) const { return course(t, side).first_derivative(t, side); }

  double SteeredDrive::second_derivative(const double t, const Side side) const { return course(t, side).second_derivative(t, side); }

  std::vector<double> SteeredDrive::kinks(const double t0, const double t1) const
  {
    const auto &[before, now, since] = steering_->courses();
    std::vector<double> times;
    if (t0 < since)
      times = before->kinks(t0, std::min(t1, since));
    if (t0 < since && since < t1)
      times.push_back(since);
    if (since < t1)
      for (const double t : now->kinks(std::max(t0, since), t1))
        times.push_back(t);
    return one_list(std::move(times));
  }

  scene::Schema steered_schema(const std::string &quantity, const std::string &unit)
  {
    scene::Schema schema(
        "Set while it runs by whoever has the simulation in hand (doc/python.md); in a run of the program it stays as it starts.");
    schema.number("value", 0, unit, scene::Range::any(), "Value of the " + quantity + " at the start.");
    return schema;
  }

  std::unique_ptr<SteeredDrive> make_steered_drive(const scene::Node &node, const Driven &driven)
  {
    return std::make_unique<SteeredDrive>(std::make_shared<Steering>(node.path(), node.where("value"), driven, node.number("value")));
  }

  std::shared_ptr<Steering> steering_of(const Drive *drive)
  {
    const auto *steered = dynamic_cast<const SteeredDrive *>(drive);
    return steered != nullptr ? steered->steering() : nullptr;
  }
} // namespace myolines
