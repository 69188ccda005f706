// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/text_file.h>

#include "point_sheets.h"

#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    std::vector<std::string> headers(const PointSheet::Names &names, const std::vector<std::string> &columns)
    {
      std::vector<std::string> all{names.abscissa};
      for (const std::string &column : columns)
        all.push_back(column + names.unit);
      return all;
    }
  } // namespace

  std::vector<double> spaced(const std::vector<double> &range, const std::string &option, const double least)
  {
    std::vector<InputProblem> problems;
    const auto   refuse = [&](const std::string &what, const std::string &expected) { problems.push_back({option, what, expected, ""}); };
    const double n      = range.at(2);
    for (const double end : {range[0], range[1]})
      if (!std::isfinite(end))
        refuse("FROM or TO = " + exact_text(end), "finite numbers");
    if (!(range[0] > least))
      refuse("FROM = " + exact_text(range[0]), "FROM > " + exact_text(least));
    if (!(range[0] < range[1]))
      refuse("FROM = " + exact_text(range[0]) + " is not below TO = " + exact_text(range[1]), "FROM < TO");
    if (!(n >= 2 && n <= 1e6) || n != std::floor(n))
      refuse("POINTS = " + exact_text(n), "POINTS, an integer in [2, 1000000]");
    if (!problems.empty())
      throw InputError(problems);
    std::vector<double> x;
    for (unsigned int i = 0; i < n; ++i)
      x.push_back(range[0] + (range[1] - range[0]) * i / (n - 1));
    return x;
  }

  std::string label_of_activation(const double activation)
  {
    std::ostringstream text;
    text << "activation " << 100 * activation << " %";
    return text.str();
  }

  PointSheet::PointSheet(const Names &names, const std::vector<std::string> &columns)
    : csv_({names.folder}, names.name + ".csv", headers(names, columns))
  {
    picture_.name    = names.name;
    picture_.title   = names.title;
    picture_.x_label = names.abscissa;
    picture_.y_label = names.ordinate;
    picture_.marks   = false;
    for (const std::string &column : columns)
      picture_.curves.push_back({column, {}});
  }

  const study::Picture &PointSheet::finish()
  {
    csv_.close();
    return picture_;
  }

  void PointSheet::row(const double x, const std::vector<double> &values)
  {
    std::vector<double> all{x};
    all.insert(all.end(), values.begin(), values.end());
    csv_.row(all);
    for (std::size_t i = 0; i < values.size(); ++i)
      picture_.curves[i].points.emplace_back(x, values[i]);
  }
} // namespace myolines
