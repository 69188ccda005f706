// SPDX-License-Identifier: LGPL-2.1-or-later
#include "axis.h"
#include "series_pictures.h"

#include <myolines/base/names.h>
#include <myolines/scene/formula.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/csv_table.h>
#include <myolines/study/measures.h>
#include <myolines/study/study.h>

#include <muParser.h>

#include <algorithm>
#include <stdexcept>

namespace myolines::study
{
  namespace
  {
    using scene::Node;

    template <typename Items>
    bool contains(const Items &items, const std::string &name)
    {
      return std::find(items.begin(), items.end(), name) != items.end();
    }

    /// Refuses the value @p name of @p parameter unless it is among @p known.
    void require(const Node &node, const std::string &parameter, const std::string &name, const std::vector<std::string> &known,
                 const std::string &what)
    {
      if (contains(known, name))
        return;
      node.refuse(parameter, "there is no " + what + " \"" + name + "\"", "one of " + join(known),
                  nearest_hint(name, known, "nearest valid name"));
    }

    /// Before anything is made of them.
    void refuse_too_many_cases(const Node &node)
    {
      constexpr double most  = 1e6;
      double           cases = 1;
      std::string      axes;
      for (const Node &axis : node.named())
        if (!axis.has("zipped with"))
          {
            cases *= number_of_points(axis);
            axes += (axes.empty() ? "" : " x ") + scene::format_number(number_of_points(axis)) + " (" + axis.name() + ")";
          }
      if (cases > most)
        node.refuse("", "the grid has " + axes + " = " + scene::format_number(cases) + " cases", "at most " + scene::format_number(most),
                    "fewer points, axes that are \"zipped with\" others, or several studies");
    }

    Grid read_grid(const Node &node)
    {
      refuse_too_many_cases(node);
      Grid grid{node.name(), {}};
      for (const Node &child : node.named())
        {
          Axis        axis  = read_axis(child);
          const auto &axes  = grid.axes;
          const auto  other = std::find_if(axes.begin(), axes.end(), [&axis](const Axis &a) { return a.name == axis.zipped_with; });
          if (!axis.zipped_with.empty() && (other == axes.end() || !other->zipped_with.empty()))
            child.refuse("zipped with", "there is no axis \"" + axis.zipped_with + "\" above in this grid that is crossed", "its name");
          if (!axis.zipped_with.empty() && other->points.size() != axis.points.size())
            child.refuse("zipped with",
                         "this axis has " + std::to_string(axis.points.size()) + " points, \"" + axis.zipped_with + "\" has " +
                             std::to_string(other->points.size()),
                         "two axes of as many points");
          grid.axes.push_back(std::move(axis));
        }
      if (grid.axes.empty())
        node.refuse("", "the grid has no axis", "lists with names of your choice, one for each axis");
      return grid;
    }

    Reference read_reference(const Node &node, const std::vector<std::string> &axes)
    {
      Reference reference{split(node.text("settings")), split(node.text("instead of"))};
      for (const std::string &axis : reference.instead_of)
        require(node, "instead of", axis, axes, "axis");
      return reference;
    }

    std::string checked_formula(const Node &node, const std::string &parameter)
    {
      const std::string text = node.text(parameter);
      try
        {
          VectorFormula(std::array<std::string, 3>{{text, "0", "0"}});
        }
      catch (const std::invalid_argument &error)
        {
          node.refuse(parameter, error.what(), "a formula in t, for example \"cos(2*pi*t)\"");
        }
      mu::Parser parser;
      parser.DefineConst("pi", dealii::numbers::PI);
      parser.SetExpr(text);
      for (const auto &[name, value] : parser.GetUsedVar())
        if (name != "t")
          node.refuse(parameter, "\"" + name + "\" is not known: a column is a function of time alone",
                      "a formula in t, for example \"cos(2*pi*t)\"");
      return text;
    }

    /// A file that lacks the column is told before the first run, not after the last.
    std::filesystem::path checked_reference_file(const Node &node, const Quantity &quantity)
    {
      const std::filesystem::path   file  = node.file("reference file");
      const std::optional<CsvTable> table = read_csv(file);
      if (!table)
        node.refuse("reference file", file.string() + " is no table",
                    "comma-separated values, the names of the columns in the first line, every line ended");
      for (const auto &[name, column] : quantity.columns)
        require(node, quantity.formula.empty() ? "column" : "columns", column, table->header, "column in the reference file");
      return file;
    }

    /// Formula, names and headers; a table of one row shows whether the formula can be evaluated.
    void read_formula(const Node &node, Quantity &quantity)
    {
      CsvTable table{"", {"Time [s]"}, {{"0"}}, {}, {}};
      for (const std::string &part : split(node.text("columns")))
        {
          const auto        equals = part.find('=');
          const std::string name   = scene::trimmed(part.substr(0, equals));
          if (equals == std::string::npos || name == "t" || !quantity.columns.emplace(name, scene::trimmed(part.substr(equals + 1))).second)
            node.refuse("columns", "\"" + part + "\" names no column", "NAME = HEADER, each name once and none of them t",
                        "\"total = Force [N] | passive = Passive force [N]\"");
          table.header.push_back(quantity.columns.at(name));
          table.rows.front().push_back("0");
        }
      quantity.formula = node.text("formula");
      quantity.unit    = node.text("unit");
      try
        {
          series_of_formula(table, quantity.formula, quantity.columns);
        }
      catch (const std::invalid_argument &error)
        {
          node.refuse("formula", error.what(), "a formula in the names of \"columns\" and t", "\"total - passive\"");
        }
    }

    Quantity read_column(const Node &node, Quantity quantity)
    {
      quantity.source = Quantity::Source::column;
      quantity.file   = node.text("file");
      if (node.text("type") == "formula")
        read_formula(node, quantity);
      else
        {
          quantity.column  = node.text("column");
          quantity.columns = {{quantity.column, quantity.column}};
        }
      quantity.measure  = node.text("measure");
      quantity.relative = node.boolean("relative");
      quantity.fraction = node.number("fraction");
      if (node.has("from"))
        quantity.from = node.number("from");
      if (node.has("until"))
        quantity.until = node.number("until");
      if (node.has("reference file"))
        quantity.reference_file = checked_reference_file(node, quantity);
      if (node.has("reference formula"))
        quantity.reference_formula = checked_formula(node, "reference formula");
      if (quantity.reference_file && quantity.reference_formula)
        node.refuse("reference formula", "there are two references", "a file or a formula");
      if (!quantity.is_error() && (quantity.reference_file || quantity.reference_formula))
        node.refuse("measure", "\"" + quantity.measure + "\" compares with nothing, but there is a reference",
                    "one of " + join(measure_names_with_reference()));
      if (quantity.relative && !(quantity.is_error() && quantity.measure.find("error") != std::string::npos))
        node.refuse("relative", "\"" + quantity.measure + "\" is no error", "false");
      return quantity;
    }

    Quantity read_quantity(const Node &node, const bool has_reference)
    {
      Quantity quantity;
      quantity.name          = node.name();
      const std::string type = node.text("type");
      if (type == "column" || type == "formula")
        quantity = read_column(node, quantity);
      else
        {
          quantity.source = type == "state"   ? Quantity::Source::state
                            : type == "field" ? Quantity::Source::field
                            : type == "count" ? Quantity::Source::count
                                              : Quantity::Source::seconds;
          quantity.key    = quantity.is_error() ? node.text("of") : node.text("name");
        }
      if (quantity.is_error() && !has_reference && !quantity.reference_file && !quantity.reference_formula)
        node.refuse("", "there is nothing to compare with", "a list \"reference\" in the study, or a reference file or formula here");
      return quantity;
    }

    /// Of every grid, and of every curve: points of one curve are neighbours along it.
    void require_one_accuracy_axis(const Node &node, const Study &study, const std::string &curves)
    {
      std::map<std::string, std::string> of_curve; // label -> axis
      for (const Grid &grid : study.grids)
        {
          std::vector<std::string> beside;
          for (const Axis &axis : grid.axes)
            if (axis.name != curves && axis.zipped_with.empty())
              beside.push_back(axis.name);
          if (beside.size() > 1)
            node.refuse("curves", "grid \"" + grid.name + "\" has " + std::to_string(beside.size()) + " axes beside it: " + join(beside),
                        "one along which methods become more accurate, and others only if they are zipped with it");
          for (const Axis &axis : grid.axes)
            if (axis.name == curves && !beside.empty())
              for (const AxisPoint &point : axis.points)
                if (const auto &first = of_curve.emplace(point.label, beside.front()).first->second; first != beside.front())
                  node.refuse("curves",
                              "\"" + point.label + "\" becomes more accurate along \"" + first + "\" and \"" + beside.front() + "\"",
                              "one axis for each of its points", "another name in the other grid, \"" + point.label + " by error\"");
        }
    }

    View read_view(const Node &node, const Study &study)
    {
      std::vector<std::string> quantities;
      for (const Quantity &quantity : study.quantities)
        quantities.push_back(quantity.name);
      const std::vector<std::string> axes    = study.axis_names();
      const auto                     an_axis = [&](const std::string &parameter) {
        if (!node.text(parameter).empty())
          require(node, parameter, node.text(parameter), axes, "axis");
        return node.text(parameter);
      };

      View              view;
      const std::string kind = node.text("kind");
      if (kind == "sweep")
        {
          view.curves   = an_axis("curves");
          view.abscissa = an_axis("abscissa");
          view.together = split(node.text("together"));
          for (const std::string &name : view.together)
            require(node, "together", name, quantities, "quantity");
        }
      else if (kind == "work-precision")
        {
          view.kind      = Kind::work_precision;
          view.curves    = an_axis("curves");
          view.precision = node.text("precision");
          view.work      = node.text("work");
          require(node, "precision", view.precision, quantities, "quantity");
          quantities.push_back("CPU seconds");
          require(node, "work", view.work, quantities, "quantity");
          if (node.has("target"))
            view.target = node.number("target");
          require_one_accuracy_axis(node, study, view.curves);
        }
      else if (kind == "convergence")
        {
          view.kind     = Kind::convergence;
          view.curves   = an_axis("curves");
          view.abscissa = an_axis("sizes");
          for (const Grid &grid : study.grids)
            for (const Axis &axis : grid.axes)
              for (const AxisPoint &point : axis.points)
                if (axis.name == view.abscissa && !(point.number && *point.number > 0))
                  node.refuse("sizes", "the point \"" + point.label + "\" of the axis is no size",
                              "positive numbers; groups may have such names");
        }
      else
        {
          view.kind      = Kind::stability_map;
          view.abscissa  = an_axis("abscissa");
          view.ordinate  = an_axis("ordinate");
          view.file      = node.text("file");
          view.column    = node.text("column");
          view.overshoot = node.number("overshoot limit");
          view.variation = node.number("variation limit");
          if (!study.reference)
            node.refuse("kind", "a stability map needs a reference", "a list \"reference\"");
        }
      return view;
    }
  } // namespace

  bool Quantity::is_error() const
  {
    const std::vector<std::string> compare = measure_names_with_reference();
    return source == Source::state || source == Source::field || (source == Source::column && contains(compare, measure));
  }

  std::vector<std::string> Study::axis_names() const
  {
    std::vector<std::string> names;
    for (const Grid &grid : grids)
      for (const Axis &axis : grid.axes)
        if (!contains(names, axis.name))
          names.push_back(axis.name);
    return names;
  }

  const Axis &Study::axis(const std::string &name) const
  {
    for (const Grid &grid : grids)
      for (const Axis &axis : grid.axes)
        if (axis.name == name)
          return axis;
    throw std::out_of_range("no axis " + name);
  }

  std::vector<std::string> Study::axes_along(const std::string &name) const
  {
    std::vector<std::string> names{name};
    for (const Grid &grid : grids)
      for (const Axis &axis : grid.axes)
        if (!axis.zipped_with.empty() && (contains(names, axis.name) || contains(names, axis.zipped_with)))
          for (const std::string &other : {axis.name, axis.zipped_with})
            if (!contains(names, other))
              names.push_back(other);
    return names;
  }

  std::vector<std::string> split(const std::string &text)
  {
    std::vector<std::string> parts;
    std::istringstream       stream(text);
    for (std::string part; std::getline(stream, part, '|');)
      if (part = scene::trimmed(part); !part.empty())
        parts.push_back(part);
    return parts;
  }

  scene::Node read_study_file(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    return scene::read_scene(file, study_schema(), overrides, "study");
  }

  Study read_study(const Node &node)
  {
    Study study;
    study.title         = node.text("title");
    study.scene         = node.file("scene");
    study.settings      = split(node.text("settings"));
    study.resumes       = node.text("interrupted cases") == "resume";
    study.ranks         = static_cast<unsigned int>(node.integer("ranks"));
    study.repeats       = static_cast<unsigned int>(node.integer("repeats"));
    study.case_seconds  = node.section("budget").number("case");
    study.total_seconds = node.section("budget").number("total");
    for (const Node &grid : node.section("grids").named())
      study.grids.push_back(read_grid(grid));
    if (study.grids.empty())
      node.section("grids").refuse("", "there is no grid", "lists with names of your choice, each with its axes");
    if (node.has("reference"))
      study.reference = read_reference(node.section("reference"), study.axis_names());
    if (node.has("cross check"))
      study.cross_check = read_reference(node.section("cross check"), study.axis_names());
    if (study.cross_check && !study.reference)
      node.refuse("cross check", "there is no reference to check", "a list \"reference\"");
    if (study.cross_check && study.cross_check->instead_of != study.reference->instead_of)
      node.section("cross check").refuse("instead of", "the reference replaces other axes", "the same axes in both");
    for (const Node &quantity : node.section("quantities").named())
      study.quantities.push_back(read_quantity(quantity, study.reference.has_value()));
    study.view = read_view(node, study);
    for (const Node &picture : node.section("pictures").named())
      study.pictures.push_back(read_series_picture(picture, study));
    return study;
  }
} // namespace myolines::study
