// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/block_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <set>

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
  } // namespace

  /// The owner of a node sees all cells around it, others perhaps not all conditions there: it tells them.
  void BlockMatrix::find_related(const NodeSpace &space)
  {
    Vector flags = space.make_vector();
    for (const auto &line : constraints_.get_lines())
      if (!line.entries.empty() && space.owned_unknowns().is_element(line.index))
        flags(line.index) = 1;
    related_anywhere_ = flags.linfty_norm() > 0;
    if (!related_anywhere_)
      return;
    flags.update_ghost_values();
    Numbers nodes, unknowns;
    for (unsigned int b = 0; b < batches_.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
        {
          space.cell_nodes(cell_in(space, batches_.cell(b, lane)), nodes);
          unknowns.clear();
          for (const global_dof_index node : nodes)
            for (unsigned int c = 0; c < 3; ++c)
              unknowns.push_back(3 * node + c);
          if (std::any_of(unknowns.begin(), unknowns.end(), [&](const global_dof_index i) { return flags(i) != 0; }))
            related_[std::size_t(b) * n_lanes + lane] = unknowns;
        }
  }

  void BlockMatrix::make_pattern(const NodeSpace &space)
  {
    dealii::DynamicSparsityPattern pattern(space.owned_unknowns().size(), space.owned_unknowns().size(), space.relevant_unknowns());
    Numbers                        nodes, columns;
    for (unsigned int b = 0; b < batches_.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
        {
          space.cell_nodes(cell_in(space, batches_.cell(b, lane)), nodes);
          columns.clear();
          for (const global_dof_index node : nodes)
            for (unsigned int c = 0; c < 3; ++c)
              columns.push_back(3 * node + c);
          std::sort(columns.begin(), columns.end());
          for (const global_dof_index row : columns)
            if (space.owned_unknowns().is_element(row))
              pattern.add_entries(row, columns.begin(), columns.end(), true);
        }
    // Whole nodes here too: the rows of a node have one pattern.
    for (const auto &[place, unknowns] : related_)
      if (batches_.cell(place / n_lanes, place % n_lanes)->is_locally_owned())
        {
          std::set<global_dof_index> coupled;
          for (const global_dof_index unknown : unknowns)
            {
              coupled.insert(unknown / 3);
              if (const auto *entries = constraints_.get_constraint_entries(unknown))
                for (const auto &[index, weight] : *entries)
                  coupled.insert(index / 3);
            }
          columns.clear();
          for (const global_dof_index node : coupled)
            for (unsigned int c = 0; c < 3; ++c)
              columns.push_back(3 * node + c);
          for (const global_dof_index row : columns)
            pattern.add_entries(row, columns.begin(), columns.end(), true);
        }
    matrix_.reinit(space.owned_unknowns(), space.owned_unknowns(), pattern, space.communicator(), true);
  }

  BlockMatrix::BlockMatrix(const NodeSpace &space, const CellBatches &batches, const int n_nodes, const Constraints &constraints)
    : batches_(batches)
    , n_nodes_(n_nodes)
    , constraints_(constraints)
  {
    find_related(space);
    make_pattern(space);
    rows_ = compressed_rows(matrix_);

    const std::size_t n_cells = std::size_t(batches.n_batches()) * n_lanes;
    positions_.assign(n_cells * n_nodes_ * 3 * n_nodes_, -1);
    first_row_.assign(n_cells * n_nodes_, -1);
    constrained_.assign(n_cells * n_nodes_, 0);
    any_constrained_.assign(batches.n_batches(), false);

    std::vector<global_dof_index> nodes;
    std::vector<int>              columns(3 * n_nodes_);
    for (unsigned int b = 0; b < batches.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
        {
          const std::size_t cell = std::size_t(b) * n_lanes + lane;
          space.cell_nodes(cell_in(space, batches.cell(b, lane)), nodes);
          for (int i = 0; i < n_nodes_; ++i)
            {
              for (unsigned int c = 0; c < 3; ++c)
                columns[3 * i + c] = local_column(matrix_, 3 * nodes[i] + c);
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
                for (int j = 0; j < 3 * n_nodes_; ++j)
                  {
                    const int *found = std::lower_bound(begin, end, columns[j]);
                    AssertThrow(found != end && *found == columns[j], dealii::ExcInternalError());
                    positions_[(cell * n_nodes_ + i) * 3 * n_nodes_ + j] = static_cast<int>(found - begin);
                  }
              }
        }
  }

  void BlockMatrix::clear()
  {
    provide_entries(matrix_);
    rows_   = compressed_rows(matrix_);
    matrix_ = 0;
  }

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

  void BlockMatrix::add_related(const Numbers &unknowns, const unsigned int lane, const double *element_matrices)
  {
    dealii::FullMatrix<double> cell(unknowns.size(), unknowns.size());
    const std::size_t          block = std::size_t(n_nodes_) * n_nodes_ * n_lanes;
    for (unsigned int ia = 0; ia < unknowns.size(); ++ia)
      for (unsigned int jc = 0; jc < unknowns.size(); ++jc)
        cell(ia, jc) = element_matrices[(3 * (ia % 3) + jc % 3) * block + (std::size_t(ia / 3) * n_nodes_ + jc / 3) * n_lanes + lane];
    constraints_.distribute_local_to_global(cell, unknowns, matrix_);
  }

  void BlockMatrix::finish()
  {
    if (related_anywhere_)
      matrix_.compress(dealii::VectorOperation::add);
  }

  void BlockMatrix::add(const unsigned int b, double *element_matrices)
  {
    const std::size_t first = std::size_t(b) * n_lanes;
    const auto        begin = related_.lower_bound(first), end = related_.lower_bound(first + n_lanes);
    if (b < batches_.n_owned_batches())
      for (auto cell = begin; cell != end; ++cell)
        add_related(cell->second, cell->first % n_lanes, element_matrices);
    if (any_constrained_[b])
      constrain(b, element_matrices);
    const std::size_t block = std::size_t(n_nodes_) * n_nodes_ * n_lanes;
    for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
      for (int i = 0; i < n_nodes_ && (begin == end || related_.count(first + lane) == 0); ++i)
        {
          const std::size_t node = (first + lane) * n_nodes_ + i;
          if (first_row_[node] < 0)
            continue;
          const int *positions = &positions_[node * 3 * n_nodes_];
          for (int a = 0; a < 3; ++a)
            {
              double *row = rows_.values + rows_.row_start[first_row_[node] + a];
              for (int j = 0; j < n_nodes_; ++j)
                {
                  const std::size_t at = (std::size_t(i) * n_nodes_ + j) * n_lanes + lane;
                  for (int c = 0; c < 3; ++c)
                    row[positions[3 * j + c]] += element_matrices[(3 * a + c) * block + at];
                }
            }
        }
  }
} // namespace myolines
