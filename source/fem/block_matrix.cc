#include <myolines/fem/block_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

namespace myolines
{
  namespace
  {
    using dealii::types::global_dof_index;

    /// The batches come from another space of the same mesh, perhaps.
    NodeSpace::Cell cell_in(const NodeSpace &space, const NodeSpace::Cell &cell)
    {
      return {&space.mesh(), cell->level(), cell->index(), &space.nodes()};
    }

    void reinit(SparseMatrix &matrix, const NodeSpace &space, const CellBatches &batches)
    {
      dealii::DynamicSparsityPattern pattern(space.owned_unknowns().size(), space.owned_unknowns().size(), space.relevant_unknowns());
      std::vector<global_dof_index>  nodes, columns;
      for (unsigned int b = 0; b < batches.n_batches(); ++b)
        for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
          {
            space.cell_nodes(cell_in(space, batches.cell(b, lane)), nodes);
            columns.clear();
            for (const global_dof_index node : nodes)
              for (unsigned int c = 0; c < 3; ++c)
                columns.push_back(3 * node + c);
            std::sort(columns.begin(), columns.end());
            for (const global_dof_index row : columns)
              if (space.owned_unknowns().is_element(row))
                pattern.add_entries(row, columns.begin(), columns.end(), true);
          }
      matrix.reinit(space.owned_unknowns(), space.owned_unknowns(), pattern, space.communicator(), true);
    }
  } // namespace

  BlockMatrix::BlockMatrix(const NodeSpace &space, const CellBatches &batches, const int n_nodes, const Constraints &constraints)
    : batches_(batches)
    , n_nodes_(n_nodes)
  {
    reinit(matrix_, space, batches);
    rows_ = compressed_rows(matrix_);

    const std::size_t n_cells = std::size_t(batches.n_batches()) * n_lanes;
    block_position_.assign(n_cells * n_nodes_ * n_nodes_, -1);
    first_row_.assign(n_cells * n_nodes_, -1);
    constrained_.assign(n_cells * n_nodes_, 0);
    any_constrained_.assign(batches.n_batches(), false);

    std::vector<global_dof_index> nodes;
    std::vector<int>              columns(n_nodes_);
    for (unsigned int b = 0; b < batches.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
        {
          const std::size_t cell = std::size_t(b) * n_lanes + lane;
          space.cell_nodes(cell_in(space, batches.cell(b, lane)), nodes);
          for (int i = 0; i < n_nodes_; ++i)
            {
              columns[i]                      = local_column(matrix_, 3 * nodes[i]);
              first_row_[cell * n_nodes_ + i] = local_row(matrix_, 3 * nodes[i]);
              for (unsigned int c = 0; c < 3; ++c)
                if (constraints.is_constrained(3 * nodes[i] + c))
                  {
                    constrained_[cell * n_nodes_ + i] |= 1u << c;
                    any_constrained_[b] = true;
                  }
            }
          for (int i = 0; i < n_nodes_; ++i)
            if (const int row = first_row_[cell * n_nodes_ + i]; row >= 0)
              {
                const int *begin = rows_.columns + rows_.row_start[row], *end = rows_.columns + rows_.row_start[row + 1];
                for (int j = 0; j < n_nodes_; ++j)
                  {
                    const int *found = std::lower_bound(begin, end, columns[j]);
                    AssertThrow(found != end && *found == columns[j] && found[2] == columns[j] + 2, dealii::ExcInternalError());
                    block_position_[(cell * n_nodes_ + i) * n_nodes_ + j] = static_cast<int>(found - begin);
                  }
              }
        }
  }

  void BlockMatrix::clear() { matrix_ = 0; }

  void BlockMatrix::constrain(const unsigned int b, double *element_matrices) const
  {
    const std::size_t block = std::size_t(n_nodes_) * n_nodes_ * n_lanes;
    for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
      for (int i = 0; i < n_nodes_; ++i)
        if (const unsigned char mask = constrained_[(std::size_t(b) * n_lanes + lane) * n_nodes_ + i]; mask != 0)
          for (int a = 0; a < 3; ++a)
            if (mask & (1u << a))
              {
                double      &diagonal  = element_matrices[(3 * a + a) * block + (std::size_t(i) * n_nodes_ + i) * n_lanes + lane];
                const double magnitude = std::abs(diagonal);
                for (int c = 0; c < 3; ++c)
                  for (int j = 0; j < n_nodes_; ++j)
                    {
                      element_matrices[(3 * a + c) * block + (std::size_t(i) * n_nodes_ + j) * n_lanes + lane] = 0;
                      element_matrices[(3 * c + a) * block + (std::size_t(j) * n_nodes_ + i) * n_lanes + lane] = 0;
                    }
                diagonal = magnitude;
              }
  }

  void BlockMatrix::add(const unsigned int b, double *element_matrices)
  {
    if (any_constrained_[b])
      constrain(b, element_matrices);
    const std::size_t block = std::size_t(n_nodes_) * n_nodes_ * n_lanes;
    for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
      for (int i = 0; i < n_nodes_; ++i)
        {
          const std::size_t node = (std::size_t(b) * n_lanes + lane) * n_nodes_ + i;
          if (first_row_[node] < 0)
            continue;
          const int *positions = &block_position_[node * n_nodes_];
          for (int a = 0; a < 3; ++a)
            {
              double *row = rows_.values + rows_.row_start[first_row_[node] + a];
              for (int j = 0; j < n_nodes_; ++j)
                {
                  const std::size_t at = (std::size_t(i) * n_nodes_ + j) * n_lanes + lane;
                  for (int c = 0; c < 3; ++c)
                    row[positions[j] + c] += element_matrices[(3 * a + c) * block + at];
                }
            }
        }
  }
} // namespace myolines
