// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/file_drive.h>

#include <memory>
#include <string>

namespace myolines
{
  /// What a steered drive follows: whoever has a simulation in hand says so while it runs, and a drive that has been made keeps to it.
  /// Between two such words it is a function of time alone.
  class Steering
  {
  public:
    /// @p path of the drive in its scene ("system/activation"), which starts with @p value.
    Steering(std::string path, std::string where, Driven driven, double value);

    const std::string &path() const { return path_; }     ///< of the drive in its scene
    const Driven      &driven() const { return driven_; } ///< what it is a function of time of

    /// From @p t on linearly to @p value at @p t + @p duration, then constant; with a duration of 0 it jumps at @p t [s].
    /// @throws InputError for a value outside the range of what is driven, for what is not finite, and a negative duration.
    void go_to(double value, double t, double duration = 0);

    /// @p course from @p t on [s]. @throws InputError if its value there is outside the range of what is driven.
    void follow(std::shared_ptr<const Drive> course, double t);

    /// At all times, before and after: for a simulation that has not begun and will at @p t [s]. @throws as above.
    void begin_with(double value);
    void begin_with(std::shared_ptr<const Drive> course, double t); ///< The same with a course, from @p t on [s].

    /// What is followed, to be put back later.
    struct Courses
    {
      std::shared_ptr<const Drive> before; ///< until `since`
      std::shared_ptr<const Drive> now;    ///< from `since` on
      double                       since;  ///< [s]
    };
    const Courses &courses() const { return courses_; }                         ///< what is followed now
    void           put_back(Courses courses) { courses_ = std::move(courses); } ///< follows again what courses() gave

    /// @throws InputError at the place of the drive.
    [[noreturn]] void refuse(const std::string &what, const std::string &expected) const;

  private:
    void require(double value) const;

    std::string path_, where_;
    Driven      driven_;
    Courses     courses_;
  };

  /// A drive that follows a Steering: the value and derivatives of its courses, a kink where one gives way to the next.
  class SteeredDrive : public Drive
  {
  public:
    explicit SteeredDrive(std::shared_ptr<Steering> steering); ///< Follows @p steering from now on.

    const std::shared_ptr<Steering> &steering() const { return steering_; } ///< what it follows

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double t0, double t1) const override;

  private:
    const Drive &course(double t, Side side) const;

    std::shared_ptr<Steering> steering_;
  };

  /// Parameters of the alternative `steered` of a drive.
  scene::Schema steered_schema(const std::string &quantity, const std::string &unit);
  /// The drive that the list @p node describes, with a Steering of its own.
  std::unique_ptr<SteeredDrive> make_steered_drive(const scene::Node &node, const Driven &driven);

  /// What steers @p drive; nullptr: nothing does.
  std::shared_ptr<Steering> steering_of(const Drive *drive);
} // namespace myolines
