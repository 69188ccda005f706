// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <string>

namespace myolines
{
  /// Three formulas of x, y, z [m] and a fourth variable (muParser), evaluated many times: "t" [s], or "volume", the number of the
  /// physical volume.
  class VectorFormula
  {
  public:
    /// @throws std::invalid_argument if a text is not one formula, with what is wrong with it.
    explicit VectorFormula(const std::array<std::string, 3> &text, const std::string &fourth = "t");
    ~VectorFormula();
    VectorFormula(VectorFormula &&) noexcept; ///< Takes the parsers over.

    /// The value of one of the three at @p x and the fourth variable.
    double operator()(unsigned int component, const dealii::Point<3> &x, double fourth) const;
    /// True if the text of the component is "0".
    bool zero(unsigned int component) const { return text_[component] == "0"; }

  private:
    struct Parsers;
    std::array<std::string, 3> text_;
    std::unique_ptr<Parsers>   parsers_;
  };
} // namespace myolines
