// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/integrators/coefficients.h>
#include <myolines/integrators/sundials_arkode_tables.h>
#include <myolines/integrators/sundials_tools.h>
#include <myolines/scene/numbers.h>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>

namespace myolines
{
  namespace
  {
    const std::string none = "none", of_the_scene = "own", prefix = "ARKODE_";

    using Table = std::unique_ptr<ARKodeButcherTableMem, void (*)(ARKodeButcherTable)>;

    /// With the orders that ARKODE finds, up to 6.
    Table table_of(const ButcherTable &own)
    {
      const std::size_t   n = own.b.size();
      std::vector<double> a(n * n), b = own.b, c(n), embedded = own.embedded;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          {
            a[i * n + j] = own.a[i][j];
            c[i] += own.a[i][j];
          }
      Table table(
          ARKodeButcherTable_Create(static_cast<int>(n), 0, 0, c.data(), a.data(), b.data(), embedded.empty() ? nullptr : embedded.data()),
          ARKodeButcherTable_Free);
      int order = 0, embedded_order = 0;
      if (ARKodeButcherTable_CheckOrder(table.get(), &order, &embedded_order, nullptr) < -1)
        throw std::logic_error("ARKODE does not take a table of coefficients");
      table->q = order;
      table->p = embedded.empty() ? 0 : embedded_order;
      return table;
    }

    Table load(const ArkodeTables &tables)
    {
      if (tables.own)
        return table_of(*tables.own);
      return {tables.implicit ? ARKodeButcherTable_LoadDIRKByName((prefix + *tables.implicit).c_str())
                              : ARKodeButcherTable_LoadERKByName((prefix + *tables.explicit_).c_str()),
              ARKodeButcherTable_Free};
    }

    std::vector<std::string> with_none_and_own(std::vector<std::string> names)
    {
      names.insert(names.begin(), none);
      names.push_back(of_the_scene);
      return names;
    }

    /// The coefficients of the scene, for the table that is @p implicit or not.
    ButcherTable own_table(const scene::Node &integrator, const bool implicit)
    {
      ButcherTable table = read_coefficients(integrator);
      for (std::size_t i = 0; i < table.a.size(); ++i)
        if (const double diagonal = table.a[i][i]; implicit ? !(diagonal >= 0) : diagonal != 0)
          integrator.refuse("A", "the diagonal of row " + std::to_string(i + 1) + " is " + scene::format_number(diagonal),
                            implicit ? "positive, or 0 for an explicit stage"
                                     : "0: stages of an explicit method need none but earlier ones");
      if (implicit && table.is_explicit())
        integrator.refuse("A", "there is no implicit stage", "a diagonal that is not 0 in all rows",
                          "an explicit method is an \"explicit table\", with \"implicit table\" = \"none\"");
      return table;
    }
  } // namespace

  int ArkodeTables::order() const { return load(*this)->q; }
  int ArkodeTables::embedded_order() const { return load(*this)->p; }
  int ArkodeTables::stages() const { return load(*this)->stages; }

  void ArkodeTables::set(void *memory) const
  {
    if (!own)
      {
        require_success(ARKStepSetTableName(memory, (prefix + implicit.value_or("DIRK_NONE")).c_str(),
                                            (prefix + explicit_.value_or("ERK_NONE")).c_str()),
                        "ARKStepSetTableName");
        return;
      }
    const Table table = load(*this); // of which ARKODE makes a copy
    require_success(ARKStepSetTables(memory, table->q, table->p, implicit ? table.get() : nullptr, implicit ? nullptr : table.get()),
                    "ARKStepSetTables");
  }

  double ArkodeTables::stable_step(const double stiffness, const double rates) const
  {
    using Complex         = std::complex<double>;
    const Table table     = load(*this);
    const auto  amplifies = [&](const Complex z) {
      std::vector<Complex> stages;
      Complex              end = 1;
      for (int i = 0; i < table->stages; ++i)
        {
          Complex stage = 1;
          for (int j = 0; j < i; ++j)
            stage += z * table->A[i][j] * stages[j];
          stages.push_back(stage);
          end += z * table->b[i] * stage;
        }
      return std::abs(end) > 1 + 1e-6;
    };
    const Complex root    = std::sqrt(Complex(rates * rates - 4 * stiffness));
    const Complex fastest = (-rates - root) / 2., other = (-rates + root) / 2.;
    if (fastest == 0.)
      return std::numeric_limits<double>::infinity();
    constexpr double first = 1e-3, last = 1e2, ratio = 1.01; // of the fastest mode
    double           part = first;
    while (part < last && !amplifies(part / std::abs(fastest) * fastest) && !amplifies(part / std::abs(fastest) * other))
      part *= ratio;
    return part / ratio / std::abs(fastest);
  }

  const std::vector<std::string> &arkode_implicit_tables()
  {
    static const std::vector<std::string> names = {"SDIRK_2_1_2",
                                                   "BILLINGTON_3_3_2",
                                                   "TRBDF2_3_3_2",
                                                   "KVAERNO_4_2_3",
                                                   "ARK324L2SA_DIRK_4_2_3",
                                                   "CASH_5_2_4",
                                                   "CASH_5_3_4",
                                                   "SDIRK_5_3_4",
                                                   "KVAERNO_5_3_4",
                                                   "ARK436L2SA_DIRK_6_3_4",
                                                   "KVAERNO_7_4_5",
                                                   "ARK548L2SA_DIRK_8_4_5",
                                                   "ARK437L2SA_DIRK_7_3_4",
                                                   "ARK548L2SAb_DIRK_8_4_5",
                                                   "ESDIRK324L2SA_4_2_3",
                                                   "ESDIRK325L2SA_5_2_3",
                                                   "ESDIRK32I5L2SA_5_2_3",
                                                   "ESDIRK436L2SA_6_3_4",
                                                   "ESDIRK43I6L2SA_6_3_4",
                                                   "QESDIRK436L2SA_6_3_4",
                                                   "ESDIRK437L2SA_7_3_4",
                                                   "ESDIRK547L2SA_7_4_5",
                                                   "ESDIRK547L2SA2_7_4_5"};
    return names;
  }

  const std::vector<std::string> &arkode_explicit_tables()
  {
    static const std::vector<std::string> names = {
        "HEUN_EULER_2_1_2",   "BOGACKI_SHAMPINE_4_2_3", "ARK324L2SA_ERK_4_2_3", "ZONNEVELD_5_3_4",      "ARK436L2SA_ERK_6_3_4",
        "SAYFY_ABURUB_6_3_4", "CASH_KARP_6_4_5",        "FEHLBERG_6_4_5",       "DORMAND_PRINCE_7_4_5", "ARK548L2SA_ERK_8_4_5",
        "VERNER_8_5_6",       "FEHLBERG_13_7_8",        "KNOTH_WOLKE_3_3",      "ARK437L2SA_ERK_7_3_4", "ARK548L2SAb_ERK_8_4_5"};
    return names;
  }

  const std::vector<std::pair<std::string, std::string>> &arkode_additive_pairs()
  {
    static const std::vector<std::pair<std::string, std::string>> pairs = {{"ARK324L2SA_DIRK_4_2_3", "ARK324L2SA_ERK_4_2_3"},
                                                                           {"ARK436L2SA_DIRK_6_3_4", "ARK436L2SA_ERK_6_3_4"},
                                                                           {"ARK437L2SA_DIRK_7_3_4", "ARK437L2SA_ERK_7_3_4"},
                                                                           {"ARK548L2SA_DIRK_8_4_5", "ARK548L2SA_ERK_8_4_5"},
                                                                           {"ARK548L2SAb_DIRK_8_4_5", "ARK548L2SAb_ERK_8_4_5"}};
    return pairs;
  }

  void declare_arkode_tables(scene::Schema &schema)
  {
    schema
        .choice("implicit table", "ESDIRK325L2SA_5_2_3", with_none_and_own(arkode_implicit_tables()),
                "Diagonally implicit Runge-Kutta method; the last numbers of a name are stages, order of the error estimate, order; "
                "\"own\": that of \"A\".")
        .choice("explicit table", none, with_none_and_own(arkode_explicit_tables()),
                "Explicit Runge-Kutta method; with an implicit one of the same name: the additive method, which needs \"split\"; "
                "\"own\": that of \"A\".");
    declare_coefficients(schema);
    schema
        .optional_text("split", "What an additive method treats implicitly, for example \"linear\"; a name that the system does not know "
                                "is answered with those that it does.")
        .boolean("force", false, "Runs a split that is known not to converge, and explicit steps that are not stable, too.")
        .integer(
            "most explicit steps", 1000000, scene::Range::closed(1, 2000000000),
            "Explicit steps chosen by error are never longer than the stable one, as estimated; refused if that makes more of them up to "
            "the next event or the end.");
  }

  ArkodeTables arkode_tables(const scene::Node &integrator)
  {
    ArkodeTables tables;
    if (integrator.text("implicit table") != none)
      tables.implicit = integrator.text("implicit table");
    if (integrator.text("explicit table") != none)
      tables.explicit_ = integrator.text("explicit table");
    if (!tables.implicit && !tables.explicit_)
      integrator.refuse("implicit table", "there is neither an implicit nor an explicit table", "at least one of them");
    if (tables.additive())
      {
        std::vector<std::string> pairs;
        for (const auto &[implicit, explicit_] : arkode_additive_pairs())
          pairs.push_back(implicit + " with " + explicit_);
        if (std::find(arkode_additive_pairs().begin(), arkode_additive_pairs().end(), std::pair(*tables.implicit, *tables.explicit_)) ==
            arkode_additive_pairs().end())
          integrator.refuse("explicit table", "the two tables do not belong together", "one of " + join(pairs));
        if (!integrator.has("split"))
          integrator.refuse("explicit table", "an additive method needs to know what is implicit", "a \"split\"");
      }
    const bool implicit = tables.implicit == of_the_scene;
    if (implicit || tables.explicit_ == of_the_scene)
      tables.own = own_table(integrator, implicit);
    else
      refuse_coefficients(integrator, tables.implicit ? "implicit table" : "explicit table",
                          tables.implicit ? *tables.implicit : *tables.explicit_);
    if (tables.order() < 2)
      integrator.refuse(tables.own ? "A" : (tables.implicit ? "implicit table" : "explicit table"),
                        "the method is of order 1, and ARKODE makes no accelerations of steps of order 1", "a method of order 2 or more",
                        "\"backward euler\", and \"runge kutta\" with implicit tables of order 1");
    if (!tables.additive() && integrator.has("split"))
      integrator.refuse("split", "only an additive method, with two tables, splits the forces", "no \"split\"",
                        "--unset integrator/split leaves it out");
    return tables;
  }

  ArkodeTables arkode_tables(const scene::Node &integrator, const SemiDiscreteSystem &system)
  {
    const ArkodeTables tables = arkode_tables(integrator);
    if (!tables.additive())
      return tables;
    std::vector<std::string> names;
    for (const Split &split : system.capabilities().splits)
      {
        names.push_back(split.name);
        if (split.name != integrator.text("split"))
          continue;
        if (!split.refused.empty() && !integrator.boolean("force"))
          integrator.refuse("split", split.refused, "another split", "\"force\" = true runs it all the same");
        return tables;
      }
    integrator.refuse("split", "the system has no split of that name", names.empty() ? "a system with splits" : "one of " + join(names));
  }
} // namespace myolines
