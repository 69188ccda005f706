// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>

#include <vector>

namespace myolines
{
  /// Polynomials of degree three between given times, constant before the first and after the last. The value is continuous;
  /// derivatives may jump at the given times, and where they do there is a kink.
  ///
  /// A time that is the same instant as a kink (instants.h, at the largest time of the drive) counts as the kink, so that rounding does not
  /// decide which side is taken.
  class PiecewiseDrive : public Drive
  {
  public:
    /// Value c0 + c1 s + c2 s^2 + c3 s^3 with s = t - begin.
    struct Piece
    {
      double begin; ///< [s]
      double c0;    ///< value at the begin
      double c1;    ///< of s [1/s]
      double c2;    ///< of s^2 [1/s^2]
      double c3;    ///< of s^3 [1/s^3]
    };

    /// A value at a time.
    struct ControlPoint
    {
      double t;     ///< [s]
      double value; ///< in the unit of what is driven
    };

    /// Straight lines between @p points, whose times ascend.
    static PiecewiseDrive lines(const std::vector<ControlPoint> &points);
    /// The cubic spline through @p points with continuous second derivative and slope zero at both ends.
    static PiecewiseDrive spline(const std::vector<ControlPoint> &points);
    static PiecewiseDrive constant(double value); ///< The same @p value at all times.

    /// time_tolerance() of the largest |t| of @p points.
    static double tolerance(const std::vector<ControlPoint> &points);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double t0, double t1) const override;
    bool                identically_zero() const override;

  private:
    PiecewiseDrive(const std::vector<ControlPoint> &points, const std::vector<double> &slopes_right,
                   const std::vector<double> &slopes_left);

    const Piece &piece(double t, Side side) const;
    void         find_kinks();

    std::vector<Piece>  pieces_; ///< the first reaches back to the beginning of time; its begin is the first control point
    std::vector<double> kinks_;
    double              tolerance_;
  };

  /// A phi((t - t0) / T), thesis (4.7.3): infinitely smooth, phi(x) = 1 / (1 + exp(z)), z = (1/x - 1/(1-x)) / c0 on (0, 1).
  /// Its greatest rate, at the middle, is 2 A / (c0 T) for c0 <= 2/sqrt(3).
  class SmoothStep : public Drive
  {
  public:
    /// @p duration T > 0 [s], @p shape c0 in (0, 2/sqrt(3)].
    SmoothStep(double amplitude, double start, double duration, double shape);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double, double) const override { return {}; }
    bool                identically_zero() const override { return amplitude_ == 0; }

  private:
    double amplitude_, start_, duration_, shape_;
  };

  /// A (t - t0)^n from t0 on, 0 before; thesis section 4.6 with n = 3.
  class Power : public Drive
  {
  public:
    /// @p exponent n >= 1.
    Power(double amplitude, double start, unsigned int exponent);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double t0, double t1) const override;
    bool                identically_zero() const override { return amplitude_ == 0; }

  private:
    /// The derivative of order @p order.
    double derivative(unsigned int order, double t, Side side) const;

    double       amplitude_, start_;
    unsigned int exponent_;
  };

  /// offset + A sin(2 pi f t + phase), thesis (4.7.5).
  class Sine : public Drive
  {
  public:
    /// @p frequency f > 0 [Hz], @p phase [rad].
    Sine(double amplitude, double frequency, double phase, double offset);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double, double) const override { return {}; }
    bool                identically_zero() const override { return amplitude_ == 0 && offset_ == 0; }

  private:
    double amplitude_, omega_, phase_, offset_;
  };
} // namespace myolines
