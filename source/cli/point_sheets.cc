#include <myolines/base/error.h>

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
    const double n = range.at(2);
    if (!(range[0] < range[1]) || !(range[0] > least) || n < 2 || n != std::floor(n) || n > 1e6)
      throw InputError(InputProblem{option, "no range", "FROM TO POINTS with FROM < TO and 2 to 1000000 points", ""});
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

  void PointSheet::row(const double x, const std::vector<double> &values)
  {
    std::vector<double> all{x};
    all.insert(all.end(), values.begin(), values.end());
    csv_.row(all);
    for (std::size_t i = 0; i < values.size(); ++i)
      picture_.curves[i].points.emplace_back(x, values[i]);
  }
} // namespace myolines
