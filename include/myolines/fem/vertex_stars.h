// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/interpolation.h>
#include <myolines/algebra/patch_matrices.h>
#include <myolines/fem/block_matrix.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <map>
#include <memory>
#include <set>

namespace myolines
{
  /// Coarsening of a space of degree k to degree 1 on the same mesh, from element matrices alone:
  ///
  /// - the star of a vertex is the set of free unknowns inside the cells around it: of its own node and of the nodes on
  ///   edges, faces and cells that touch it. On a regular mesh of degree 2 these are 27 nodes. Every cell that reaches an
  ///   unknown of a star touches the vertex, so the principal submatrix is a sum of corners of element matrices;
  /// - the coarse matrix is P^T J P with P the interpolation from degree 1.
  ///
  /// Unknowns that depend on others of their own node (a plane of any direction) are eliminated from the stars. One that others at
  /// other nodes depend on (a face that moves as one) is in no star: the coarse level alone moves it.
  ///
  /// A rank holds the stars of the vertices that it owns; the cells around them are its own or its ghosts.
  class VertexStars
  {
  public:
    /// What constrains the coarse space; by default its unknowns are constrained where the fine ones at their vertices are.
    using Constrain = std::function<Constraints(const NodeSpace &coarse)>;

    /// Finds stars and places of entries; matrices are zero. References outlive the object. Collective.
    VertexStars(const NodeSpace &space, const CellBatches &batches, const Element &element, const Constraints &constraints,
                const Constrain &constrain_coarse = {}, InstructionSet instruction_set = widest_instruction_set());

    /// Sets all matrices to zero.
    void clear();

    /// Adds the element matrices of batch @p b (layout of BlockMatrix::add), owned and ghost batches alike.
    void add(unsigned int b, const double *element_matrices);

    /// After all batches. Collective.
    void finish() { coarse_matrix_->finish(); }

    PatchMatrices       &patches() { return *patches_; }                            ///< One matrix for each star of this rank.
    const Interpolation &interpolation() const { return interpolation_; }           ///< P, from degree 1 to the space.
    const NodeSpace     &coarse_space() const { return coarse_; }                   ///< Degree 1 on the same mesh.
    const Constraints   &coarse_constraints() const { return coarse_constraints_; } ///< What constrains it.
    SparseMatrix        &coarse_matrix() { return coarse_matrix_->matrix(); }       ///< P^T J P, after finish().

    /// Bytes held.
    std::size_t memory() const;

  private:
    using Numbers = std::vector<dealii::types::global_dof_index>;

    /// u = T u of its free components, at a node of a cell.
    struct Elimination
    {
      int                  node;
      dealii::Tensor<2, 3> T;
    };

    /// visit(batch, lane, batch * n_lanes + lane) for every cell, owned or ghost.
    template <typename Visitor>
    void for_each_cell(const Visitor &visit) const
    {
      for (unsigned int b = 0; b < batches_.n_batches(); ++b)
        for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
          visit(b, lane, std::size_t(b) * n_lanes + lane);
    }
    /// Global node numbers of a cell in both spaces.
    void cell_nodes(unsigned int b, unsigned int lane, const NodeSpace &space, Numbers &fine, Numbers &coarse) const;
    /// The node of a cell at a corner.
    int  vertex_node(const int corner) const { return (n1_ - 1) * ((corner & 1) + n1_ * ((corner >> 1 & 1) + n1_ * (corner >> 2))); }
    void constrain(const NodeSpace &space, const Constraints &constraints);
    void find_stars(const NodeSpace &space, const Constraints &constraints, InstructionSet instruction_set);
    /// Eliminates unknowns that depend on others of their node.
    void find_eliminations(const NodeSpace &space, const Constraints &constraints);
    bool has_eliminations(const unsigned int b) const
    {
      const auto next = eliminations_.lower_bound(std::size_t(b) * n_lanes);
      return next != eliminations_.end() && next->first < (std::size_t(b) + 1) * n_lanes;
    }
    void eliminate(unsigned int b, double *element_matrices) const;
    void interpolate(const NodeSpace &space, const Constraints &constraints);
    void add_to_patches(unsigned int b, const double *element_matrices);
    void add_to_patch(unsigned int star, int corner, const unsigned short *places, const double *element_matrix);
    void add_to_coarse(unsigned int b, const double *element_matrices);

    static constexpr unsigned short outside = 0xffff;

    const CellBatches                               &batches_;
    int                                              n1_;      ///< nodes of a cell in one direction
    int                                              n_nodes_; ///< and in all
    NodeSpace                                        coarse_;
    Constraints                                      coarse_constraints_;
    Interpolation                                    interpolation_;
    std::vector<std::vector<std::pair<int, double>>> node_weights_;    ///< of each node of a cell: corners and weights
    std::vector<int>                                 corner_nodes_[8]; ///< nodes of a cell that touch each corner
    std::vector<int>                                 star_;            ///< [cell][8]: star of each corner, -1: of another rank
    std::vector<unsigned int>                        cells_of_star_;   ///< how many there are
    std::vector<unsigned int>                        missing_;         ///< how many of them have not been added
    std::vector<unsigned short>                      positions_;       ///< [cell][8][corner nodes][3]: place in the star
    std::set<dealii::types::global_dof_index>        leaders_;         ///< unknowns that others of other nodes depend on
    std::map<std::size_t, std::vector<Elimination>>  eliminations_;    ///< by batch * n_lanes + lane
    std::unique_ptr<PatchMatrices>                   patches_;
    std::unique_ptr<BlockMatrix>                     coarse_matrix_;
    dealii::AlignedVector<double>                    half_, coarse_element_, eliminated_;
  };
} // namespace myolines
