// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/current_ghosts.h>
#include <myolines/measures/marker_probe.h>

#include <myolines/muscle3d/body_measures.h>
#include <myolines/muscle3d/discretisation.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>

namespace myolines
{
  /// Where a marker sits: unknowns of the nodes of its cell and their shape values there.
  struct MarkerProbe::Place
  {
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<double>                          weights;
  };

  namespace
  {
    std::string extent(const Geometry &geometry)
    {
      const dealii::BoundingBox<3> box(corners(geometry));
      std::ostringstream           text;
      text << "the body reaches from (" << box.get_boundary_points().first << ") to (" << box.get_boundary_points().second << ") m";
      return text.str();
    }
  } // namespace

  MarkerProbe::MarkerProbe(const Muscle3dSystem &system, std::vector<Marker> markers, const std::string &where)
    : system_(system)
    , markers_(std::move(markers))
  {
    const NodeSpace                &space = *system.discretisation().space;
    const dealii::FiniteElement<3> &fe    = space.nodes().get_fe();
    const dealii::MappingQ1<3>      mapping;
    std::vector<InputProblem>       problems;
    for (const Marker &marker : markers_)
      {
        std::shared_ptr<Place> place;
        unsigned int           owner = std::numeric_limits<unsigned int>::max();
        const auto [cell, unit]      = dealii::GridTools::find_active_cell_around_point(mapping, space.nodes(), marker.position, {}, 1e-9);
        if (cell.state() == dealii::IteratorState::valid && cell->is_locally_owned())
          {
            owner = dealii::Utilities::MPI::this_mpi_process(space.communicator());
            place = std::make_shared<Place>();
            place->nodes.resize(fe.n_dofs_per_cell());
            cell->get_dof_indices(place->nodes);
            const dealii::Point<3> inside = dealii::GeometryInfo<3>::project_to_unit_cell(unit);
            for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
              place->weights.push_back(fe.shape_value(i, inside));
          }
        // A marker on the border of two ranks belongs to the lower one.
        const unsigned int lowest = dealii::Utilities::MPI::min(owner, space.communicator());
        if (lowest == std::numeric_limits<unsigned int>::max())
          {
            std::ostringstream position;
            position << marker.position;
            problems.push_back({where, "marker \"" + marker.name + "\" at (" + position.str() + ") m lies outside the body",
                                "a point of the reference body", extent(system.parameters().geometry)});
          }
        places_.push_back(lowest == owner ? place : nullptr);
      }
    if (!problems.empty())
      throw InputError(problems);
  }

  std::vector<dealii::Tensor<1, 3>> MarkerProbe::values(const Vector &x) const
  {
    const CurrentGhosts               ghosted(x);
    const Vector                     &u = ghosted.vector();
    std::vector<dealii::Tensor<1, 3>> result(markers_.size());
    for (std::size_t m = 0; m < markers_.size(); ++m)
      {
        if (places_[m])
          for (std::size_t i = 0; i < places_[m]->nodes.size(); ++i)
            for (unsigned int c = 0; c < 3; ++c)
              result[m][c] += places_[m]->weights[i] * u(3 * places_[m]->nodes[i] + c);
        for (unsigned int c = 0; c < 3; ++c)
          result[m][c] = dealii::Utilities::MPI::sum(result[m][c], u.get_mpi_communicator());
      }
    return result;
  }
} // namespace myolines
