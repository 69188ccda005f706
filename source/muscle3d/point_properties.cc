#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/muscle3d/body_fields.h>
#include <myolines/scene/numbers.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace myolines
{
  namespace
  {
    using Point = dealii::Point<3>;

    const std::vector<std::string> known{"qp_x",
                                         "qp_y",
                                         "qp_z",
                                         "max_iso_stress_muscle",
                                         "muscle_fibre_orientation_x",
                                         "muscle_fibre_orientation_y",
                                         "muscle_fibre_orientation_z",
                                         "fat_fraction",
                                         "activation_scale",
                                         "tissue_id"};

    std::vector<std::string> cells_of(const std::string &line)
    {
      std::vector<std::string> cells;
      std::istringstream       stream(line);
      for (std::string cell; std::getline(stream, cell, ',');)
        cells.push_back(scene::trimmed(cell));
      return cells;
    }
  } // namespace

  struct PointProperties::Table
  {
    using Tree = dealii::RTree<std::pair<Point, unsigned int>>;

    std::filesystem::path                      file;
    std::map<std::string, std::vector<double>> columns;
    std::vector<unsigned int>                  tissues;
    Tree                                       tree;

    std::pair<Point, unsigned int> nearest(const Point &x) const
    {
      std::vector<std::pair<Point, unsigned int>> found;
      tree.query(boost::geometry::index::nearest(x, 1), std::back_inserter(found));
      return found.front();
    }

    const std::vector<double> *column(const std::string &name) const
    {
      const auto found = columns.find(name);
      return found == columns.end() ? nullptr : &found->second;
    }

    [[noreturn]] void refuse(const std::string &where, const std::string &what, const std::string &expected) const
    {
      throw InputError(InputProblem{file.string() + where, what, expected, ""});
    }

    void read()
    {
      std::ifstream stream(file);
      std::string   line;
      if (!stream || !std::getline(stream, line))
        refuse("", "the file cannot be read", "a header and lines of numbers, separated by commas");
      const std::vector<std::string> header = cells_of(line);
      check_header(header);
      std::vector<std::vector<double>> values(header.size());
      for (unsigned int number = 2; std::getline(stream, line); ++number)
        {
          if (scene::trimmed(line).empty())
            continue;
          const std::vector<std::string> cells = cells_of(line);
          if (cells.size() != header.size())
            refuse(", line " + std::to_string(number), std::to_string(cells.size()) + " values",
                   std::to_string(header.size()) + ", as in the header");
          for (std::size_t c = 0; c < cells.size(); ++c)
            {
              const auto value = scene::parse_number(cells[c]);
              if (!value)
                refuse(", line " + std::to_string(number), "\"" + cells[c] + "\" is not a finite number", "a number for " + header[c]);
              values[c].push_back(*value);
            }
        }
      for (std::size_t c = 0; c < header.size(); ++c)
        columns[header[c]] = std::move(values[c]);
      if (columns["qp_x"].empty())
        refuse("", "there are no points", "a header and lines of numbers, separated by commas");
    }

    void check_header(const std::vector<std::string> &header) const
    {
      for (const std::string &name : header)
        if (std::find(known.begin(), known.end(), name) == known.end())
          throw InputError(InputProblem{file.string() + ", line 1", "unknown column \"" + name + "\"", "columns of " + join(known),
                                        "nearest: \"" + nearest_name(name, known) + "\""});
      const auto has = [&](const std::string &name) { return std::find(header.begin(), header.end(), name) != header.end(); };
      for (const char *axis : {"x", "y", "z"})
        if (!has(std::string("qp_") + axis))
          refuse(", line 1", std::string("the column qp_") + axis + " is missing", "qp_x, qp_y, qp_z [m]");
      const std::string fibre = "muscle_fibre_orientation_";
      if (has(fibre + "x") != has(fibre + "y") || has(fibre + "x") != has(fibre + "z"))
        refuse(", line 1", "the fibre orientation is incomplete", fibre + "x, _y and _z");
    }

    void check_range(const std::string &name, const scene::Range &range) const
    {
      if (const std::vector<double> *values = column(name))
        for (std::size_t row = 0; row < values->size(); ++row)
          if (!range.contains((*values)[row]))
            refuse(", row " + std::to_string(row + 1), name + " is " + std::to_string((*values)[row]), "a number " + range.text());
    }

    std::array<double, 3> direction(const std::size_t row) const
    {
      std::array<double, 3> a;
      double                square = 0;
      for (unsigned int c = 0; c < 3; ++c)
        {
          a[c] = (*column("muscle_fibre_orientation_" + std::string(1, "xyz"[c])))[row];
          square += a[c] * a[c];
        }
      if (!(square > 0))
        refuse(", row " + std::to_string(row + 1), "the fibre orientation has length zero", "a vector");
      for (double &x : a)
        x /= std::sqrt(square);
      return a;
    }

    void check() const
    {
      check_range("max_iso_stress_muscle", scene::Range::not_negative());
      check_range("fat_fraction", scene::Range::closed(0, 1));
      check_range("activation_scale", scene::Range::not_negative());
      check_range("tissue_id", scene::Range::closed(muscle_id, tendon_id));
      if (column("muscle_fibre_orientation_x") != nullptr)
        for (std::size_t row = 0; row < columns.at("qp_x").size(); ++row)
          direction(row);
    }
  };

  PointProperties::PointProperties(const std::filesystem::path &file)
    : table_(std::make_unique<Table>())
  {
    table_->file = file;
    table_->read();
    table_->check();
    std::vector<std::pair<Point, unsigned int>> places;
    const auto                                 &columns = table_->columns;
    for (unsigned int row = 0; row < columns.at("qp_x").size(); ++row)
      places.emplace_back(Point(columns.at("qp_x")[row], columns.at("qp_y")[row], columns.at("qp_z")[row]), row);
    table_->tree = dealii::pack_rtree(places);
    if (const auto *ids = table_->column("tissue_id"))
      {
        const std::set<unsigned int> all(ids->begin(), ids->end());
        table_->tissues.assign(all.begin(), all.end());
      }
  }

  PointProperties::~PointProperties() = default;

  double PointProperties::distance(const Point &x) const { return table_->nearest(x).first.distance(x); }

  bool PointProperties::has_fat() const { return table_->column("fat_fraction") != nullptr; }

  const std::vector<unsigned int> &PointProperties::tissues() const { return table_->tissues; }

  const std::filesystem::path &PointProperties::file() const { return table_->file; }

  unsigned int PointProperties::apply(const Point &x, const std::map<unsigned int, TissueParameters> &tissues, unsigned int material_id,
                                      TissueParameters &tissue, double &activation_scale) const
  {
    const std::size_t row = table_->nearest(x).second;
    if (const auto *ids = table_->column("tissue_id"); ids != nullptr && (*ids)[row] != material_id)
      {
        material_id = static_cast<unsigned int>((*ids)[row]);
        tissue      = tissues.at(material_id);
      }
    if (table_->column("muscle_fibre_orientation_x") != nullptr)
      tissue.fibre.direction = table_->direction(row);
    if (material_id != muscle_id)
      return material_id;
    if (const auto *stress = table_->column("max_iso_stress_muscle"))
      tissue.fibre.sigma0 = (*stress)[row];
    if (const auto *fat = table_->column("fat_fraction"))
      tissue.fat.fraction = (*fat)[row];
    if (const auto *scale = table_->column("activation_scale"))
      activation_scale *= (*scale)[row];
    return material_id;
  }
} // namespace myolines
