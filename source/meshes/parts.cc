// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/meshes/tidy.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace myolines
{
  namespace
  {
    /// Things that are joined one by one, and the first thing of each of the sets that this makes.
    class Sets
    {
    public:
      explicit Sets(const std::size_t n)
        : leader_(n)
      {
        std::iota(leader_.begin(), leader_.end(), std::size_t(0));
      }

      std::size_t find(std::size_t i)
      {
        while (leader_[i] != i)
          i = leader_[i] = leader_[leader_[i]];
        return i;
      }

      void join(const std::size_t i, const std::size_t j)
      {
        const auto [low, high] = std::minmax({find(i), find(j)});
        leader_[high]          = low;
      }

      std::vector<std::size_t> firsts()
      {
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < leader_.size(); ++i)
          if (find(i) == i)
            all.push_back(i);
        return all;
      }

    private:
      std::vector<std::size_t> leader_;
    };
  } // namespace

  std::vector<std::size_t> parts_of(const PlainMesh &mesh)
  {
    Sets                     cells(mesh.cells.size());
    std::vector<std::size_t> at_point(mesh.points.size(), mesh.cells.size()); // a cell there
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
      for (unsigned int v = 0; v < n_corners(mesh.cells[i].shape); ++v)
        if (std::size_t &other = at_point[mesh.cells[i].corner[v]]; other == mesh.cells.size())
          other = i;
        else
          cells.join(i, other);
    return cells.firsts();
  }

  std::vector<std::size_t> parts_without_common_faces(const PlainMesh &mesh)
  {
    Sets                                         cells(mesh.cells.size());
    std::vector<std::pair<FaceKey, std::size_t>> faces;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
      for (unsigned int f = 0; f < faces_of(mesh.cells[i].shape).size(); ++f)
        faces.emplace_back(face_key(face_of(mesh.cells[i], f)), i);
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i)
      if (faces[i].first == faces[i - 1].first)
        cells.join(faces[i].second, faces[i - 1].second);
    return cells.firsts();
  }

  std::vector<PlainMesh::Element> unfitting_faces(const PlainMesh &mesh)
  {
    const std::vector<PlainMesh::Element> outer = outer_faces(mesh);
    std::set<FaceKey>                     halves; // of quadrilaterals
    for (const PlainMesh::Element &face : outer)
      if (face.shape == PlainMesh::Shape::quadrilateral)
        for (unsigned int left_out = 0; left_out < 4; ++left_out)
          {
            FaceKey half   = face_key(face);
            half[left_out] = no_corner;
            std::sort(half.begin(), half.end());
            halves.insert(half);
          }
    std::vector<PlainMesh::Element> found;
    for (const PlainMesh::Element &face : outer)
      if (face.shape == PlainMesh::Shape::triangle && halves.count(face_key(face)) > 0)
        found.push_back(face);
    return found;
  }
} // namespace myolines
