// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/instants.h>
#include <myolines/system/sampled.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    std::vector<double> chords(const std::vector<double> &t, const std::vector<double> &x)
    {
      std::vector<double> slope;
      for (std::size_t i = 0; i + 1 < t.size(); ++i)
        slope.push_back((x[i + 1] - x[i]) / (t[i + 1] - t[i]));
      return slope;
    }

    /// Slopes at the samples of the natural spline: h_r m_l + 2 (h_l + h_r) m + h_l m_r = 3 (h_r d_l + h_l d_r) with chords d at inner
    /// samples, 2 m + m_r = 3 d_r at the first one and its mirror image at the last. Diagonally dominant.
    std::vector<double> natural_slopes(const std::vector<double> &t, const std::vector<double> &x)
    {
      const std::vector<double> d = chords(t, x);
      const std::size_t         n = t.size();
      std::vector<double>       m(n), upper(n);
      for (std::size_t i = 0; i < n; ++i)
        {
          const double left     = i == 0 ? 0 : i + 1 < n ? t[i + 1] - t[i] : 1;
          const double right    = i + 1 == n ? 0 : i > 0 ? t[i] - t[i - 1] : 1;
          const double diagonal = 2 * (left + right) - (i > 0 ? left * upper[i - 1] : 0);
          const double sum      = 3 * ((i > 0 ? left * d[i - 1] : 0) + (i + 1 < n ? right * d[i] : 0));
          upper[i]              = right / diagonal;
          m[i]                  = (sum - (i > 0 ? left * m[i - 1] : 0)) / diagonal;
        }
      for (std::size_t i = n - 1; i-- > 0;)
        m[i] -= upper[i] * m[i + 1];
      return m;
    }

    /// The weighted harmonic mean of the chords beside a sample; zero where they have not the same sign.
    std::vector<double> monotone_slopes(const std::vector<double> &t, const std::vector<double> &x)
    {
      const std::vector<double> d = chords(t, x);
      std::vector<double>       m(t.size(), 0.);
      m.front() = d.front();
      m.back()  = d.back();
      for (std::size_t i = 1; i + 1 < t.size(); ++i)
        if (d[i - 1] * d[i] > 0)
          {
            const double left = t[i] - t[i - 1], right = t[i + 1] - t[i];
            m[i] = 3 * (left + right) / ((2 * right + left) / d[i - 1] + (right + 2 * left) / d[i]);
          }
      return m;
    }
  } // namespace

  SampledDrive::SampledDrive(std::vector<double> t, std::vector<double> x, std::vector<double> begin_slope, std::vector<double> end_slope,
                             const bool smooth)
    : t_(std::move(t))
    , x_(std::move(x))
    , begin_slope_(std::move(begin_slope))
    , end_slope_(std::move(end_slope))
    , smooth_(smooth)
  {}

  SampledDrive SampledDrive::lines(const std::vector<double> &t, const std::vector<double> &x)
  {
    return {t, x, chords(t, x), chords(t, x), false};
  }

  SampledDrive SampledDrive::spline(const std::vector<double> &t, const std::vector<double> &x)
  {
    const std::vector<double> slopes = natural_slopes(t, x);
    return {t, x, {slopes.begin(), slopes.end() - 1}, {slopes.begin() + 1, slopes.end()}, true};
  }

  SampledDrive SampledDrive::monotone(const std::vector<double> &t, const std::vector<double> &x)
  {
    const std::vector<double> slopes = monotone_slopes(t, x);
    return {t, x, {slopes.begin(), slopes.end() - 1}, {slopes.begin() + 1, slopes.end()}, true};
  }

  std::optional<SampledDrive::Place> SampledDrive::place(const double t, const Side side) const
  {
    const double tolerance = time_tolerance(std::max(std::abs(begin()), std::abs(end())));
    if (!has_begun(begin(), t, side, tolerance) || has_begun(end(), t, side, tolerance))
      return std::nullopt;
    const double      shifted = side == Side::right ? t + tolerance : t - tolerance;
    const auto        next    = std::upper_bound(t_.begin() + 1, t_.end() - 1, shifted); // the intervals at both ends reach on
    const std::size_t i       = next - t_.begin() - 1;
    const Cubic       c       = cubic(i);
    return Place{c, (t - t_[i]) / c.h};
  }

  SampledDrive::Cubic SampledDrive::cubic(const std::size_t i) const
  {
    const double h = t_[i + 1] - t_[i], chord = (x_[i + 1] - x_[i]) / h, a = begin_slope_[i], b = end_slope_[i];
    return {h, x_[i], a, 3 * chord - 2 * a - b, a + b - 2 * chord};
  }

  double SampledDrive::value(const double t, const Side side) const
  {
    if (const auto at = place(t, side))
      return at->cubic.value(at->s);
    return t <= begin() ? x_.front() : x_.back();
  }

  double SampledDrive::first_derivative(const double t, const Side side) const
  {
    const auto at = place(t, side);
    return at ? at->cubic.c1 + at->s * (2 * at->cubic.c2 + at->s * 3 * at->cubic.c3) : 0;
  }

  double SampledDrive::second_derivative(const double t, const Side side) const
  {
    const auto at = place(t, side);
    return at ? (2 * at->cubic.c2 + 6 * at->s * at->cubic.c3) / at->cubic.h : 0;
  }

  std::size_t SampledDrive::n_samples(const double t0, const double t1) const
  {
    return static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(0, std::upper_bound(t_.begin(), t_.end(), t1) - std::lower_bound(t_.begin(), t_.end(), t0)));
  }

  std::vector<double> SampledDrive::kinks(const double t0, const double t1) const
  {
    std::vector<double> inside;
    if (smooth_)
      {
        for (const double t : {begin(), end()})
          if (t > t0 && t < t1)
            inside.push_back(t);
      }
    else
      inside.assign(std::upper_bound(t_.begin(), t_.end(), t0), std::lower_bound(t_.begin(), t_.end(), std::max(t0, t1)));
    return inside;
  }

  bool SampledDrive::identically_zero() const
  {
    const auto zero = [](const double x) { return x == 0; };
    return std::all_of(x_.begin(), x_.end(), zero) && std::all_of(begin_slope_.begin(), begin_slope_.end(), zero);
  }

  SampledDrive::Extremes SampledDrive::extremes() const
  {
    Extremes   all{x_.front(), x_.front()};
    const auto note = [&all](const double x) { all = {std::min(all.least, x), std::max(all.greatest, x)}; };
    for (std::size_t i = 0; i + 1 < t_.size(); ++i)
      {
        note(x_[i + 1]);
        const Cubic  c    = cubic(i);
        const double root = c.c2 * c.c2 - 3 * c.c1 * c.c3;
        if (root < 0)
          continue;
        // both roots of c1 + 2 c2 s + 3 c3 s^2, without cancellation
        const double q = -c.c2 - std::copysign(std::sqrt(root), c.c2);
        for (const double s : {q / (3 * c.c3), c.c1 / q})
          if (s > 0 && s < 1)
            note(c.value(s));
      }
    return all;
  }
} // namespace myolines
