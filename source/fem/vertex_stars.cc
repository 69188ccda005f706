// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/vertex_stars.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace myolines
{
  using dealii::types::global_dof_index;

  namespace
  {
    std::vector<dealii::types::boundary_id> shared_faces(const NodeSpace &space)
    {
      std::vector<dealii::types::boundary_id> faces;
      for (const auto &[face, node] : space.shared_nodes())
        faces.push_back(face);
      return faces;
    }
  } // namespace

  VertexStars::VertexStars(const NodeSpace &space, const CellBatches &batches, const Element &element, const Constraints &constraints,
                           const Constrain &constrain_coarse, const InstructionSet instruction_set)
    : batches_(batches)
    , n1_(element.n_nodes_1d)
    , n_nodes_(element.n_nodes)
    , coarse_(space.mesh(), 1, shared_faces(space))
    , node_weights_(n_nodes_)
    , half_(std::size_t(n_nodes_) * 8 * n_lanes)
    , coarse_element_(std::size_t(9) * 64 * n_lanes)
  {
    const std::vector<dealii::Point<1>> at = dealii::QGaussLobatto<1>(n1_).get_points();
    for (int i = 0; i < n_nodes_; ++i)
      {
        const int place[3] = {i % n1_, i / n1_ % n1_, i / (n1_ * n1_)};
        for (int corner = 0; corner < 8; ++corner)
          {
            double value   = 1;
            bool   touches = true;
            for (int d = 0; d < 3; ++d)
              {
                const bool   upper = corner >> d & 1;
                const double x     = at[place[d]][0];
                value *= upper ? x : 1 - x;
                touches = touches && place[d] != (upper ? 0 : n1_ - 1);
              }
            if (value != 0)
              node_weights_[i].emplace_back(corner, value);
            if (touches)
              corner_nodes_[corner].push_back(i);
          }
      }
    if (constrain_coarse)
      coarse_constraints_ = constrain_coarse(coarse_);
    else
      constrain(space, constraints);
    find_eliminations(space, constraints);
    find_stars(space, constraints, instruction_set);
    interpolate(space, constraints);
    coarse_matrix_ = std::make_unique<BlockMatrix>(coarse_, batches_, 8, coarse_constraints_);
  }

  void VertexStars::cell_nodes(const unsigned int b, const unsigned int lane, const NodeSpace &space, Numbers &fine, Numbers &coarse) const
  {
    const NodeSpace::Cell &cell = batches_.cell(b, lane);
    space.cell_nodes(cell, fine);
    coarse_.cell_nodes(NodeSpace::Cell(&coarse_.mesh(), cell->level(), cell->index(), &coarse_.nodes()), coarse);
  }

  /// A coarse unknown is constrained where the fine one at its vertex is.
  void VertexStars::constrain(const NodeSpace &space, const Constraints &constraints)
  {
    coarse_constraints_.reinit(coarse_.relevant_unknowns());
    Numbers fine, coarse;
    for_each_cell([&](const unsigned int b, const unsigned int lane, std::size_t) {
      cell_nodes(b, lane, space, fine, coarse);
      for (int corner = 0; corner < 8; ++corner)
        for (unsigned int c = 0; c < 3; ++c)
          if (constraints.is_constrained(3 * fine[vertex_node(corner)] + c))
            coarse_constraints_.add_line(3 * coarse[corner] + c);
    });
    coarse_constraints_.close();
  }

  void VertexStars::find_eliminations(const NodeSpace &space, const Constraints &constraints)
  {
    for (const auto &line : constraints.get_lines())
      for (const auto &[index, weight] : line.entries)
        if (index / 3 != line.index / 3)
          leaders_.insert(index);
    Numbers fine, coarse;
    for_each_cell([&](const unsigned int b, const unsigned int lane, const std::size_t cell) {
      cell_nodes(b, lane, space, fine, coarse);
      for (int i = 0; i < n_nodes_; ++i)
        {
          Elimination elimination{i, {}};
          bool        any = false;
          for (unsigned int c = 0; c < 3; ++c)
            {
              const auto *entries = constraints.get_constraint_entries(3 * fine[i] + c);
              if (entries == nullptr)
                {
                  elimination.T[c][c] = 1;
                  continue;
                }
              for (const auto &[index, weight] : *entries)
                if (index / 3 == fine[i])
                  {
                    elimination.T[c][index % 3] = weight;
                    any                         = true;
                  }
            }
          if (any)
            eliminations_[cell].push_back(elimination);
        }
    });
    if (!eliminations_.empty())
      eliminated_.resize(std::size_t(9) * n_nodes_ * n_nodes_ * n_lanes);
  }

  /// K <- T^T K T, node by node.
  void VertexStars::eliminate(const unsigned int b, double *matrices) const
  {
    const std::size_t block = std::size_t(n_nodes_) * n_nodes_ * n_lanes;
    for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
      if (const auto found = eliminations_.find(std::size_t(b) * n_lanes + lane); found != eliminations_.end())
        for (const Elimination &e : found->second)
          for (const bool rows : {true, false})
            for (int j = 0; j < n_nodes_; ++j)
              for (int c = 0; c < 3; ++c)
                {
                  const auto at = [&](const int a) -> double & {
                    return matrices[std::size_t(rows ? 3 * a + c : 3 * c + a) * block +
                                    std::size_t(rows ? e.node * n_nodes_ + j : j * n_nodes_ + e.node) * n_lanes + lane];
                  };
                  const dealii::Tensor<1, 3> result = transpose(e.T) * dealii::Tensor<1, 3>({at(0), at(1), at(2)});
                  for (int a = 0; a < 3; ++a)
                    at(a) = result[a];
                }
  }

  void VertexStars::find_stars(const NodeSpace &space, const Constraints &constraints, const InstructionSet instruction_set)
  {
    const std::size_t n_cells = std::size_t(batches_.n_batches()) * n_lanes, per_corner = 3 * corner_nodes_[0].size();
    star_.assign(8 * n_cells, -1);
    positions_.assign(8 * n_cells * per_corner, outside);

    // Stars have numbers in the order in which their last cells come: neighbours in number are then complete at about the same time, and
    // their memory is free for others.
    const auto               &owned = coarse_.nodes().locally_owned_dofs();
    std::vector<std::size_t>  last(owned.n_elements(), 0);
    std::vector<unsigned int> vertices(owned.n_elements()), number(owned.n_elements());
    Numbers                   fine, coarse;
    for_each_cell([&](const unsigned int b, const unsigned int lane, const std::size_t cell) {
      cell_nodes(b, lane, space, fine, coarse);
      for (const auto vertex : coarse)
        if (owned.is_element(vertex))
          last[owned.index_within_set(vertex)] = cell;
    });
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::stable_sort(vertices.begin(), vertices.end(), [&](const unsigned int a, const unsigned int b) { return last[a] < last[b]; });
    for (unsigned int star = 0; star < vertices.size(); ++star)
      number[vertices[star]] = star;

    std::vector<std::vector<unsigned int>>                        stars(owned.n_elements());
    std::vector<std::unordered_map<unsigned int, unsigned short>> places(stars.size());
    cells_of_star_.assign(stars.size(), 0);
    for_each_cell([&](const unsigned int b, const unsigned int lane, const std::size_t cell) {
      cell_nodes(b, lane, space, fine, coarse);
      for (int corner = 0; corner < 8; ++corner)
        if (owned.is_element(coarse[corner]))
          {
            const unsigned int star  = number[owned.index_within_set(coarse[corner])];
            unsigned short    *at    = &positions_[(8 * cell + corner) * per_corner];
            star_[8 * cell + corner] = static_cast<int>(star);
            ++cells_of_star_[star];
            for (const int i : corner_nodes_[corner])
              for (unsigned int c = 0; c < 3; ++c, ++at)
                if (!constraints.is_constrained(3 * fine[i] + c) && leaders_.count(3 * fine[i] + c) == 0)
                  {
                    const unsigned int unknown = space.partitioner().global_to_local(3 * fine[i] + c);
                    const auto [found, fresh]  = places[star].emplace(unknown, static_cast<unsigned short>(stars[star].size()));
                    if (fresh)
                      stars[star].push_back(unknown);
                    *at = found->second;
                  }
          }
    });
    patches_ = std::make_unique<PatchMatrices>(stars, space.make_vector(), instruction_set);
    missing_ = cells_of_star_;
  }

  void VertexStars::interpolate(const NodeSpace &space, const Constraints &constraints)
  {
    const auto                                               &owned = space.nodes().locally_owned_dofs();
    std::vector<std::vector<std::pair<unsigned int, double>>> rows(owned.n_elements());
    Numbers                                                   fine, coarse;
    for_each_cell([&](const unsigned int b, const unsigned int lane, std::size_t) {
      cell_nodes(b, lane, space, fine, coarse);
      for (int i = 0; i < n_nodes_; ++i)
        if (owned.is_element(fine[i]))
          if (auto &row = rows[owned.index_within_set(fine[i])]; row.empty())
            for (const auto &[corner, weight] : node_weights_[i])
              row.emplace_back(coarse_.partitioner().global_to_local(3 * coarse[corner]) / 3, weight);
    });
    for (std::size_t row = 0; row < rows.size(); ++row)
      {
        const global_dof_index node           = owned.nth_index_in_set(row);
        const bool             constrained[3] = {constraints.is_constrained(3 * node), constraints.is_constrained(3 * node + 1),
                                                 constraints.is_constrained(3 * node + 2)};
        interpolation_.add_row(rows[row], constrained);
      }
  }

  void VertexStars::clear()
  {
    patches_->clear();
    missing_ = cells_of_star_;
    coarse_matrix_->clear();
  }

  void VertexStars::add(const unsigned int b, const double *element_matrices)
  {
    add_to_coarse(b, element_matrices); // whose matrix has relations of its own
    if (!has_eliminations(b))
      {
        add_to_patches(b, element_matrices);
        return;
      }
    std::copy_n(element_matrices, eliminated_.size(), eliminated_.begin());
    eliminate(b, eliminated_.data());
    add_to_patches(b, eliminated_.data());
  }

  void VertexStars::add_to_patches(const unsigned int b, const double *matrices)
  {
    const std::size_t per_corner = 3 * corner_nodes_[0].size();
    for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
      for (int corner = 0; corner < 8; ++corner)
        {
          const std::size_t at = 8 * (std::size_t(b) * n_lanes + lane) + corner;
          if (star_[at] < 0)
            continue;
          const unsigned int star = star_[at];
          add_to_patch(star, corner, &positions_[at * per_corner], matrices + lane);
          if (--missing_[star] == 0)
            patches_->complete(star);
        }
  }

  /// The symmetric part of the corner of an element matrix that the star shares.
  void VertexStars::add_to_patch(const unsigned int star, const int corner, const unsigned short *places, const double *element_matrix)
  {
    const std::vector<int> &nodes = corner_nodes_[corner];
    const std::size_t       n = n_nodes_, block = n * n * n_lanes;
    double                 *matrix = patches_->matrix(star);
    for (std::size_t ia = 0; ia < 3 * nodes.size(); ++ia)
      if (places[ia] != outside)
        {
          const std::size_t i = nodes[ia / 3], a = ia % 3;
          const double     *row = element_matrix + 3 * a * block + i * n * n_lanes, *column = element_matrix + a * block + i * n_lanes;
          for (std::size_t jc = 0; jc < 3 * nodes.size(); ++jc)
            if (places[jc] <= places[ia]) // outside is larger
              {
                const std::size_t j = nodes[jc / 3], c = jc % 3;
                matrix[PatchMatrices::place(places[ia], places[jc])] +=
                    0.5 * (row[c * block + j * n_lanes] + column[3 * c * block + j * n * n_lanes]);
              }
        }
  }

  /// P^T K P cell by cell. P has the same weights for each component, so the nine blocks are treated one by one.
  void VertexStars::add_to_coarse(const unsigned int b, const double *matrices)
  {
    std::fill(coarse_element_.begin(), coarse_element_.end(), 0.);
    for (int ac = 0; ac < 9; ++ac)
      {
        const double *K = matrices + std::size_t(ac) * n_nodes_ * n_nodes_ * n_lanes;
        std::fill(half_.begin(), half_.end(), 0.); // K P
        for (int i = 0; i < n_nodes_; ++i)
          for (int j = 0; j < n_nodes_; ++j)
            for (const auto &[corner, weight] : node_weights_[j])
              for (int lane = 0; lane < n_lanes; ++lane)
                half_[(8 * i + corner) * n_lanes + lane] += weight * K[(i * n_nodes_ + j) * n_lanes + lane];
        double *result = &coarse_element_[std::size_t(ac) * 64 * n_lanes];
        for (int i = 0; i < n_nodes_; ++i)
          for (const auto &[corner, weight] : node_weights_[i])
            for (int k = 0; k < 8 * n_lanes; ++k)
              result[8 * corner * n_lanes + k] += weight * half_[8 * i * n_lanes + k];
      }
    coarse_matrix_->add(b, coarse_element_.data());
  }

  std::size_t VertexStars::memory() const
  {
    return patches_->memory() + positions_.size() * sizeof(unsigned short) +
           (star_.size() + cells_of_star_.size() + missing_.size()) * sizeof(int);
  }
} // namespace myolines
