// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>

namespace myolines
{
  /// Length of a muscle-tendon unit in a synthetic gait of frequency f, for runs without measured data:
  ///
  ///     L(t) = L_opt (base + amplitude (0.045 (1 - cos 2 pi f t)/2 + 0.015 (1 - cos 4 pi f t)/2)).
  class GaitLength : public Drive
  {
  public:
    /// @p optimal_length L_opt > 0 [m], @p frequency > 0 [Hz].
    GaitLength(double optimal_length, double base, double amplitude, double frequency);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double, double) const override { return {}; }

  private:
    double length_, base_, amplitude_, omega_;
  };

  /// Excitation in the same gait: 0.02 + 0.7 exp(12 (cos 2 pi (f t - 0.75) - 1)) + 0.25 exp(30 (cos 2 pi (f t - 0.30) - 1)).
  class GaitExcitation : public Drive
  {
  public:
    /// @p frequency f > 0 [Hz].
    explicit GaitExcitation(double frequency);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double, double) const override { return {}; }

  private:
    double omega_;
  };
} // namespace myolines
