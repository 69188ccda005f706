// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_sampler.h"
#include "point_sources.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/body/motion_file.h>
#include <myolines/meshes/field_grid.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/csv.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace myolines
{
  namespace
  {
    constexpr std::array<const char *, 2> quantities{{"displacement", "velocity"}};
    constexpr std::array<const char *, 2> units{{"m", "m/s"}};
  } // namespace

  /// Where motions come from.
  class MotionFile::Source
  {
  public:
    virtual ~Source() = default;

    /// What there is for @p x, and how far from there [m].
    virtual std::pair<Row, double> nearest(const dealii::Point<3> &x) const = 0;

    std::array<bool, 2> has{};      ///< displacements, velocities
    double              extent = 0; ///< diagonal of the box around what it knows [m]

  protected:
    static std::array<double, 3> &part(Row &row, const std::size_t quantity) { return quantity == 0 ? row.displacement : row.velocity; }
  };

  namespace
  {
    using Source = MotionFile::Source;
    using Row    = MotionFile::Row;

    [[noreturn]] void refuse(const std::filesystem::path &file, const std::string &what, const std::string &expected)
    {
      throw InputError(InputProblem{file.string(), what, expected, ""});
    }

    /// The k^3 hexahedra between the points of each cell of degree k, with the fields of the points.
    PlainMesh divided(const FieldGrid &grid)
    {
      PlainMesh mesh;
      mesh.points       = grid.points;
      mesh.point_fields = grid.fields;
      for (const std::vector<unsigned int> &cell : grid.cells)
        {
          const auto n     = static_cast<unsigned int>(std::lround(std::cbrt(cell.size())));
          const auto point = [&](const unsigned int i, const unsigned int j, const unsigned int k) { return cell[i + n * (j + n * k)]; };
          for (unsigned int k = 0; k + 1 < n; ++k)
            for (unsigned int j = 0; j + 1 < n; ++j)
              for (unsigned int i = 0; i + 1 < n; ++i)
                mesh.cells.push_back({PlainMesh::Shape::hexahedron,
                                      0,
                                      {{point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k), point(i, j + 1, k), point(i, j, k + 1),
                                        point(i + 1, j, k + 1), point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)}}});
        }
      return mesh;
    }

    PlainMesh read_motion_mesh(const std::filesystem::path &file, const double scale)
    {
      PlainMesh mesh = read_mesh(file);
      if (mesh.straightened > 0 && file.extension() == ".vtu")
        mesh = divided(read_field_grid(file));
      if (mesh.cells.empty())
        refuse(file, "the mesh has no cells", "a mesh with arrays of its points");
      return scaled(std::move(mesh), scale);
    }

    class MotionMesh : public Source
    {
    public:
      MotionMesh(const std::filesystem::path &file, const double scale)
        : MotionMesh(file, scale, read_motion_mesh(file, scale))
      {}

      std::pair<Row, double> nearest(const dealii::Point<3> &x) const override
      {
        const MeshSampler::Place place = sampler_.at(x);
        Row                      row;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          if (has[q])
            for (unsigned int i = 0; i < 4; ++i)
              for (unsigned int c = 0; c < 3; ++c)
                part(row, q)[c] += place.weights[i] * values_[q][3 * place.points[i] + c];
        return {row, place.distance};
      }

    private:
      MotionMesh(const std::filesystem::path &file, const double scale, const PlainMesh &mesh)
        : sampler_(mesh)
      {
        extent = sampler_.size();
        std::vector<std::string> there;
        for (const PlainMesh::Field &field : mesh.point_fields)
          {
            there.push_back("\"" + field.name + "\" (" + std::to_string(field.n_components) + ")");
            for (std::size_t q = 0; q < quantities.size(); ++q)
              if (field.n_components == 3 && scene::lower_case(field.name) == quantities[q])
                {
                  has[q]     = true;
                  values_[q] = field.values;
                  for (double &value : values_[q])
                    value *= scale;
                  if (!std::all_of(values_[q].begin(), values_[q].end(), [](const double value) { return std::isfinite(value); }))
                    refuse(file, "the array \"" + field.name + "\" holds something that is no finite number", "numbers");
                }
          }
        if (!has[0] && !has[1])
          refuse(file, "no array of the points tells a motion: there " + (there.empty() ? "is none" : "are " + join(there)),
                 "\"displacement\" or \"velocity\" with three components");
      }

      MeshSampler                        sampler_;
      std::array<std::vector<double>, 2> values_; ///< [points][3]
    };

    class MotionTable : public Source
    {
    public:
      MotionTable(const std::filesystem::path &file, const double scale)
        : table_(scene::read_csv_input(file))
        , scale_(scale)
      {
        std::array<std::vector<double>, 3> x;
        for (unsigned int c = 0; c < 3; ++c)
          x[c] = column(std::string(1, "xyz"[c]), "m");
        rows_.resize(x[0].size());
        for (std::size_t q = 0; q < quantities.size(); ++q)
          read(q);
        if (!has[0] && !has[1])
          refuse(file, "the table tells no motion", "columns \"displacement x\", ... or \"velocity x\", ...");
        if (rows_.empty())
          refuse(file, "there are no points", "a header and lines of numbers, separated by commas");
        std::vector<std::pair<dealii::Point<3>, unsigned int>> places;
        dealii::Point<3>                                       low(x[0][0], x[1][0], x[2][0]), high = low;
        for (unsigned int row = 0; row < rows_.size(); ++row)
          {
            places.emplace_back(dealii::Point<3>(x[0][row], x[1][row], x[2][row]), row);
            for (unsigned int c = 0; c < 3; ++c)
              {
                low[c]  = std::min(low[c], x[c][row]);
                high[c] = std::max(high[c], x[c][row]);
              }
          }
        extent = low.distance(high);
        tree_  = dealii::pack_rtree(places);
      }

      std::pair<Row, double> nearest(const dealii::Point<3> &x) const override
      {
        std::vector<std::pair<dealii::Point<3>, unsigned int>> found;
        tree_.query(boost::geometry::index::nearest(x, 1), std::back_inserter(found));
        return {rows_[found.front().second], found.front().first.distance(x)};
      }

    private:
      void read(const std::size_t quantity)
      {
        const std::string name = quantities[quantity];
        for (unsigned int c = 0; c < 3; ++c)
          has[quantity] = has[quantity] || find(name + " " + "xyz"[c]);
        if (!has[quantity])
          return;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const std::vector<double> values = column(name + " " + "xyz"[c], units[quantity]);
            for (std::size_t row = 0; row < rows_.size(); ++row)
              part(rows_[row], quantity)[c] = values[row];
          }
      }

      std::optional<std::size_t> find(const std::string &name) const
      {
        const std::vector<std::size_t> found = scene::matching_columns(name, table_.header);
        return found.empty() ? std::nullopt : std::optional<std::size_t>(found.front());
      }

      /// In SI units.
      std::vector<double> column(const std::string &name, const std::string &unit) const
      {
        const std::optional<std::size_t> at = find(name);
        if (!at)
          throw InputError(
              InputProblem{table_.file.string() + ", line 1", "the column \"" + name + "\" is missing",
                           "x, y, z and \"displacement x\", \"displacement y\", \"displacement z\" or the same of \"velocity\"", ""});
        const std::string   own    = scene::split_column_name(table_.header[*at]).unit;
        const auto          factor = own.empty() ? std::optional<double>(scale_) : scene::unit_factor(own, unit);
        std::vector<double> values = table_.numbers(*at);
        if (!factor || (!own.empty() && scale_ != 1))
          throw InputError(InputProblem{table_.file.string() + ", line 1", "the column \"" + name + "\" is in \"" + own + "\"",
                                        factor ? "either units in the table or \"file scale\"" : "a unit that can be converted to " + unit,
                                        ""});
        for (double &value : values)
          value *= *factor;
        return values;
      }

      const scene::CsvTable                                    table_;
      const double                                             scale_;
      std::vector<Row>                                         rows_;
      dealii::RTree<std::pair<dealii::Point<3>, unsigned int>> tree_;
    };
  } // namespace

  MotionFile::MotionFile(const std::filesystem::path &file, const double scale)
    : file_(file)
  {
    if (is_vtk(file))
      source_ = std::make_unique<const MotionMesh>(file, scale);
    else
      source_ = std::make_unique<const MotionTable>(file, scale);
  }

  MotionFile::~MotionFile() = default;

  bool MotionFile::has_displacement() const { return source_->has[0]; }

  bool MotionFile::has_velocity() const { return source_->has[1]; }

  std::pair<MotionFile::Row, double> MotionFile::nearest(const dealii::Point<3> &x) const { return source_->nearest(x); }

  void MotionFile::check_distance(const dealii::Point<3> &x, const double distance) const
  {
    if (distance <= 1e-5 * source_->extent)
      return;
    std::ostringstream what;
    what << "nothing is said of the node at (" << x << ") m: the nearest place is " << distance << " m away";
    throw InputError(InputProblem{file_.string(), what.str(), "a mesh that covers the body at rest, or a table with a row for every node",
                                  "a \"file scale\" if the lengths in the file are not in metres"});
  }
} // namespace myolines
