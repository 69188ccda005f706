// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/sparse_matrix.h>
#include <myolines/fem/cell_batches.h>

#include <map>
#include <vector>

namespace myolines
{
  /// Sparse matrix of a NodeSpace, filled batch by batch from element matrices. The place of every entry is
  /// looked up once, so filling neither searches nor communicates: owned rows get everything from owned and ghost cells. Cells with
  /// unknowns that depend on others are the exception: their owner adds them, to the rows of whatever rank.
  class BlockMatrix
  {
  public:
    /// @p space is any space of @p n_nodes nodes a cell on the mesh of the batches. The constraints outlive the matrix.
    BlockMatrix(const NodeSpace &space, const CellBatches &batches, int n_nodes, const Constraints &constraints);

    ~BlockMatrix() { provide_entries(matrix_); }
    BlockMatrix(const BlockMatrix &)            = delete;
    BlockMatrix &operator=(const BlockMatrix &) = delete;

    /// Sets all entries to zero, also after release_entries().
    void clear();

    /// Adds the element matrices of batch @p b: [9][n_nodes][n_nodes] lanes, block (a, c) at 3 a + c. Rows and columns of
    /// constrained unknowns are left out but for their diagonal, which gets the magnitude it would have had; those that depend on
    /// others add to the rows and columns of these.
    void add(unsigned int b, double *element_matrices);

    /// After all batches. Collective.
    void finish();

    const SparseMatrix &matrix() const { return matrix_; } ///< After finish().
    SparseMatrix       &matrix() { return matrix_; }

  private:
    using Numbers = std::vector<dealii::types::global_dof_index>;

    void find_related(const NodeSpace &space);
    void make_pattern(const NodeSpace &space);
    void add_related(const Numbers &unknowns, unsigned int lane, const double *element_matrices);

    /// Zeroes constrained rows and columns of the element matrices.
    void constrain(unsigned int b, double *element_matrices) const;

    const CellBatches             &batches_;
    const int                      n_nodes_;
    const Constraints             &constraints_;
    std::map<std::size_t, Numbers> related_;                  ///< unknowns of cells that depend on others, by batch * n_lanes + lane
    bool                           related_anywhere_ = false; ///< on any rank
    SparseMatrix                   matrix_;
    CompressedRows                 rows_;
    std::vector<int>               positions_;   ///< [batch][lane][i][j][c]: offset in the rows of node i; -1: row not owned
    std::vector<int>               first_row_;   ///< [batch][lane][i]: local row of unknown 3 n_i
    std::vector<unsigned char>     constrained_; ///< [batch][lane][i]: bit c set if component c is constrained
    std::vector<bool>              any_constrained_;
  };
} // namespace myolines
