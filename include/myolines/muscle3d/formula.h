#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <string>

namespace myolines
{
  /// Three formulas of x, y, z [m] and t [s] (muParser), evaluated many times.
  class VectorFormula
  {
  public:
    /// @throws std::invalid_argument if a text is not one formula, with what is wrong with it.
    explicit VectorFormula(const std::array<std::string, 3> &text);
    ~VectorFormula();
    VectorFormula(VectorFormula &&) noexcept;

    double operator()(unsigned int component, const dealii::Point<3> &x, double t) const;
    /// True if the text of the component is just "0".
    bool zero(unsigned int component) const { return text_[component] == "0"; }

  private:
    struct Parsers;
    std::array<std::string, 3> text_;
    std::unique_ptr<Parsers>   parsers_;
  };
} // namespace myolines
