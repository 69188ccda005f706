#pragma once

#include <myolines/system/drive.h>

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// Samples of one or more quantities at ascending times, unevenly spaced or not.
  struct Samples
  {
    std::vector<double>              t; ///< [s], at least two, strictly ascending
    std::vector<std::vector<double>> x; ///< one for each column asked for
  };

  /// Columns of a CSV file by the names in its header; other columns are ignored. @throws InputError that names the file, line and column
  /// for what is no table, an unknown column (with the nearest one), what is no number, and times that do not ascend.
  Samples read_samples(const std::filesystem::path &file, const std::string &time_column, const std::vector<std::string> &columns);

  /// A quantity between its samples. It is known between the first and the last one and constant outside.
  class SampledDrive : public Drive
  {
  public:
    /// Straight lines; every sample is a kink.
    static SampledDrive lines(const std::vector<double> &t, const std::vector<double> &x);

    /// Natural cubic smoothing spline (Reinsch, doi:10.1007/BF02162161; Green and Silverman, doi:10.1201/b15710): the function f that
    /// minimises sum (x_i - f(t_i))^2 + p int f''^2 dt; smooth everywhere inside. At @p cut_off f_c [Hz] it passes half of an
    /// oscillation, p = 1/(h (2 pi f_c)^4) with h the mean distance of samples; infinite: p = 0, through all samples.
    static SampledDrive spline(const std::vector<double> &t, const std::vector<double> &x, double cut_off);

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double t0, double t1) const override;

    double begin() const { return t_.front(); } ///< [s]
    double end() const { return t_.back(); }    ///< [s]

  private:
    SampledDrive(std::vector<double> t, std::vector<double> x, std::vector<double> curvature, bool smooth);

    /// Number of the interval that holds @p t or ends (begins) there; none outside.
    bool interval(double t, Side side, std::size_t &i) const;

    std::vector<double> t_, x_, curvature_; ///< values and second derivatives at the samples
    bool                smooth_;            ///< inside
  };
} // namespace myolines
