// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/node_space.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

namespace myolines
{
  namespace
  {
    /// Every node becomes three unknowns.
    dealii::IndexSet unknowns_of(const dealii::IndexSet &nodes)
    {
      dealii::IndexSet unknowns(3 * nodes.size());
      for (auto range = nodes.begin_intervals(); range != nodes.end_intervals(); ++range)
        unknowns.add_range(3 * *range->begin(), 3 * (range->last() + 1));
      unknowns.compress();
      return unknowns;
    }
  } // namespace

  void make_block(dealii::parallel::distributed::Triangulation<3> &mesh, const std::array<double, 3> &size,
                  const std::array<unsigned int, 3> &cells, const unsigned int refinement)
  {
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {cells[0], cells[1], cells[2]}, dealii::Point<3>(),
                                                      dealii::Point<3>(size[0], size[1], size[2]), /*colorize*/ true);
    mesh.refine_global(refinement);
  }

  namespace
  {
    dealii::types::global_dof_index lowest_vertex(const dealii::DoFHandler<3> &nodes, const dealii::types::boundary_id id)
    {
      auto lowest = nodes.n_dofs();
      for (const NodeSpace::Cell &cell : nodes.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() == id)
              for (unsigned int v = 0; v < 4; ++v)
                lowest = std::min(lowest, face->vertex_dof_index(v, 0));
      return dealii::Utilities::MPI::min(lowest, nodes.get_communicator());
    }
  } // namespace

  NodeSpace::NodeSpace(const Mesh &mesh, const unsigned int degree, const std::vector<dealii::types::boundary_id> &shared)
    : mesh_(mesh)
    , degree_(degree)
    , element_(degree)
    , nodes_(mesh)
    , lexicographic_(dealii::FETools::lexicographic_to_hierarchic_numbering<3>(degree))
  {
    nodes_.distribute_dofs(element_);
    dealii::DoFTools::extract_locally_relevant_dofs(nodes_, relevant_nodes_);
    for (const auto face : shared)
      {
        shared_nodes_[face] = lowest_vertex(nodes_, face);
        relevant_nodes_.add_index(shared_nodes_[face]);
      }
    relevant_nodes_.compress();
    owned_       = unknowns_of(nodes_.locally_owned_dofs());
    relevant_    = unknowns_of(relevant_nodes_);
    partitioner_ = std::make_shared<const dealii::Utilities::MPI::Partitioner>(owned_, relevant_, communicator());

    std::map<dealii::types::global_dof_index, dealii::Point<3>> support;
    dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<3>(), nodes_, support);
    positions_.resize(relevant_nodes_.n_elements());
    for (const auto &[node, position] : support)
      positions_[relevant_nodes_.index_within_set(node)] = position;
  }

  void NodeSpace::cell_nodes(const Cell &cell, std::vector<dealii::types::global_dof_index> &numbers) const
  {
    std::vector<dealii::types::global_dof_index> hierarchic(element_.n_dofs_per_cell());
    cell->get_dof_indices(hierarchic);
    numbers.resize(hierarchic.size());
    for (unsigned int i = 0; i < numbers.size(); ++i)
      numbers[i] = hierarchic[lexicographic_[i]];
  }

  std::vector<dealii::types::global_dof_index> NodeSpace::face_nodes(const dealii::types::boundary_id id) const
  {
    dealii::IndexSet                             found(nodes_.n_dofs());
    std::vector<dealii::types::global_dof_index> numbers(element_.n_dofs_per_face());
    for (const Cell &cell : nodes_.active_cell_iterators())
      if (!cell->is_artificial())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == id)
            {
              face->get_dof_indices(numbers);
              found.add_indices(numbers.begin(), numbers.end());
            }
    std::vector<dealii::types::global_dof_index> list;
    found.fill_index_vector(list);
    return list;
  }

  const dealii::Point<3> &NodeSpace::node_position(const dealii::types::global_dof_index node) const
  {
    return positions_[relevant_nodes_.index_within_set(node)];
  }
} // namespace myolines
