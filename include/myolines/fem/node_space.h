// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace myolines
{
  /// Fills @p mesh with a box of size[d] [m] from the origin, cells[d] coarse cells, refined globally. Boundary ids 0..5 are
  /// the faces x-, x+, y-, y+, z-, z+.
  void make_block(dealii::parallel::distributed::Triangulation<3> &mesh, const std::array<double, 3> &size,
                  const std::array<unsigned int, 3> &cells, unsigned int refinement);

  /// Continuous Lagrange nodes of degree k on a hexahedral mesh, three displacement components each. The unknown of
  /// component c at node n has number 3 n + c, for every degree, so the components of a node always stand together.
  class NodeSpace
  {
  public:
    using Mesh = dealii::parallel::distributed::Triangulation<3>; ///< Hexahedra, spread over the ranks as a forest of octrees.
    using Cell = dealii::DoFHandler<3>::active_cell_iterator;     ///< A hexahedron of the mesh that is not refined further.

    /// A node at a vertex of a boundary face.
    using SharedNodes = std::map<dealii::types::boundary_id, dealii::types::global_dof_index>;

    /// @p mesh must outlive the space. One node of each of the boundary faces @p shared is relevant to all ranks.
    NodeSpace(const Mesh &mesh, unsigned int degree, const std::vector<dealii::types::boundary_id> &shared = {});

    const Mesh                  &mesh() const { return mesh_; }                             ///< That of the constructor.
    const dealii::DoFHandler<3> &nodes() const { return nodes_; }                           ///< One number for each node.
    MPI_Comm                     communicator() const { return nodes_.get_communicator(); } ///< The ranks that share the mesh.
    const dealii::IndexSet      &owned_unknowns() const { return owned_; }       ///< Global numbers of the unknowns of this rank.
    const dealii::IndexSet      &relevant_unknowns() const { return relevant_; } ///< Those, and the others of cells that this rank sees.
    unsigned int                 degree() const { return degree_; }              ///< k of the elements.

    /// A zero vector over all unknowns, ghosted.
    Vector make_vector() const { return Vector(partitioner_); }
    /// Which entries of a vector are owned and which are ghosts.
    const dealii::Utilities::MPI::Partitioner &partitioner() const { return *partitioner_; }

    /// Global node numbers of @p cell in lexicographic order.
    void cell_nodes(const Cell &cell, std::vector<dealii::types::global_dof_index> &numbers) const;

    /// Global numbers of the nodes on boundary face @p id that this rank owns or sees, ascending.
    std::vector<dealii::types::global_dof_index> face_nodes(dealii::types::boundary_id id) const;

    /// By boundary face, the nodes that all ranks know: of all vertices of the face that with the lowest number.
    const SharedNodes &shared_nodes() const { return shared_nodes_; }

    /// Reference position of a relevant node [m]; of a shared one only where the rank sees its cells.
    const dealii::Point<3> &node_position(dealii::types::global_dof_index node) const;

  private:
    const Mesh                                                &mesh_;
    unsigned int                                               degree_;
    dealii::FE_Q<3>                                            element_;
    dealii::DoFHandler<3>                                      nodes_;
    std::vector<unsigned int>                                  lexicographic_; ///< FE_Q number of each lexicographic node
    SharedNodes                                                shared_nodes_;
    dealii::IndexSet                                           relevant_nodes_;
    dealii::IndexSet                                           owned_, relevant_;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner_;
    std::vector<dealii::Point<3>>                              positions_;
  };
} // namespace myolines
