// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_sources.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/csv.h>
#include <myolines/scene/input_text.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace myolines
{
  namespace
  {
    std::vector<std::string> known_columns()
    {
      std::vector<std::string> known{"qp_x", "qp_y", "qp_z"};
      for (const PointQuantity &quantity : point_quantities())
        known.push_back(quantity.name);
      for (const char *axis : {"_x", "_y", "_z"})
        known.push_back(fibre_orientation + axis);
      return known;
    }

    void check_header(const scene::CsvTable &csv)
    {
      const auto refuse = [&](const std::string &what, const std::string &expected, const std::string &hint = "") {
        throw InputError(InputProblem{csv.file.string() + ", line 1", what, expected, hint});
      };
      const std::vector<std::string> known = known_columns();
      const std::size_t              first = csv.header.front().empty() ? 1 : 0; // a nameless first column numbers the rows
      for (auto name = csv.header.begin() + first; name != csv.header.end(); ++name)
        if (std::find(known.begin(), known.end(), *name) == known.end())
          refuse("unknown column \"" + *name + "\"", "columns of " + join(known),
                 csv.header.size() == 1 ? "columns are separated by commas, semicolons or tabs" : nearest_hint(*name, known));
      for (const char *axis : {"x", "y", "z"})
        if (!csv.column(std::string("qp_") + axis))
          refuse(std::string("the column qp_") + axis + " is missing", "qp_x, qp_y, qp_z [m]");
      int given = 0;
      for (const char *axis : {"_x", "_y", "_z"})
        given += csv.column(fibre_orientation + axis) ? 1 : 0;
      if (given != 0 && given != 3)
        refuse("the fibre orientation is incomplete", fibre_orientation + "_x, _y and _z");
      if (csv.header.size() == first + 3)
        refuse("there are places, but nothing is said of them", "at least one further column of " + join({known.begin() + 3, known.end()}));
      if (csv.rows.empty())
        throw InputError(InputProblem{csv.file.string(), "there are no points", "a header and lines of numbers, separated by commas", ""});
    }

    /// The unit of a column whose name tells none.
    std::string own_unit(const std::string &column)
    {
      return column.rfind("qp_", 0) == 0 ? "m" : column == "max_iso_stress_muscle" ? "Pa" : "-";
    }

    /// A table of points whose names have no units any more.
    struct PlacedTable
    {
      explicit PlacedTable(scene::CsvTable table, const double scale)
        : csv(std::move(table))
      {
        for (std::string &name : csv.header)
          {
            const scene::ColumnName column = scene::split_column_name(name);
            const std::string       own    = own_unit(column.quantity);
            const auto              factor = column.unit.empty() ? 1. : scene::unit_factor(column.unit, own);
            const std::string       where  = csv.file.string() + ", line 1";
            if (!factor)
              throw InputError(InputProblem{where, "the column \"" + name + "\" is in \"" + column.unit + "\"",
                                            "a unit that can be converted to " + own + ", or none", ""});
            if (own == "m" && !column.unit.empty() && scale != 1)
              throw InputError(
                  InputProblem{where, "the column \"" + name + "\" has a unit, and the scene a \"table scale\"", "one of them", ""});
            factors.push_back(*factor * (own == "m" ? scale : 1));
            name = column.quantity;
          }
      }

      std::vector<double> numbers(const std::string &column) const
      {
        const std::size_t   i = *csv.column(column);
        std::vector<double> x = csv.numbers(i);
        for (double &value : x)
          value *= factors[i];
        return x;
      }

      scene::CsvTable     csv;
      std::vector<double> factors; ///< to SI units
    };

    /// Rows of a CSV file.
    class TableSource : public PointProperties::Source
    {
    public:
      using Row = PointProperties::Row;

      explicit TableSource(const PlacedTable &table)
        : rows_(table.csv.rows.size())
      {
        const scene::CsvTable &csv = table.csv;

        file       = csv.file;
        has_fat    = csv.column("fat_fraction").has_value();
        has_matrix = csv.column("matrix_fraction").has_value();
        for (const PointQuantity &quantity : point_quantities())
          if (csv.column(quantity.name))
            fill(table, quantity);
        has_directions = csv.column(fibre_orientation + "_x").has_value();
        if (has_directions)
          fill_directions(table);
        fill_tree(table);
        std::set<unsigned int> all;
        for (const Row &row : rows_)
          if (row.tissue)
            all.insert(*row.tissue);
        tissues.assign(all.begin(), all.end());
      }

      std::pair<Row, double> nearest(const dealii::Point<3> &x) const override
      {
        std::vector<std::pair<dealii::Point<3>, unsigned int>> found;
        tree_.query(boost::geometry::index::nearest(x, 1), std::back_inserter(found));
        return {rows_[found.front().second], found.front().first.distance(x)};
      }

    private:
      void fill(const PlacedTable &table, const PointQuantity &quantity)
      {
        const std::vector<double> values = table.numbers(quantity.name);
        for (std::size_t row = 0; row < rows_.size(); ++row)
          {
            if (!quantity.range.contains(values[row]))
              throw InputError(InputProblem{table.csv.where(row), quantity.name + " is " + std::to_string(values[row]),
                                            "a number " + quantity.range.text(), ""});
            quantity.set(rows_[row], values[row]);
          }
      }

      void fill_directions(const PlacedTable &table)
      {
        std::array<std::vector<double>, 3> a;
        for (unsigned int c = 0; c < 3; ++c)
          a[c] = table.numbers(fibre_orientation + "_" + "xyz"[c]);
        for (std::size_t row = 0; row < rows_.size(); ++row)
          {
            rows_[row].direction = unit_vector({{a[0][row], a[1][row], a[2][row]}});
            if (!rows_[row].direction)
              throw InputError(InputProblem{table.csv.where(row), "the fibre orientation has length zero", "a vector", ""});
          }
      }

      void fill_tree(const PlacedTable &table)
      {
        const std::vector<double> x = table.numbers("qp_x"), y = table.numbers("qp_y"), z = table.numbers("qp_z");
        std::vector<std::pair<dealii::Point<3>, unsigned int>> places;
        for (unsigned int row = 0; row < rows_.size(); ++row)
          places.emplace_back(dealii::Point<3>(x[row], y[row], z[row]), row);
        const auto length = [](const std::vector<double> &along) {
          const auto [low, high] = std::minmax_element(along.begin(), along.end());
          return *high - *low;
        };
        extent = std::hypot(length(x), length(y), length(z));
        tree_  = dealii::pack_rtree(places);
      }

      std::vector<Row>                                         rows_;
      dealii::RTree<std::pair<dealii::Point<3>, unsigned int>> tree_;
    };
  } // namespace

  bool is_vtk(const std::filesystem::path &file)
  {
    const std::string bytes = scene::read_input_bytes(file);
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    return bytes.compare(first, 1, "<") == 0 || bytes.compare(first, 5, "# vtk") == 0;
  }

  const std::vector<PointQuantity> &point_quantities()
  {
    using Row = PointProperties::Row;
    using scene::Range;
    static const std::vector<PointQuantity> quantities{
        {"max_iso_stress_muscle", Range::not_negative(), [](Row &row, const double x) { row.stress = x; }},
        {"fat_fraction", Range::closed(0, 1), [](Row &row, const double x) { row.fat = x; }},
        {"activation_scale", Range::not_negative(), [](Row &row, const double x) { row.activation_scale = x; }},
        {"matrix_fraction", Range::closed(0, 1), [](Row &row, const double x) { row.matrix = x; }},
        {"tissue_id", Range::closed(muscle_id, CellId::n_tissues - 1), [](Row &row, const double x) { row.tissue = x; }}};
    return quantities;
  }

  std::unique_ptr<const PointProperties::Source> table_source(const std::filesystem::path &file, const double scale)
  {
    const PlacedTable table(scene::read_csv_input(file), scale);
    check_header(table.csv);
    return std::make_unique<const TableSource>(table);
  }

  PointProperties::PointProperties(const std::filesystem::path &file, const double scale)
    : source_(is_vtk(file) ? mesh_source(file, scale) : table_source(file, scale))
  {}

  PointProperties::~PointProperties() = default;

  std::pair<PointProperties::Row, double> PointProperties::nearest(const dealii::Point<3> &x) const { return source_->nearest(x); }

  bool PointProperties::has_fat() const { return source_->has_fat; }

  bool PointProperties::has_matrix() const { return source_->has_matrix; }

  bool PointProperties::has_directions() const { return source_->has_directions; }

  const std::vector<unsigned int> &PointProperties::tissues() const { return source_->tissues; }

  double PointProperties::extent() const { return source_->extent; }

  const std::filesystem::path &PointProperties::file() const { return source_->file; }
} // namespace myolines
