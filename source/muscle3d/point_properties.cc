#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/muscle3d/body_fields.h>
#include <myolines/scene/csv.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <set>

namespace myolines
{
  namespace
  {

    const std::string              fibre = "muscle_fibre_orientation_";
    const std::vector<std::string> known{"qp_x",      "qp_y",      "qp_z",         "max_iso_stress_muscle", fibre + "x",
                                         fibre + "y", fibre + "z", "fat_fraction", "activation_scale",      "matrix_fraction",
                                         "tissue_id"};

    void check_header(const scene::CsvTable &csv)
    {
      const auto refuse = [&](const std::string &what, const std::string &expected, const std::string &hint = "") {
        throw InputError(InputProblem{csv.file.string() + ", line 1", what, expected, hint});
      };
      for (const std::string &name : csv.header)
        if (std::find(known.begin(), known.end(), name) == known.end())
          refuse("unknown column \"" + name + "\"", "columns of " + join(known), nearest_hint(name, known));
      for (const char *axis : {"x", "y", "z"})
        if (!csv.column(std::string("qp_") + axis))
          refuse(std::string("the column qp_") + axis + " is missing", "qp_x, qp_y, qp_z [m]");
      const int given = (csv.column(fibre + "x") ? 1 : 0) + (csv.column(fibre + "y") ? 1 : 0) + (csv.column(fibre + "z") ? 1 : 0);
      if (given != 0 && given != 3)
        refuse("the fibre orientation is incomplete", fibre + "x, _y and _z");
      if (csv.header.size() == 3)
        refuse("there are places, but nothing is said of them", "at least one further column of " + join({known.begin() + 3, known.end()}));
      if (csv.rows.empty())
        throw InputError(InputProblem{csv.file.string(), "there are no points", "a header and lines of numbers, separated by commas", ""});
    }
  } // namespace

  struct PointProperties::Table
  {
    using Tree = dealii::RTree<std::pair<dealii::Point<3>, unsigned int>>;

    std::filesystem::path     file;
    std::vector<Row>          rows;
    bool                      has_fat, has_matrix, has_directions;
    std::vector<unsigned int> tissues;
    Tree                      tree;

    explicit Table(const scene::CsvTable &csv)
      : file(csv.file)
      , rows(csv.rows.size())
      , has_fat(csv.column("fat_fraction").has_value())
      , has_matrix(csv.column("matrix_fraction").has_value())
      , has_directions(csv.column(fibre + "x").has_value())
    {
      using scene::Range;
      fill(csv, "max_iso_stress_muscle", Range::not_negative(), [](Row &row, const double x) { row.stress = x; });
      fill(csv, "fat_fraction", Range::closed(0, 1), [](Row &row, const double x) { row.fat = x; });
      fill(csv, "activation_scale", Range::not_negative(), [](Row &row, const double x) { row.activation_scale = x; });
      fill(csv, "matrix_fraction", Range::closed(0, 1), [](Row &row, const double x) { row.matrix = x; });
      fill(csv, "tissue_id", Range::closed(muscle_id, tendon_id), [](Row &row, const double x) { row.tissue = x; });
      if (has_directions)
        fill_directions(csv);
      fill_tree(csv);
      std::set<unsigned int> all;
      for (const Row &row : rows)
        if (row.tissue)
          all.insert(*row.tissue);
      tissues.assign(all.begin(), all.end());
    }

    template <typename Set>
    void fill(const scene::CsvTable &csv, const std::string &name, const scene::Range &range, const Set &set)
    {
      const auto column = csv.column(name);
      if (!column)
        return;
      const std::vector<double> values = csv.numbers(*column);
      for (std::size_t row = 0; row < rows.size(); ++row)
        {
          if (!range.contains(values[row]))
            throw InputError(InputProblem{csv.where(row), name + " is " + std::to_string(values[row]), "a number " + range.text(), ""});
          set(rows[row], values[row]);
        }
    }

    void fill_directions(const scene::CsvTable &csv)
    {
      std::array<std::vector<double>, 3> a;
      for (unsigned int c = 0; c < 3; ++c)
        a[c] = csv.numbers(*csv.column(fibre + "xyz"[c]));
      for (std::size_t row = 0; row < rows.size(); ++row)
        {
          rows[row].direction = unit_vector({{a[0][row], a[1][row], a[2][row]}});
          if (!rows[row].direction)
            throw InputError(InputProblem{csv.where(row), "the fibre orientation has length zero", "a vector", ""});
        }
    }

    void fill_tree(const scene::CsvTable &csv)
    {
      const std::vector<double> x = csv.numbers(*csv.column("qp_x")), y = csv.numbers(*csv.column("qp_y")),
                                z = csv.numbers(*csv.column("qp_z"));
      std::vector<std::pair<dealii::Point<3>, unsigned int>> places;
      for (unsigned int row = 0; row < rows.size(); ++row)
        places.emplace_back(dealii::Point<3>(x[row], y[row], z[row]), row);
      tree = dealii::pack_rtree(places);
    }
  };

  PointProperties::PointProperties(const std::filesystem::path &file)
  {
    const scene::CsvTable csv = scene::read_csv_input(file);
    check_header(csv);
    table_ = std::make_unique<Table>(csv);
  }

  PointProperties::~PointProperties() = default;

  std::pair<const PointProperties::Row &, double> PointProperties::nearest(const dealii::Point<3> &x) const
  {
    std::vector<std::pair<dealii::Point<3>, unsigned int>> found;
    table_->tree.query(boost::geometry::index::nearest(x, 1), std::back_inserter(found));
    return {table_->rows[found.front().second], found.front().first.distance(x)};
  }

  bool PointProperties::has_fat() const { return table_->has_fat; }

  bool PointProperties::has_matrix() const { return table_->has_matrix; }

  bool PointProperties::has_directions() const { return table_->has_directions; }

  const std::vector<unsigned int> &PointProperties::tissues() const { return table_->tissues; }

  const std::filesystem::path &PointProperties::file() const { return table_->file; }
} // namespace myolines
