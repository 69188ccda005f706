// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>

#include <cmath>
#include <functional>

namespace myolines::testing
{
  /// A smooth drive from its value and derivatives.
  class SmoothDrive : public Drive
  {
  public:
    using Function = std::function<double(double)>;

    SmoothDrive(Function value, Function first, Function second)
      : value_(std::move(value))
      , first_(std::move(first))
      , second_(std::move(second))
    {}

    double              value(double t, Side) const override { return value_(t); }
    double              first_derivative(double t, Side) const override { return first_(t); }
    double              second_derivative(double t, Side) const override { return second_(t); }
    std::vector<double> kinks(double, double) const override { return {}; }

  private:
    Function value_, first_, second_;
  };

  /// amplitude sin(omega t)
  inline std::shared_ptr<const Drive> sine(const double amplitude, const double omega)
  {
    return std::make_shared<SmoothDrive>([=](double t) { return amplitude * std::sin(omega * t); },
                                         [=](double t) { return amplitude * omega * std::cos(omega * t); },
                                         [=](double t) { return -amplitude * omega * omega * std::sin(omega * t); });
  }

  /// Zero until @p kink, then rising with @p slope.
  class Ramp : public Drive
  {
  public:
    Ramp(const double kink, const double slope)
      : kink_(kink)
      , slope_(slope)
    {}

    double value(double t, Side) const override { return t > kink_ ? slope_ * (t - kink_) : 0; }
    double first_derivative(double t, Side side) const override { return t > kink_ || (t == kink_ && side == Side::right) ? slope_ : 0; }
    double second_derivative(double, Side) const override { return 0; }
    std::vector<double> kinks(double t0, double t1) const override
    {
      return t0 < kink_ && kink_ < t1 ? std::vector<double>{kink_} : std::vector<double>{};
    }

  private:
    double kink_, slope_;
  };
} // namespace myolines::testing
