#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/muscle3d_system.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    /// Owned cells in the order of the forest (trees, then children in each): ranks own consecutive pieces of it.
    std::vector<NodeSpace::Cell> cells_in_forest_order(const NodeSpace &space, const NodeSpace::Mesh &mesh)
    {
      const auto                  &coarse_cell_of_tree = mesh.get_p4est_tree_to_coarse_cell_permutation();
      std::vector<std::size_t>     tree_of_coarse_cell(coarse_cell_of_tree.size());
      std::vector<NodeSpace::Cell> cells;
      for (std::size_t tree = 0; tree < coarse_cell_of_tree.size(); ++tree)
        tree_of_coarse_cell[coarse_cell_of_tree[tree]] = tree;
      for (const NodeSpace::Cell &cell : space.nodes().active_cell_iterators())
        if (cell->is_locally_owned())
          cells.push_back(cell);
      const auto key = [&](const NodeSpace::Cell &cell) {
        const dealii::CellId     id       = cell->id();
        const auto               children = id.get_child_indices();
        std::vector<std::size_t> numbers{tree_of_coarse_cell[id.get_coarse_cell_id()]};
        numbers.insert(numbers.end(), children.begin(), children.end());
        return numbers;
      };
      std::vector<std::pair<std::vector<std::size_t>, std::size_t>> keys;
      for (std::size_t i = 0; i < cells.size(); ++i)
        keys.emplace_back(key(cells[i]), i);
      std::sort(keys.begin(), keys.end());
      std::vector<NodeSpace::Cell> sorted;
      for (const auto &[ignored, i] : keys)
        sorted.push_back(cells[i]);
      return sorted;
    }
  } // namespace

  /// Nodes in the order in which a walk over all cells in forest order meets them first. A node shared by ranks is owned by the
  /// lowest of them, whose cells come first, so what a rank meets first and owns is one piece of that walk.
  std::vector<unsigned int> Muscle3dSystem::canonical_order() const
  {
    const NodeSpace                             &space = *discretisation_->space;
    const dealii::IndexSet                      &owned = space.owned_unknowns();
    std::vector<unsigned int>                    order;
    std::vector<bool>                            met(owned.n_elements());
    std::vector<dealii::types::global_dof_index> nodes;
    for (const NodeSpace::Cell &cell : cells_in_forest_order(space, discretisation_->mesh))
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
