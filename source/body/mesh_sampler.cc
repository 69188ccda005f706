// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_sampler.h"

#include <myolines/meshes/tidy.h>

#include <algorithm>
#include <limits>

namespace myolines
{
  PlainMesh scaled(PlainMesh mesh, const double scale)
  {
    for (PlainMesh::Position &x : mesh.points)
      for (double &c : x)
        c *= scale;
    return mesh;
  }

  MeshSampler::MeshSampler(const PlainMesh &mesh)
    : parts_(tetrahedra_of(mesh))
  {
    for (const PlainMesh::Position &x : mesh.points)
      points_.emplace_back(x[0], x[1], x[2]);
    const auto [low, high] = box_around(mesh);
    size_                  = dealii::Point<3>(low[0], low[1], low[2]).distance(dealii::Point<3>(high[0], high[1], high[2]));
    std::vector<std::pair<dealii::BoundingBox<3>, unsigned int>> boxes;
    for (unsigned int i = 0; i < parts_.size(); ++i)
      {
        std::vector<dealii::Point<3>> corners;
        for (const unsigned int v : parts_[i].corner)
          corners.push_back(points_[v]);
        boxes.emplace_back(dealii::BoundingBox<3>(corners), i);
      }
    tree_ = dealii::pack_rtree(boxes);
  }

  std::array<double, 4> MeshSampler::barycentric(const Tetrahedron &part, const dealii::Point<3> &x) const
  {
    dealii::Tensor<1, 3> edge[3];
    for (unsigned int i = 0; i < 3; ++i)
      edge[i] = points_[part.corner[i + 1]] - points_[part.corner[0]];
    const dealii::Tensor<1, 3> to     = x - points_[part.corner[0]];
    const double               volume = edge[0] * dealii::cross_product_3d(edge[1], edge[2]);
    const double b = to * dealii::cross_product_3d(edge[1], edge[2]) / volume, c = edge[0] * dealii::cross_product_3d(to, edge[2]) / volume,
                 d = edge[0] * dealii::cross_product_3d(edge[1], to) / volume;
    return {{1 - b - c - d, b, c, d}};
  }

  /// The tetrahedron in which the place lies deepest; outside, of some that are near, the one with the nearest point.
  MeshSampler::Place MeshSampler::at(const dealii::Point<3> &x) const
  {
    using Entry = std::pair<dealii::BoundingBox<3>, unsigned int>;
    std::vector<Entry>           near;
    const dealii::Point<3>       slack(1e-9 * size_, 1e-9 * size_, 1e-9 * size_);
    const dealii::BoundingBox<3> around(std::make_pair(x - dealii::Tensor<1, 3>(slack), x + dealii::Tensor<1, 3>(slack)));
    tree_.query(boost::geometry::index::intersects(around), std::back_inserter(near));
    double       deepest = -1e-9;
    const Entry *inside  = nullptr;
    for (const Entry &entry : near)
      {
        const auto   weights = barycentric(parts_[entry.second], x);
        const double lowest  = *std::min_element(weights.begin(), weights.end());
        if (lowest >= deepest)
          {
            deepest = lowest;
            inside  = &entry;
          }
      }
    if (inside != nullptr)
      return {parts_[inside->second].cell, parts_[inside->second].corner, barycentric(parts_[inside->second], x), 0};

    near.clear();
    tree_.query(boost::geometry::index::nearest(x, 16), std::back_inserter(near));
    Place best{0, {}, {}, std::numeric_limits<double>::infinity()};
    for (const Entry &entry : near)
      {
        const Tetrahedron &part    = parts_[entry.second];
        auto               weights = barycentric(part, x);
        double             sum     = 0;
        for (double &weight : weights)
          sum += weight = std::max(weight, 0.);
        dealii::Point<3> clamped;
        for (unsigned int i = 0; i < 4; ++i)
          {
            weights[i] /= sum;
            clamped += weights[i] * points_[part.corner[i]];
          }
        if (const double distance = clamped.distance(x); distance < best.distance)
          best = {part.cell, part.corner, weights, distance};
      }
    return best;
  }
} // namespace myolines
