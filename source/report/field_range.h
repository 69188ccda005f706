// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "page.h"

#include <myolines/picture/body.h>

#include <limits>
#include <string>
#include <vector>

namespace myolines::report
{
  /// The least and the greatest value of a field over all times, and where they are.
  class FieldRange
  {
  public:
    explicit FieldRange(std::string name)
      : name_(std::move(name))
    {}

    /// Values at the points of @p body: at all, or at those in @p tissue ("muscle") alone.
    void take(const picture::Body &body, const std::vector<double> &values, const std::string &tissue = "");

    const std::string &name() const { return name_; }
    double             low() const { return low_.value; }
    double             high() const { return high_.value; }
    bool               has_values() const { return low() <= high(); }

    /// Two rows of a table: field, value, unit, tissue, time, place at rest.
    void add_rows(std::vector<Cells> &rows) const;

    /// Where the values are when they are there [m]; tissues have no least one.
    Json marks() const;

    /// Of the stretch: where fibres shorten and lengthen most. "" without values.
    std::string fibres_in_words() const;

  private:
    struct Extreme
    {
      double       value;
      picture::Vec rest, now; ///< [m]
      double       t = 0;     ///< [s]
      std::string  tissue;    ///< "" where the run does not say
    };

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    std::string name_;
    Extreme     low_{infinity, {}, {}, 0, ""}, high_{-infinity, {}, {}, 0, ""};
  };
} // namespace myolines::report
