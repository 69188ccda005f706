// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/forest_order.h>

#include <myolines/muscle3d/muscle3d_system.h>

#include <algorithm>

namespace myolines
{
  std::vector<NodeSpace::Cell> cells_in_forest_order(const Muscle3dDiscretisation &discretisation)
  {
    // An id is the number of the tree and then that of the child, of its child, and so on.
    std::vector<std::pair<dealii::CellId, NodeSpace::Cell>> placed;
    for (const NodeSpace::Cell &cell : discretisation.space->nodes().active_cell_iterators())
      if (cell->is_locally_owned())
        placed.emplace_back(cell->id(), cell);
    std::sort(placed.begin(), placed.end(), [](const auto &one, const auto &other) { return one.first < other.first; });
    std::vector<NodeSpace::Cell> cells;
    for (const auto &[id, cell] : placed)
      cells.push_back(cell);
    return cells;
  }

  /// Nodes in the order in which a walk over all cells in forest order meets them first. A node shared by ranks is owned by the
  /// lowest of them, whose cells come first, so what a rank meets first and owns is one piece of that walk.
  std::vector<unsigned int> Muscle3dSystem::canonical_order() const
  {
    const NodeSpace                             &space = *discretisation_->space;
    const dealii::IndexSet                      &owned = space.owned_unknowns();
    std::vector<unsigned int>                    order;
    std::vector<bool>                            met(owned.n_elements());
    std::vector<dealii::types::global_dof_index> nodes;
    for (const NodeSpace::Cell &cell : cells_in_forest_order(*discretisation_))
      {
        space.cell_nodes(cell, nodes);
        for (const auto node : nodes)
          if (owned.is_element(3 * node))
            {
              const auto first = static_cast<unsigned int>(owned.index_within_set(3 * node));
              if (!met[first])
                order.insert(order.end(), {first, first + 1, first + 2});
              met[first] = true;
            }
      }
    return order;
  }
} // namespace myolines
