// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/meshes/tetrahedra.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

namespace myolines
{
  /// @p mesh with all lengths times @p scale.
  PlainMesh scaled(PlainMesh mesh, double scale);

  /// Finds places in a mesh, whose cells are cut into tetrahedra for that.
  class MeshSampler
  {
  public:
    explicit MeshSampler(const PlainMesh &mesh);

    struct Place
    {
      std::size_t                 cell;     ///< that the place lies in, or the nearest one
      std::array<unsigned int, 4> points;   ///< of the mesh, around it
      std::array<double, 4>       weights;  ///< of theirs, a partition of one that reproduces linear functions within the mesh
      double                      distance; ///< to a near place of the mesh; 0 within it
    };
    Place at(const dealii::Point<3> &x) const;

    double size() const { return size_; } ///< diagonal of the box around the mesh

  private:
    std::array<double, 4> barycentric(const Tetrahedron &part, const dealii::Point<3> &x) const;

    std::vector<dealii::Point<3>>                                  points_;
    std::vector<Tetrahedron>                                       parts_;
    double                                                         size_ = 0;
    dealii::RTree<std::pair<dealii::BoundingBox<3>, unsigned int>> tree_;
  };
} // namespace myolines
