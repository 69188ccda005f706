#include <myolines/algebra/band_matrix.h>
#include <myolines/muscle1d/sampled.h>
#include <myolines/system/instants.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace myolines
{
  SampledDrive::SampledDrive(std::vector<double> t, std::vector<double> x, std::vector<double> curvature, const bool smooth)
    : t_(std::move(t))
    , x_(std::move(x))
    , curvature_(std::move(curvature))
    , smooth_(smooth)
  {}

  SampledDrive SampledDrive::lines(const std::vector<double> &t, const std::vector<double> &x)
  {
    return {t, x, std::vector<double>(t.size(), 0.), false};
  }

  /// With Q^T x the second differences and R the matrix of hat functions of the inner samples, the curvatures there solve
  /// (R + p Q^T Q) c = Q^T x, and the values are x - p Q c.
  SampledDrive SampledDrive::spline(const std::vector<double> &t, const std::vector<double> &x, const double cut_off)
  {
    const unsigned int n = t.size();
    if (n < 3)
      return {t, x, std::vector<double>(n, 0.), true};
    const double        mean = (t.back() - t.front()) / (n - 1);
    const double        p    = std::isfinite(cut_off) ? 1 / (mean * std::pow(2 * M_PI * cut_off, 4)) : 0;
    std::vector<double> h(n - 1);
    for (unsigned int i = 0; i + 1 < n; ++i)
      h[i] = t[i + 1] - t[i];

    // row i of Q^T has the entries q[i][0..2] at i, i + 1, i + 2
    const unsigned int                 inner = n - 2;
    std::vector<std::array<double, 3>> q(inner);
    for (unsigned int i = 0; i < inner; ++i)
      q[i] = {{1 / h[i], -1 / h[i] - 1 / h[i + 1], 1 / h[i + 1]}};

    const unsigned int  width = std::min(2u, inner - 1);
    BandMatrix          matrix(inner, width);
    std::vector<double> c(inner);
    matrix.clear();
    for (unsigned int i = 0; i < inner; ++i)
      {
        c[i] = q[i][0] * x[i] + q[i][1] * x[i + 1] + q[i][2] * x[i + 2];
        for (unsigned int j = i < width ? 0 : i - width; j < std::min(inner, i + width + 1); ++j)
          {
            double sum = i == j ? (h[i] + h[i + 1]) / 3 : i + 1 == j ? h[j] / 6 : j + 1 == i ? h[i] / 6 : 0;
            for (unsigned int k = std::max(i, j); k < std::min(i, j) + 3; ++k)
              sum += p * q[i][k - i] * q[j][k - j];
            matrix(i, j) = sum;
          }
      }
    if (!matrix.factorise())
      throw std::logic_error("the matrix of a smoothing spline is singular");
    matrix.solve(c.data());

    std::vector<double> smooth = x, curvature(n, 0.);
    for (unsigned int i = 0; i < inner; ++i)
      {
        curvature[i + 1] = c[i];
        for (unsigned int k = 0; k < 3; ++k)
          smooth[i + k] -= p * q[i][k] * c[i];
      }
    return {t, smooth, curvature, true};
  }

  bool SampledDrive::interval(const double t, const Side side, std::size_t &i) const
  {
    const double tolerance = time_tolerance(std::max(std::abs(begin()), std::abs(end())));
    if (!has_begun(begin(), t, side, tolerance) || has_begun(end(), t, side, tolerance))
      return false;
    const double shifted = side == Side::right ? t + tolerance : t - tolerance;
    const auto   next    = std::upper_bound(t_.begin() + 1, t_.end() - 1, shifted); // the intervals at both ends reach on
    i                    = next - t_.begin() - 1;
    return true;
  }

  double SampledDrive::value(const double t, const Side side) const
  {
    std::size_t i = 0;
    if (!interval(t, side, i))
      return t <= begin() ? x_.front() : x_.back();
    const double h = t_[i + 1] - t_[i], s = (t - t_[i]) / h, r = 1 - s;
    return r * x_[i] + s * x_[i + 1] - h * h / 6 * s * r * ((1 + r) * curvature_[i] + (1 + s) * curvature_[i + 1]);
  }

  double SampledDrive::first_derivative(const double t, const Side side) const
  {
    std::size_t i = 0;
    if (!interval(t, side, i))
      return 0;
    const double h = t_[i + 1] - t_[i], s = (t - t_[i]) / h, r = 1 - s;
    return (x_[i + 1] - x_[i]) / h + h / 6 * ((1 - 3 * r * r) * curvature_[i] + (3 * s * s - 1) * curvature_[i + 1]);
  }

  double SampledDrive::second_derivative(const double t, const Side side) const
  {
    std::size_t i = 0;
    if (!interval(t, side, i))
      return 0;
    const double s = (t - t_[i]) / (t_[i + 1] - t_[i]);
    return (1 - s) * curvature_[i] + s * curvature_[i + 1];
  }

  std::vector<double> SampledDrive::kinks(const double t0, const double t1) const
  {
    std::vector<double> inside;
    for (const double t : t_)
      if (t > t0 && t < t1 && (!smooth_ || t == begin() || t == end()))
        inside.push_back(t);
    return inside;
  }
} // namespace myolines
