// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_sampler.h"
#include "point_sources.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace myolines
{
  namespace
  {
    using Field = PlainMesh::Field;

    bool is_direction(const Field &field)
    {
      static const std::vector<std::string> names{fibre_orientation, "fibre",  "fibres",          "fibre_direction", "fibre direction",
                                                  "fiber",           "fibers", "fiber_direction", "fiber direction"};
      return field.n_components == 3 && std::find(names.begin(), names.end(), field.name) != names.end();
    }

    std::array<double, 3> vector_at(const Field &field, const std::size_t row)
    {
      return {{field.values[3 * row], field.values[3 * row + 1], field.values[3 * row + 2]}};
    }

    /// Arrays of a mesh.
    class MeshSource : public PointProperties::Source
    {
    public:
      using Row = PointProperties::Row;

      MeshSource(const std::filesystem::path &of_file, const PlainMesh &mesh)
        : sampler_(mesh)
      {
        file   = of_file;
        extent = sampler_.size();
        std::set<unsigned int> all;
        for (const bool of_cells : {true, false})
          for (const Field &field : of_cells ? mesh.cell_fields : mesh.point_fields)
            {
              if (is_direction(field))
                {
                  (of_cells ? cell_directions_ : point_directions_) = field;
                  has_directions                                    = true;
                }
              for (const PointQuantity &quantity : point_quantities())
                if (field.name == quantity.name && field.n_components == 1)
                  {
                    check(field, quantity);
                    (of_cells ? cell_numbers_ : point_numbers_).push_back({&quantity, field});
                    has_fat    = has_fat || field.name == "fat_fraction";
                    has_matrix = has_matrix || field.name == "matrix_fraction";
                    if (field.name == "tissue_id")
                      for (const double id : field.values)
                        all.insert(static_cast<unsigned int>(id));
                  }
            }
        tissues.assign(all.begin(), all.end());
        refuse_nothing(mesh);
      }

      std::pair<Row, double> nearest(const dealii::Point<3> &x) const override
      {
        const MeshSampler::Place place = sampler_.at(x);
        Row                      row;
        for (const auto &[quantity, field] : cell_numbers_)
          quantity->set(row, field.values[place.cell]);
        for (const auto &[quantity, field] : point_numbers_)
          quantity->set(row, field.name == "tissue_id" ? field.values[strongest(place)] : interpolated(field, place));
        if (cell_directions_)
          row.direction = unit_vector(vector_at(*cell_directions_, place.cell));
        if (point_directions_)
          row.direction = direction(*point_directions_, place);
        return {row, place.distance};
      }

    private:
      void check(const Field &field, const PointQuantity &quantity) const
      {
        for (std::size_t i = 0; i < field.values.size(); ++i)
          if (!quantity.range.contains(field.values[i]) || (field.name == "tissue_id" && field.values[i] != std::floor(field.values[i])))
            throw InputError(InputProblem{
                file.string(), "row " + std::to_string(i) + " of the array \"" + field.name + "\" is " + std::to_string(field.values[i]),
                "a number " + quantity.range.text(), ""});
      }

      void refuse_nothing(const PlainMesh &mesh) const
      {
        if (cell_directions_ || point_directions_ || !cell_numbers_.empty() || !point_numbers_.empty())
          return;
        std::vector<std::string> known{fibre_orientation + " (three components)"}, there;
        for (const PointQuantity &quantity : point_quantities())
          known.push_back(quantity.name);
        for (const auto *fields : {&mesh.cell_fields, &mesh.point_fields})
          for (const Field &field : *fields)
            there.push_back(field.name + " (" + std::to_string(field.n_components) + ")");
        throw InputError(InputProblem{file.string(),
                                      "no array of the mesh says anything of the muscle: it has " + (there.empty() ? "none" : join(there)),
                                      "one of " + join(known), ""});
      }

      static unsigned int strongest(const MeshSampler::Place &place)
      {
        return place.points[std::max_element(place.weights.begin(), place.weights.end()) - place.weights.begin()];
      }

      static double interpolated(const Field &field, const MeshSampler::Place &place)
      {
        double value = 0;
        for (unsigned int i = 0; i < 4; ++i)
          value += place.weights[i] * field.values[place.points[i]];
        return value;
      }

      /// Fibres have no sign: all are turned to the side of that of the point with the largest weight.
      static std::optional<std::array<double, 3>> direction(const Field &field, const MeshSampler::Place &place)
      {
        const std::array<double, 3> first = vector_at(field, strongest(place));
        std::array<double, 3>       sum{};
        for (unsigned int i = 0; i < 4; ++i)
          if (const auto one = unit_vector(vector_at(field, place.points[i])))
            {
              const double side = (*one)[0] * first[0] + (*one)[1] * first[1] + (*one)[2] * first[2];
              for (unsigned int c = 0; c < 3; ++c)
                sum[c] += (side < 0 ? -1 : 1) * place.weights[i] * (*one)[c];
            }
        return unit_vector(sum);
      }

      MeshSampler                                          sampler_;
      std::optional<Field>                                 cell_directions_, point_directions_;
      std::vector<std::pair<const PointQuantity *, Field>> cell_numbers_, point_numbers_;
    };
  } // namespace

  std::unique_ptr<const PointProperties::Source> mesh_source(const std::filesystem::path &file, const double scale)
  {
    const PlainMesh mesh = scaled(read_mesh(file), scale);
    if (mesh.cells.empty())
      throw InputError(InputProblem{file.string(), "the mesh has no cells", "a mesh with arrays of its cells or points", ""});
    return std::make_unique<const MeshSource>(file, mesh);
  }
} // namespace myolines
