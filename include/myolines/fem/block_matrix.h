#pragma once

#include <myolines/algebra/sparse_matrix.h>
#include <myolines/fem/cell_batches.h>

#include <vector>

namespace myolines
{
  /// Sparse matrix of a NodeSpace, filled batch by batch from element matrices. The place of every 3x3 node block is
  /// looked up once, so filling neither searches nor communicates: owned rows get everything from owned and ghost cells.
  class BlockMatrix
  {
  public:
    /// @p space is any space of @p n_nodes nodes a cell on the mesh of the batches.
    BlockMatrix(const NodeSpace &space, const CellBatches &batches, int n_nodes, const Constraints &constraints);

    /// Sets all entries to zero.
    void clear();

    /// Adds the element matrices of batch @p b: [9][n_nodes][n_nodes] lanes, block (a, c) at 3 a + c. Rows and columns of
    /// constrained unknowns are left out but for their diagonal, which gets the magnitude it would have had.
    void add(unsigned int b, double *element_matrices);

    const SparseMatrix &matrix() const { return matrix_; }

  private:
    /// Zeroes constrained rows and columns of the element matrices.
    void constrain(unsigned int b, double *element_matrices) const;

    const CellBatches         &batches_;
    const int                  n_nodes_;
    SparseMatrix               matrix_;
    CompressedRows             rows_;
    std::vector<int>           block_position_; ///< [batch][lane][i][j]: offset in the row of node i; -1: row not owned
    std::vector<int>           first_row_;      ///< [batch][lane][i]: local row of unknown 3 n_i
    std::vector<unsigned char> constrained_;    ///< [batch][lane][i]: bit c set if component c is constrained
    std::vector<bool>          any_constrained_;
  };
} // namespace myolines
