// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/coefficients.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/dirk_tables.h>
#include <myolines/time/first_step.h>
#include <myolines/time/start.h>

#include <algorithm>
#include <cmath>

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

    /// Of the lists A, b and embedded.
    DirkTable read_table(const scene::Node &node)
    {
      const ButcherTable given    = read_coefficients(node);
      constexpr double   rounding = 1e-10; // of weights with a dozen digits
      for (std::size_t i = 0; i < given.a.size(); ++i)
        if (const double diagonal = given.a[i][i]; !(diagonal > 0) && !(diagonal == 0 && i == 0))
          node.refuse("A", "the diagonal of row " + std::to_string(i + 1) + " is " + scene::format_number(diagonal),
                      "positive, or 0 in the first row: a first stage that is the beginning of the step",
                      "\"arkode\" takes explicit methods and explicit stages anywhere");
      if (given.is_explicit())
        node.refuse("A", "there is no implicit stage", "rows of a lower triangle, such as \"1/4; 1/2 1/4\", with semicolons between them",
                    "\"arkode\" takes explicit methods");
      DirkTable table{given.a};
      for (std::size_t i = 0; i < given.b.size(); ++i)
        {
          if (std::abs(given.b[i] - given.a.back()[i]) > rounding)
            node.refuse("b", "weight " + std::to_string(i + 1) + " is " + scene::format_number(given.b[i]),
                        scene::format_number(given.a.back()[i]) + ", as in the last row of \"A\": the last stage is the end of the step",
                        "\"arkode\" takes methods that are not stiffly accurate");
          if (!given.embedded.empty())
            table.error.push_back(given.a.back()[i] - given.embedded[i]);
        }
      return table;
    }

    DirkTable table_of(const scene::Node &node)
    {
      const std::string name = node.text("table");
      for (const NamedTable &table : named)
        if (name == table.name)
          {
            refuse_coefficients(node, "table", name);
            return table.make();
          }
      return read_table(node);
    }

    MethodFacts facts_of_table(const DirkTable &table)
    {
      const ButcherFacts of_table = facts_of(butcher_table(table));
      MethodFacts        facts;
      facts.name      = "runge kutta";
      facts.summary   = "Diagonally implicit Runge-Kutta method, stiffly accurate, with coefficients by name or of the scene.";
      facts.reference = "Kennedy and Carpenter, doi:10.1016/S0168-9274(02)00138-1; Hairer and Wanner, doi:10.1007/978-3-642-05221-7, IV.6";
      facts.order     = of_table.order;
      facts.stability = tell_stability(of_table);
      facts.error_exponent = of_table.embedded_order > 0 ? std::min(of_table.order, of_table.embedded_order) + 1 : 0;
      return facts;
    }
    /// Velocities of unknowns without inertia are what the formulas make of displacements: those of the step before must not grow.
    void require_bounded_velocities(const DirkTable &table, const scene::Node &node, const IntegratorContext &context)
    {
      constexpr double rounding = 1e-10;
      if (const std::string why = why_no_accelerations(context.system);
          !why.empty() && facts_of(butcher_table(table)).at_infinity > 1 + rounding)
        node.refuse("A", "with these coefficients velocities grow from step to step, as " + why,
                    "coefficients with a spectral radius at infinity of at most 1, or another method", methods_hint);
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
    entry.schema.choice(
        "table", names.front(), names,
        "Coefficients; \"own\": those of \"A\", \"b\" and \"embedded\". Without embedded formula steps by error are doubled.");
    declare_coefficients(entry.schema);
    declare_first_step(entry.schema);
    entry.facts_of_parameters = [](const scene::Node &node) { return facts_of_table(table_of(node)); };
    entry.derived             = [](const scene::Node &node) { return tell(facts_of(butcher_table(table_of(node)))); };
    entry.make                = [](const scene::Node &node, const IntegratorContext &context) {
      const DirkTable table = table_of(node);
      require_bounded_velocities(table, node, context);
      return make_dirk(table, facts_of_table(table), node, context);
    };
    return entry;
  }
} // namespace myolines
