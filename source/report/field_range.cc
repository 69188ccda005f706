// SPDX-License-Identifier: LGPL-2.1-or-later
#include "field_range.h"
#include "reports.h"

#include <myolines/measures/fields.h>

#include <cmath>

namespace myolines::report
{
  namespace
  {
    using picture::Body;
    using picture::Vec;

    /// "12.3, 0, -5": millimetres.
    std::string place_text(const Vec &x)
    {
      return number_text(1e3 * x[0]) + ", " + number_text(1e3 * x[1]) + ", " + number_text(1e3 * x[2]);
    }

    /// The tissue at a point; "" where the run did not write it.
    std::string tissue_at(const Body &body, const std::size_t p)
    {
      const picture::Field *tissue = body.find("tissue");
      if (tissue == nullptr || !std::isfinite(tissue->values[p]))
        return "";
      const long number = std::lround(tissue->values[p]);
      return number == 1 ? "muscle" : number == 2 ? "aponeurosis" : number == 3 ? "tendon" : "tissue " + std::to_string(number);
    }
  } // namespace

  void FieldRange::take(const Body &body, const std::vector<double> &values, const std::string &tissue)
  {
    for (std::size_t p = 0; p < values.size(); ++p)
      {
        if (!(values[p] < low()) && !(values[p] > high()))
          continue;
        const Extreme here{values[p], body.rest[p], body.now[p], body.t, tissue_at(body, p)};
        if (!tissue.empty() && here.tissue != tissue)
          continue;
        if (values[p] < low())
          low_ = here;
        if (values[p] > high())
          high_ = here;
      }
  }

  void FieldRange::add_rows(std::vector<Cells> &rows) const
  {
    for (const auto &[words, extreme] : {std::pair<const char *, const Extreme &>{", least", low_}, {", greatest", high_}})
      rows.push_back(
          {name_ + words, number_text(extreme.value), field_unit(name_), extreme.tissue, number_text(extreme.t), place_text(extreme.rest)});
  }

  Json FieldRange::marks() const
  {
    Json marks = Json::array();
    if (name_ != "tissue")
      for (const Vec *x : {&low_.now, &high_.now})
        marks.push_back({(*x)[0], (*x)[1], (*x)[2]});
    return marks;
  }

  std::string FieldRange::fibres_in_words() const
  {
    if (!has_values())
      return "";
    const auto at = [](const Extreme &extreme) {
      return " at x, y, z = " + place_text(extreme.rest) + " mm (at rest), to a stretch of " + number_text(extreme.value) +
             " at t = " + number_text(extreme.t) + " s";
    };
    return std::string("Fibres of the muscle ") + (low() < 1 ? "shorten most" : "lengthen least") + at(low_) + ", and " +
           (high() > 1 ? "lengthen most" : "shorten least") + at(high_) + ".";
  }
} // namespace myolines::report
