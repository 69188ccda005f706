// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/nested_dissection.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace myolines
{
  namespace
  {
    using Cells = std::vector<unsigned int>; // numbers of coarse cells

    /// Unknowns of a separator: one dense front, as often as @p times.
    void add_front(const double unknowns, const double times, FactorisationCost &cost)
    {
      cost.cubes += times * unknowns * unknowns * unknowns;
      cost.squares += times * unknowns * unknowns;
    }

    /// Adds @p times the fronts of a box of a x b x c nodes, cut across its longest edge.
    void add_box(double a, double b, double c, const double times, FactorisationCost &cost)
    {
      std::array<double, 3> edges{{a, b, c}};
      std::sort(edges.begin(), edges.end());
      const double cut = edges[2] <= 3 ? edges[2] : 1; // what is small is eliminated at once
      add_front(3 * edges[0] * edges[1] * cut, times, cost);
      if (cut == 1)
        add_box(edges[0], edges[1], (edges[2] - 1) / 2, 2 * times, cost);
    }

    class Dissection
    {
    public:
      Dissection(const NodeSpace &space)
        : edge_(space.degree() * std::exp2(space.mesh().n_global_levels() - 1))
      {
        for (const auto &cell : space.mesh().cell_iterators_on_level(0))
          {
            centres_.push_back(cell->center());
            axes_.emplace_back();
            for (unsigned int d = 0; d < 3; ++d)
              axes_.back()[d] = cell->face(2 * d + 1)->center() - cell->face(2 * d)->center();
            neighbours_.emplace_back();
            vertices_.emplace_back();
            for (const unsigned int face : cell->face_indices())
              if (!cell->at_boundary(face))
                {
                  neighbours_.back().push_back(cell->neighbor(face)->index());
                  std::array<unsigned int, 4> corners{};
                  for (unsigned int v = 0; v < corners.size(); ++v)
                    corners[v] = cell->face(face)->vertex_index(v);
                  vertices_.back().push_back(corners);
                }
          }
        part_.resize(neighbours_.size());
      }

      FactorisationCost cost()
      {
        Cells all(neighbours_.size());
        std::iota(all.begin(), all.end(), 0);
        std::vector<Cells> parts{all};
        while (!parts.empty())
          {
            const Cells cells = std::move(parts.back());
            parts.pop_back();
            if (cells.size() == 1)
              add_box(edge_ - 1, edge_ - 1, edge_ - 1, 1, cost_);
            else
              for (Cells &half : halve(cells))
                parts.push_back(std::move(half));
          }
        return cost_;
      }

    private:
      /// Across that axis of the cell in the middle which gives the smallest separator.
      std::array<Cells, 2> halve(const Cells &cells)
      {
        dealii::Point<3> middle;
        for (const unsigned int cell : cells)
          middle += centres_[cell] / double(cells.size());
        const unsigned int   central = *std::min_element(cells.begin(), cells.end(), [&](const auto a, const auto b) {
          return centres_[a].distance_square(middle) < centres_[b].distance_square(middle);
        });
        std::array<Cells, 2> best;
        double               least = std::numeric_limits<double>::infinity();
        for (const dealii::Tensor<1, 3> &axis : axes_[central])
          {
            std::array<Cells, 2> halves = cut(cells, middle, axis);
            if (const double unknowns = separator(halves); unknowns < least)
              {
                least = unknowns;
                best  = std::move(halves);
              }
          }
        add_front(least, 1, cost_);
        return best;
      }

      /// At the widest gap between centres in the middle third: between layers of a regular mesh.
      std::array<Cells, 2> cut(Cells cells, const dealii::Point<3> &middle, const dealii::Tensor<1, 3> &axis) const
      {
        const auto along = [&](const unsigned int cell) { return (centres_[cell] - middle) * axis; };
        std::sort(cells.begin(), cells.end(), [&](const auto a, const auto b) { return along(a) < along(b); });
        const std::size_t first = std::max<std::size_t>(1, cells.size() / 3), last = std::max(first, cells.size() - first);
        std::size_t       at     = first;
        double            widest = 0;
        for (std::size_t i = first; i <= last && i < cells.size(); ++i)
          if (const double gap = along(cells[i]) - along(cells[i - 1]); gap > widest)
            {
              widest = gap;
              at     = i;
            }
        const auto place = cells.begin() + static_cast<std::ptrdiff_t>(at);
        return {{Cells(cells.begin(), place), Cells(place, cells.end())}};
      }

      /// Unknowns of the nodes on faces between the halves. Of F faces with V corners in one sheet V + F - 1 edges are sides.
      double separator(const std::array<Cells, 2> &halves)
      {
        const unsigned int other = ++n_parts_;
        for (const unsigned int cell : halves[1])
          part_[cell] = other;
        double                 faces = 0;
        std::set<unsigned int> corners;
        for (const unsigned int cell : halves[0])
          for (std::size_t f = 0; f < neighbours_[cell].size(); ++f)
            if (part_[neighbours_[cell][f]] == other)
              {
                ++faces;
                corners.insert(vertices_[cell][f].begin(), vertices_[cell][f].end());
              }
        const double points = corners.size(), inner = edge_ - 1;
        return faces == 0 ? 0 : 3 * (points + (points + faces - 1) * inner + faces * inner * inner);
      }

      const double                                          edge_; ///< parts into which nodes divide the edge of a coarse cell
      std::vector<dealii::Point<3>>                         centres_;
      std::vector<std::array<dealii::Tensor<1, 3>, 3>>      axes_;
      std::vector<Cells>                                    neighbours_;
      std::vector<std::vector<std::array<unsigned int, 4>>> vertices_; ///< of the faces to them
      std::vector<unsigned int>                             part_;
      unsigned int                                          n_parts_ = 0;
      FactorisationCost                                     cost_;
    };
  } // namespace

  FactorisationCost nested_dissection(const NodeSpace &space) { return Dissection(space).cost(); }
} // namespace myolines
