// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>

#include <optional>
#include <vector>

namespace myolines
{
  /// The values @p x at ascending times @p t, low-passed by the natural cubic smoothing spline (Reinsch, doi:10.1007/BF02162161; Green and
  /// Silverman, doi:10.1201/b15710): the function f that minimises sum (x_i - f(t_i))^2 + p int f''^2 dt. At @p cut_off f_c [Hz] it passes
  /// half of an oscillation, p = 1/(h (2 pi f_c)^4) with h the mean distance of samples: the gain is 1/(1 + (f/f_c)^4), that of a
  /// Butterworth filter of second order forwards and backwards. It overshoots beside jumps.
  std::vector<double> spline_filtered(const std::vector<double> &t, const std::vector<double> &x, double cut_off);

  /// A quantity between its samples, by cubics; constant outside.
  class SampledDrive : public Drive
  {
  public:
    /// Straight lines; every sample is a kink.
    static SampledDrive lines(const std::vector<double> &t, const std::vector<double> &x);

    /// The natural cubic spline, with continuous second derivative; no kinks inside.
    static SampledDrive spline(const std::vector<double> &t, const std::vector<double> &x);

    /// The cubics that rise and fall only where the samples do (Fritsch and Butland, doi:10.1137/0905021): they leave no bounds that the
    /// samples keep. The first derivative is continuous, the second jumps at samples, and none of them counts as a kink inside.
    static SampledDrive monotone(const std::vector<double> &t, const std::vector<double> &x);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double t0, double t1) const override;
    bool                identically_zero() const override;

    double begin() const { return t_.front(); } ///< [s]
    double end() const { return t_.back(); }    ///< [s]

    std::size_t n_samples() const { return t_.size(); } ///< of all of them
    std::size_t n_samples(double t0, double t1) const;  ///< of those, from t0 to t1 [s]

    /// The least and the greatest value.
    struct Extremes
    {
      double least;    ///< in the unit of the samples
      double greatest; ///< likewise
    };
    /// Of all times, between samples too.
    Extremes extremes() const;

  private:
    /// Slopes at the begin and at the end of each interval.
    SampledDrive(std::vector<double> t, std::vector<double> x, std::vector<double> begin_slope, std::vector<double> end_slope, bool smooth);

    /// x + h s (c1 + s (c2 + s c3)) with s from 0 to 1 in an interval of length h.
    struct Cubic
    {
      double h, x, c1, c2, c3;

      double value(const double s) const { return x + h * s * (c1 + s * (c2 + s * c3)); }
    };
    Cubic cubic(std::size_t i) const;

    /// Where @p t is in the interval that holds it, or that ends (begins) there; none outside.
    struct Place
    {
      Cubic  cubic;
      double s;
    };
    std::optional<Place> place(double t, Side side) const;

    std::vector<double> t_, x_, begin_slope_, end_slope_;
    bool                smooth_; ///< inside
  };
} // namespace myolines
