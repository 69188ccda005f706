// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/coefficients.h>
#include <myolines/scene/numbers.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// "0.25", "1/4", "-3/8"; nothing for what is neither.
    std::optional<double> coefficient(const std::string &text)
    {
      const std::size_t bar = text.find('/');
      if (bar == std::string::npos)
        return scene::parse_number(text);
      const auto above = scene::parse_number(text.substr(0, bar)), below = scene::parse_number(text.substr(bar + 1));
      return above && below && *below != 0 ? std::optional<double>(*above / *below) : std::nullopt;
    }

    std::vector<double> read_row(const scene::Node &node, const std::string &parameter, const std::string &text)
    {
      std::vector<double> row;
      std::istringstream  words(text);
      for (std::string word; words >> word;)
        {
          const std::optional<double> value = coefficient(word);
          if (!value || !std::isfinite(*value))
            node.refuse(parameter, "\"" + word + "\" is no coefficient", "numbers or fractions such as 1/4, with blanks between them");
          row.push_back(*value);
        }
      return row;
    }

    std::vector<std::vector<double>> read_rows(const scene::Node &node)
    {
      std::vector<std::vector<double>> a;
      std::istringstream               rows(node.text("A"));
      for (std::string text; std::getline(rows, text, ';');)
        {
          a.push_back(read_row(node, "A", text));
          if (a.back().size() != a.size())
            node.refuse("A", "row " + std::to_string(a.size()) + " has " + std::to_string(a.back().size()) + " coefficients",
                        std::to_string(a.size()) + ": a row ends with its diagonal, as a stage needs no later one");
        }
      return a;
    }

    double sum_of(const std::vector<double> &row) { return std::accumulate(row.begin(), row.end(), 0.); }

    constexpr double weight_rounding = 1e-10; ///< of weights with a dozen digits

    std::vector<double> read_weights(const scene::Node &node, const std::string &parameter, const std::size_t stages)
    {
      const std::vector<double> weights = read_row(node, parameter, node.text(parameter));
      if (!weights.empty() && (weights.size() != stages || std::abs(sum_of(weights) - 1) > weight_rounding))
        node.refuse(parameter, std::to_string(weights.size()) + " weights that add up to " + scene::format_number(sum_of(weights)),
                    std::to_string(stages) + " weights, one of each stage, that add up to 1");
      return weights;
    }
  } // namespace

  void declare_coefficients(scene::Schema &schema)
  {
    schema
        .text("A", "",
              "Of an own table: rows of the lower triangle, each ending with its diagonal, with semicolons between them: \"0; 1/4 1/4\".")
        .text("b", "", "Of an own table: weights of the method, \"1/2 1/2\"; without them the last row of A.")
        .text("embedded", "", "Of an own table: weights of a formula beside it, whose difference is the estimated error: \"1 0\".");
  }

  ButcherTable read_coefficients(const scene::Node &node)
  {
    ButcherTable table;
    table.a = read_rows(node);
    if (table.a.empty())
      node.refuse("A", "there are no coefficients", "rows of a lower triangle, such as \"1/4; 1/2 1/4\", with semicolons between them");
    table.b = read_weights(node, "b", table.a.size());
    if (table.b.empty())
      {
        table.b = table.a.back();
        if (std::abs(sum_of(table.b) - 1) > weight_rounding)
          node.refuse("A", "the last row adds up to " + scene::format_number(sum_of(table.b)),
                      "1, as without \"b\" the last stage is the end of the step");
      }
    table.embedded = read_weights(node, "embedded", table.a.size());
    if (std::equal(table.b.begin(), table.b.end(), table.embedded.begin(), table.embedded.end(),
                   [](const double one, const double other) { return std::abs(one - other) < weight_rounding; }))
      node.refuse("embedded", "these are the weights of the method, so that the estimated error is always 0",
                  "weights of another formula, of lower order",
                  "without \"embedded\" steps by error are doubled where the method allows it");
    return table;
  }

  void refuse_coefficients(const scene::Node &node, const std::string &choice, const std::string &name)
  {
    for (const char *other : {"A", "b", "embedded"})
      if (!node.text(other).empty())
        node.refuse(other, "is not looked at, as \"" + choice + "\" is \"" + name + "\"", "nothing, or \"own\" as \"" + choice + "\"");
  }
} // namespace myolines
