// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/time/dirk_facts.h>
#include <myolines/time/dirk_tables.h>
#include <myolines/time/first_step.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace myolines
{
  namespace
  {
    const std::string of_the_scene = "own";

    struct NamedTable
    {
      const char *name;
      DirkTable (*make)();
    };
    constexpr NamedTable named[] = {{"esdirk3", esdirk3_table}, {"esdirk4", esdirk4_table}};

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
          const double diagonal = a.back().back();
          if (!(diagonal > 0) && !(diagonal == 0 && a.size() == 1))
            node.refuse("A", "the diagonal of row " + std::to_string(a.size()) + " is " + scene::format_number(diagonal),
                        "positive, or 0 in the first row: a first stage that is the beginning of the step",
                        "\"arkode\" has explicit methods");
        }
      if (a.empty() || a.back().size() < (a[0][0] == 0 ? 2 : 1))
        node.refuse("A", "there is no implicit stage", "rows of a lower triangle, such as \"1/4; 1/2 1/4\", with semicolons between them");
      return a;
    }

    /// Of the lists A and embedded.
    DirkTable read_table(const scene::Node &node)
    {
      constexpr double rounding = 1e-10;
      DirkTable        table{read_rows(node)};
      const auto       sum = [](const std::vector<double> &row) {
        double all = 0;
        for (const double x : row)
          all += x;
        return all;
      };
      if (std::abs(sum(table.a.back()) - 1) > rounding)
        node.refuse("A", "the last row adds up to " + scene::format_number(sum(table.a.back())),
                    "1: the last stage is the end of the step (stiffly accurate methods)");
      const std::vector<double> embedded = read_row(node, "embedded", node.text("embedded"));
      if (embedded.empty())
        return table;
      if (embedded.size() != table.a.size() || std::abs(sum(embedded) - 1) > rounding)
        node.refuse("embedded", std::to_string(embedded.size()) + " weights that add up to " + scene::format_number(sum(embedded)),
                    std::to_string(table.a.size()) + " weights, one of each stage, that add up to 1");
      for (std::size_t i = 0; i < embedded.size(); ++i)
        table.error.push_back(table.a.back()[i] - embedded[i]);
      return table;
    }

    DirkTable table_of(const scene::Node &node)
    {
      const std::string name = node.text("table");
      for (const NamedTable &table : named)
        if (name == table.name)
          {
            for (const char *other : {"A", "embedded"})
              if (!node.text(other).empty())
                node.refuse(other, "is not looked at, as the table is \"" + name + "\"", "nothing, or \"own\" as \"table\"");
            return table.make();
          }
      return read_table(node);
    }

    MethodFacts facts_of_table(const DirkTable &table)
    {
      const DirkFacts of_table = facts_of(table);
      MethodFacts     facts;
      facts.name      = "runge kutta";
      facts.summary   = "Diagonally implicit Runge-Kutta method, stiffly accurate, with coefficients by name or of the scene.";
      facts.reference = "Kennedy and Carpenter, doi:10.1016/S0168-9274(02)00138-1; Hairer and Wanner, doi:10.1007/978-3-642-05221-7, IV.6";
      facts.order     = of_table.order;
      facts.stability = tell(of_table)[1];
      facts.error_exponent = of_table.embedded_order > 0 ? std::min(of_table.order, of_table.embedded_order) + 1 : 0;
      return facts;
    }
  } // namespace

  IntegratorEntry runge_kutta_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts_of_table(named[0].make());
    entry.schema = scene::Schema(entry.facts.summary);
    std::vector<std::string> names;
    for (const NamedTable &table : named)
      names.emplace_back(table.name);
    names.push_back(of_the_scene);
    entry.schema.choice("table", names.front(), names, "Coefficients; \"own\": those of \"A\" and \"embedded\".")
        .text("A", "",
              "Rows of the lower triangle, with semicolons between them: \"0; 1/4 1/4\". The last one has the weights of the method.")
        .text("embedded", "",
              "Weights of the method beside it, for example \"1/2 1/2\", whose difference is the estimated error; without them steps are "
              "doubled.");
    declare_first_step(entry.schema);
    entry.facts_of_parameters = [](const scene::Node &node) { return facts_of_table(table_of(node)); };
    entry.derived             = [](const scene::Node &node) { return tell(facts_of(table_of(node))); };
    entry.make                = [](const scene::Node &node, const IntegratorContext &context) {
      const DirkTable table = table_of(node);
      return make_dirk(table, facts_of_table(table), node, context);
    };
    return entry;
  }
} // namespace myolines
