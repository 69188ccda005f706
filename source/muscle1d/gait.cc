// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle1d/gait.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    /// size exp(sharpness (cos(omega t - phase) - 1))
    struct Burst
    {
      double size, sharpness, phase;
    };
    constexpr Burst  bursts[] = {{0.7, 12, 2 * M_PI * 0.75}, {0.25, 30, 2 * M_PI * 0.30}};
    constexpr double floor_   = 0.02;

    constexpr double first_harmonic = 0.045 / 2, second_harmonic = 0.015 / 2;
  } // namespace

  GaitLength::GaitLength(const double optimal_length, const double base, const double amplitude, const double frequency)
    : length_(optimal_length)
    , base_(base)
    , amplitude_(amplitude)
    , omega_(2 * M_PI * frequency)
  {}

  double GaitLength::value(const double t, Side) const
  {
    return length_ *
           (base_ + amplitude_ * (first_harmonic * (1 - std::cos(omega_ * t)) + second_harmonic * (1 - std::cos(2 * omega_ * t))));
  }

  double GaitLength::first_derivative(const double t, Side) const
  {
    return length_ * amplitude_ * omega_ * (first_harmonic * std::sin(omega_ * t) + 2 * second_harmonic * std::sin(2 * omega_ * t));
  }

  double GaitLength::second_derivative(const double t, Side) const
  {
    return length_ * amplitude_ * omega_ * omega_ *
           (first_harmonic * std::cos(omega_ * t) + 4 * second_harmonic * std::cos(2 * omega_ * t));
  }

  GaitExcitation::GaitExcitation(const double frequency)
    : omega_(2 * M_PI * frequency)
  {}

  double GaitExcitation::value(const double t, Side) const
  {
    double sum = floor_;
    for (const Burst &b : bursts)
      sum += b.size * std::exp(b.sharpness * (std::cos(omega_ * t - b.phase) - 1));
    return sum;
  }

  double GaitExcitation::first_derivative(const double t, Side) const
  {
    double sum = 0;
    for (const Burst &b : bursts)
      {
        const double angle = omega_ * t - b.phase;
        sum -= b.size * std::exp(b.sharpness * (std::cos(angle) - 1)) * b.sharpness * omega_ * std::sin(angle);
      }
    return sum;
  }

  double GaitExcitation::second_derivative(const double t, Side) const
  {
    double sum = 0;
    for (const Burst &b : bursts)
      {
        const double angle = omega_ * t - b.phase, k = b.sharpness, sine = std::sin(angle);
        sum += b.size * std::exp(k * (std::cos(angle) - 1)) * k * omega_ * omega_ * (k * sine * sine - std::cos(angle));
      }
    return sum;
  }
} // namespace myolines
