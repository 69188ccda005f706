// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/point.h>

#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// A given function of time: strain, activation, a force. Knows its first two derivatives and its kinks.
  /// At a kink every quantity has two one-sided limits; elsewhere the side does not matter.
  class Drive
  {
  public:
    virtual ~Drive() = default;

    virtual double value(double t, Side side = Side::left) const             = 0; ///< in the unit of what is driven
    virtual double first_derivative(double t, Side side = Side::left) const  = 0; ///< [1/s]
    virtual double second_derivative(double t, Side side = Side::left) const = 0; ///< [1/s^2]

    /// Times in the open interval (t0, t1), ascending, where the value or a derivative used above jumps.
    virtual std::vector<double> kinks(double t0, double t1) const = 0;

    /// True if the drive is zero at all times: a scene then skips what it would drive.
    virtual bool identically_zero() const { return false; }
  };

  /// Parameters of a drive: `type` (constant, control points, spline, ramp, smooth step, sine, power, steered) and what each type needs.
  /// @p quantity and @p unit name what is driven, for the documentation ("boundary strain", "-").
  scene::Schema drive_schema(const std::string &quantity, const std::string &unit);

  /// The drive a scene describes. @throws InputError for unsorted or non-finite control points.
  std::unique_ptr<Drive> make_drive(const scene::Node &node);
} // namespace myolines
