// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/cell_batches.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/full_matrix.h>

#include <map>

namespace myolines
{
  namespace
  {
    /// Ten numbers of the map from the unit cube at every Gauss point of a cell: inverse Jacobian, determinant.
    struct CellMap
    {
      CellMap(dealii::FEValues<3> &values, const NodeSpace::Cell &cell)
      {
        values.reinit(typename dealii::Triangulation<3>::active_cell_iterator(cell));
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          {
            for (int k = 0; k < 9; ++k)
              entries.push_back(values.inverse_jacobian(q)[k / 3][k % 3]);
            entries.push_back(values.jacobian(q).determinant());
          }
      }

      bool affine() const
      {
        double scale = 0;
        for (int k = 0; k < 9; ++k)
          scale = std::max(scale, std::abs(entries[k]));
        for (std::size_t i = 10; i < entries.size(); ++i)
          if (std::abs(entries[i] - entries[i % 10]) > 1e-11 * (i % 10 < 9 ? scale : entries[9]))
            return false;
        return true;
      }

      std::vector<double> entries;
    };
  } // namespace

  CellBatches::CellBatches(const NodeSpace &space, const Element &element)
    : n_nodes_(element.n_nodes)
    , n_modes_(element.n_modes)
  {
    std::map<dealii::types::material_id, std::vector<NodeSpace::Cell>> owned, ghosts;
    for (const NodeSpace::Cell &cell : space.nodes().active_cell_iterators())
      if (cell->is_locally_owned())
        owned[cell->material_id()].push_back(cell);
      else if (cell->is_ghost())
        ghosts[cell->material_id()].push_back(cell);
    const dealii::MappingQ1<3> mapping;
    const dealii::FE_Q<3>      any(1);
    dealii::FEValues<3>        values(mapping, any, dealii::QGauss<3>(element.n_points_1d),
                                      dealii::update_inverse_jacobians | dealii::update_jacobians);
    for (const auto &[id, cells] : owned)
      add_batches(cells, space, element, values);
    n_owned_ = n_batches();
    for (const auto &[id, cells] : ghosts)
      add_batches(cells, space, element, values);
  }

  void CellBatches::add_batches(const std::vector<NodeSpace::Cell> &cells, const NodeSpace &space, const Element &element,
                                dealii::FEValues<3> &values)
  {
    std::vector<dealii::types::global_dof_index> numbers;
    for (std::size_t first = 0; first < cells.size(); first += n_lanes)
      {
        Batch batch{cells_.size(), static_cast<unsigned int>(std::min<std::size_t>(n_lanes, cells.size() - first)), true, 0};
        nodes_.resize(nodes_.size() + std::size_t(n_nodes_) * n_lanes);
        unsigned int *nodes = &nodes_[nodes_.size() - std::size_t(n_nodes_) * n_lanes];
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            cells_.push_back(cells[first + std::min(lane, batch.n_filled - 1)]);
            space.cell_nodes(cells_.back(), numbers);
            for (int i = 0; i < n_nodes_; ++i)
              nodes[i * n_lanes + lane] = space.partitioner().global_to_local(3 * numbers[i]) / 3;
          }
        add_geometry(batch, element, values);
        batches_.push_back(batch);
      }
  }

  void CellBatches::add_geometry(Batch &batch, const Element &element, dealii::FEValues<3> &values)
  {
    std::vector<CellMap> maps;
    maps.reserve(n_lanes);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        maps.emplace_back(values, cells_[batch.first_cell + lane]);
        batch.affine = batch.affine && maps.back().affine();
      }

    const int n_entries = batch.affine ? 1 : element.n_points;
    batch.geometry      = geometry_.size();
    geometry_.resize(geometry_.size() + std::size_t(n_entries) * 10 * n_lanes);
    mode_mass_.resize(mode_mass_.size() + std::size_t(n_modes_) * n_modes_ * n_lanes);
    double *geometry = &geometry_[batch.geometry];
    double *mass     = &mode_mass_[mode_mass_.size() - std::size_t(n_modes_) * n_modes_ * n_lanes];

    dealii::FullMatrix<double> matrix(n_modes_, n_modes_);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        for (int q = 0; q < n_entries; ++q)
          for (int k = 0; k < 10; ++k)
            geometry[(q * 10 + k) * n_lanes + lane] = maps[lane].entries[q * 10 + k];
        matrix = 0;
        for (int q = 0; q < element.n_points; ++q)
          for (int i = 0; i < n_modes_; ++i)
            for (int j = 0; j < n_modes_; ++j)
              matrix(i, j) += element.weights_3d[q] * maps[lane].entries[q * 10 + 9] * element.modes[q * n_modes_ + i] *
                              element.modes[q * n_modes_ + j];
        matrix.gauss_jordan();
        for (int i = 0; i < n_modes_; ++i)
          for (int j = 0; j < n_modes_; ++j)
            mass[(i * n_modes_ + j) * n_lanes + lane] = matrix(i, j);
      }
  }

  dealii::Point<3> point_position(const Element &element, const NodeSpace::Cell &cell, const int q)
  {
    const int              n = element.n_points_1d;
    const dealii::Point<3> unit(element.point[q % n], element.point[(q / n) % n], element.point[q / (n * n)]);
    dealii::Point<3>       x;
    for (const unsigned int v : cell->vertex_indices())
      x += dealii::GeometryInfo<3>::d_linear_shape_function(unit, v) * cell->vertex(v);
    return x;
  }

  std::size_t CellBatches::memory() const
  {
    return nodes_.size() * sizeof(unsigned int) + (geometry_.size() + mode_mass_.size()) * sizeof(double) +
           cells_.size() * sizeof(NodeSpace::Cell);
  }
} // namespace myolines
