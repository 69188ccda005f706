// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/drive_types.h>
#include <myolines/system/instants.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    using Points = std::vector<PiecewiseDrive::ControlPoint>;

    double chord(const Points &p, const std::size_t i) { return (p[i + 1].value - p[i].value) / (p[i + 1].t - p[i].t); }

    /// Slopes at the points of the clamped spline: (1/h_l) m_l + 2 (1/h_l + 1/h_r) m + (1/h_r) m_r = 3 (s_l/h_l + s_r/h_r)
    /// at inner points with chords s; diagonally dominant, so elimination without pivoting is stable.
    std::vector<double> spline_slopes(const Points &p)
    {
      const std::size_t   n = p.size();
      std::vector<double> slope(n, 0.), upper(n, 0.);
      for (std::size_t i = 1; i + 1 < n; ++i)
        {
          const double left     = 1 / (p[i].t - p[i - 1].t);
          const double right    = 1 / (p[i + 1].t - p[i].t);
          const double diagonal = 2 * (left + right) - left * upper[i - 1];
          upper[i]              = right / diagonal;
          slope[i]              = (3 * (left * chord(p, i - 1) + right * chord(p, i)) - left * slope[i - 1]) / diagonal;
        }
      for (std::size_t i = n - 1; i-- > 1;)
        slope[i] -= upper[i] * slope[i + 1];
      return slope;
    }
  } // namespace

  PiecewiseDrive::PiecewiseDrive(const std::vector<ControlPoint> &p, const std::vector<double> &slopes_right,
                                 const std::vector<double> &slopes_left)
    : tolerance_(tolerance(p))
  {
    pieces_.push_back({p.front().t, p.front().value, 0, 0, 0});
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
      {
        const double h = p[i + 1].t - p[i].t, s = chord(p, i), a = slopes_right[i], b = slopes_left[i + 1];
        pieces_.push_back({p[i].t, p[i].value, a, (3 * s - 2 * a - b) / h, (a + b - 2 * s) / (h * h)});
      }
    pieces_.push_back({p.back().t, p.back().value, 0, 0, 0});
    find_kinks();
  }

  PiecewiseDrive PiecewiseDrive::lines(const std::vector<ControlPoint> &points)
  {
    std::vector<double> right(points.size(), 0.), left(points.size(), 0.);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      right[i] = left[i + 1] = chord(points, i);
    return PiecewiseDrive(points, right, left);
  }

  PiecewiseDrive PiecewiseDrive::spline(const std::vector<ControlPoint> &points)
  {
    const std::vector<double> slopes = spline_slopes(points);
    return PiecewiseDrive(points, slopes, slopes);
  }

  PiecewiseDrive PiecewiseDrive::constant(const double value) { return lines({{0, value}}); }

  double PiecewiseDrive::tolerance(const std::vector<ControlPoint> &points)
  {
    return time_tolerance(std::max(std::abs(points.front().t), std::abs(points.back().t)));
  }

  /// Piece k covers the time from its begin to the next begin. Near a begin the side decides.
  const PiecewiseDrive::Piece &PiecewiseDrive::piece(const double t, const Side side) const
  {
    const double shifted = side == Side::right ? t + tolerance_ : t - tolerance_;
    const auto   next =
        std::upper_bound(pieces_.begin() + 1, pieces_.end(), shifted, [](const double time, const Piece &p) { return time < p.begin; });
    return *(next - 1);
  }

  double PiecewiseDrive::value(const double t, const Side side) const
  {
    const Piece &p = piece(t, side);
    const double s = t - p.begin;
    return p.c0 + s * (p.c1 + s * (p.c2 + s * p.c3));
  }

  double PiecewiseDrive::first_derivative(const double t, const Side side) const
  {
    const Piece &p = piece(t, side);
    const double s = t - p.begin;
    return p.c1 + s * (2 * p.c2 + s * 3 * p.c3);
  }

  double PiecewiseDrive::second_derivative(const double t, const Side side) const
  {
    const Piece &p = piece(t, side);
    return 2 * p.c2 + 6 * p.c3 * (t - p.begin);
  }

  void PiecewiseDrive::find_kinks()
  {
    double steepest = 0, sharpest = 0;
    for (const Piece &p : pieces_)
      {
        steepest = std::max(steepest, std::abs(first_derivative(p.begin, Side::right)));
        sharpest = std::max(sharpest,
                            std::max(std::abs(second_derivative(p.begin, Side::left)), std::abs(second_derivative(p.begin, Side::right))));
      }
    for (std::size_t i = 1; i < pieces_.size(); ++i)
      {
        // smaller jumps are rounding in the slopes of points given in decimals
        const double t = pieces_[i].begin;
        if (std::abs(first_derivative(t, Side::right) - first_derivative(t, Side::left)) > 1e-9 * steepest ||
            std::abs(second_derivative(t, Side::right) - second_derivative(t, Side::left)) > 1e-9 * sharpest)
          kinks_.push_back(t);
      }
  }

  std::vector<double> PiecewiseDrive::kinks(const double t0, const double t1) const
  {
    std::vector<double> inside;
    for (const double t : kinks_)
      if (t > t0 + tolerance_ && t < t1 - tolerance_)
        inside.push_back(t);
    return inside;
  }

  bool PiecewiseDrive::identically_zero() const
  {
    return std::all_of(pieces_.begin(), pieces_.end(), [](const Piece &p) { return p.c0 == 0 && p.c1 == 0 && p.c2 == 0 && p.c3 == 0; });
  }
} // namespace myolines
