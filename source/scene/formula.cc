// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/formula.h>

#include <muParser.h>

#include <stdexcept>

namespace myolines
{
  struct VectorFormula::Parsers
  {
    std::array<mu::Parser, 3> parser;
    double                    x = 0, y = 0, z = 0, fourth = 0;
  };

  VectorFormula::VectorFormula(const std::array<std::string, 3> &text, const std::string &fourth)
    : text_(text)
    , parsers_(std::make_unique<Parsers>())
  {
    for (unsigned int c = 0; c < 3; ++c)
      try
        {
          mu::Parser &parser = parsers_->parser[c];
          parser.DefineVar("x", &parsers_->x);
          parser.DefineVar("y", &parsers_->y);
          parser.DefineVar("z", &parsers_->z);
          parser.DefineVar(fourth, &parsers_->fourth);
          parser.DefineConst("pi", dealii::numbers::PI);
          parser.SetExpr(text[c]);
          parser.Eval();
          if (parser.GetNumResults() != 1)
            throw std::invalid_argument("\"" + text[c] + "\" is a list, not one formula (decimal comma?)");
        }
      catch (const mu::ParserError &error)
        {
          throw std::invalid_argument("\"" + text[c] + "\" is not a formula: " + error.GetMsg());
        }
    // An assignment would have changed a variable that the others read.
    if (parsers_->x != 0 || parsers_->y != 0 || parsers_->z != 0 || parsers_->fourth != 0)
      throw std::invalid_argument("a formula assigns to x, y, z or " + fourth);
  }

  VectorFormula::~VectorFormula()                         = default;
  VectorFormula::VectorFormula(VectorFormula &&) noexcept = default;

  double VectorFormula::operator()(const unsigned int component, const dealii::Point<3> &x, const double fourth) const
  {
    parsers_->x      = x[0];
    parsers_->y      = x[1];
    parsers_->z      = x[2];
    parsers_->fourth = fourth;
    return parsers_->parser[component].Eval();
  }
} // namespace myolines
