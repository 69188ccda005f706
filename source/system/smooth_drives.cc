// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/drive_types.h>
#include <myolines/system/instants.h>

#include <cmath>

namespace myolines
{
  SmoothStep::SmoothStep(const double amplitude, const double start, const double duration, const double shape)
    : amplitude_(amplitude)
    , start_(start)
    , duration_(duration)
    , shape_(shape)
  {}

  namespace
  {
    /// phi(x) of SmoothStep and its first two derivatives.
    struct Sigmoid
    {
      double value = 0, first = 0, second = 0;

      Sigmoid(const double x, const double c0)
      {
        if (x >= 1)
          value = 1;
        if (x <= 0 || x >= 1)
          return;
        const double y = 1 - x;
        const double z = (1 / x - 1 / y) / c0;
        value          = 1 / (1 + std::exp(z));
        if (std::abs(z) > 700) // the derivatives underflow while their polynomial factors overflow
          return;
        const double z1    = -(1 / (x * x) + 1 / (y * y)) / c0;
        const double z2    = (2 / (x * x * x) - 2 / (y * y * y)) / c0;
        const double slope = -std::exp(z) * value * value; // d phi / dz
        first              = slope * z1;
        second             = slope * ((2 * value - 1) * z1 * z1 + z2);
      }
    };
  } // namespace

  double SmoothStep::value(const double t, Side) const { return amplitude_ * Sigmoid((t - start_) / duration_, shape_).value; }

  double SmoothStep::first_derivative(const double t, Side) const
  {
    return amplitude_ * Sigmoid((t - start_) / duration_, shape_).first / duration_;
  }

  double SmoothStep::second_derivative(const double t, Side) const
  {
    return amplitude_ * Sigmoid((t - start_) / duration_, shape_).second / (duration_ * duration_);
  }

  Power::Power(const double amplitude, const double start, const unsigned int exponent)
    : amplitude_(amplitude)
    , start_(start)
    , exponent_(exponent)
  {}

  double Power::derivative(const unsigned int order, const double t, const Side side) const
  {
    if (order > exponent_ || !has_begun(start_, t, side, time_tolerance(start_)))
      return 0;
    double value = amplitude_;
    for (unsigned int i = 0; i < order; ++i)
      value *= exponent_ - i;
    for (unsigned int i = order; i < exponent_; ++i)
      value *= t - start_;
    return value;
  }

  double Power::value(const double t, const Side side) const { return derivative(0, t, side); }

  double Power::first_derivative(const double t, const Side side) const { return derivative(1, t, side); }

  double Power::second_derivative(const double t, const Side side) const { return derivative(2, t, side); }

  std::vector<double> Power::kinks(const double t0, const double t1) const
  {
    return amplitude_ != 0 && exponent_ <= 2 && t0 < start_ && start_ < t1 ? std::vector<double>{start_} : std::vector<double>{};
  }

  Sine::Sine(const double amplitude, const double frequency, const double phase, const double offset)
    : amplitude_(amplitude)
    , omega_(2 * 3.14159265358979323846 * frequency)
    , phase_(phase)
    , offset_(offset)
  {}

  double Sine::value(const double t, Side) const { return offset_ + amplitude_ * std::sin(omega_ * t + phase_); }

  double Sine::first_derivative(const double t, Side) const { return amplitude_ * omega_ * std::cos(omega_ * t + phase_); }

  double Sine::second_derivative(const double t, Side) const { return -amplitude_ * omega_ * omega_ * std::sin(omega_ * t + phase_); }
} // namespace myolines
