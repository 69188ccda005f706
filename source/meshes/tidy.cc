// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/meshes/tidy.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <unordered_map>

namespace myolines
{
  namespace
  {
    using Shape    = PlainMesh::Shape;
    using Element  = PlainMesh::Element;
    using Position = PlainMesh::Position;

    /// Points by place, to find what coincides within a millionth of the box.
    class Places
    {
    public:
      explicit Places(const PlainMesh &mesh)
        : points_(mesh.points)
      {
        const auto [low, high] = box_around(mesh);
        double squares         = 0;
        for (unsigned int c = 0; c < 3; ++c)
          squares += (high[c] - low[c]) * (high[c] - low[c]);
        origin_    = low;
        tolerance_ = std::max(1e-6 * std::sqrt(squares), std::numeric_limits<double>::min());
      }

      void add(const unsigned int point) { at_[key(cell_of(points_[point]))].push_back(point); }

      /// One of those added.
      std::optional<unsigned int> find(const Position &x) const
      {
        const auto middle = cell_of(x);
        for (int k = -1; k <= 1; ++k)
          for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
              if (const auto found = at_.find(key({{middle[0] + i, middle[1] + j, middle[2] + k}})); found != at_.end())
                for (const unsigned int point : found->second)
                  if (std::hypot(points_[point][0] - x[0], points_[point][1] - x[1], points_[point][2] - x[2]) <= tolerance_)
                    return point;
        return std::nullopt;
      }

    private:
      using Cell = std::array<long, 3>;

      Cell cell_of(const Position &x) const
      {
        return {{std::lround((x[0] - origin_[0]) / (2 * tolerance_)), std::lround((x[1] - origin_[1]) / (2 * tolerance_)),
                 std::lround((x[2] - origin_[2]) / (2 * tolerance_))}};
      }
      static std::size_t key(const Cell &cell)
      {
        std::size_t hash = 0;
        for (const long c : cell)
          hash = (hash ^ static_cast<std::size_t>(c)) * 0x9E3779B97F4A7C15ULL + (hash >> 31);
        return hash;
      }

      const std::vector<Position>                               &points_;
      Position                                                   origin_;
      double                                                     tolerance_;
      std::unordered_map<std::size_t, std::vector<unsigned int>> at_;
    };

    std::vector<bool> points_of_cells(const PlainMesh &mesh)
    {
      std::vector<bool> used(mesh.points.size(), false);
      for (const Element &cell : mesh.cells)
        for (unsigned int i = 0; i < n_corners(cell.shape); ++i)
          used[cell.corner[i]] = true;
      return used;
    }

    std::vector<bool> points_of_faces(const PlainMesh &mesh)
    {
      std::vector<bool> used(mesh.points.size(), false);
      for (const Element &face : mesh.faces)
        for (unsigned int i = 0; i < n_corners(face.shape); ++i)
          used[face.corner[i]] = true;
      return used;
    }

    /// Keeps points of cells, and of several at one place the first. Surfaces that have points of their own get those of the cells.
    void renumber(PlainMesh &mesh, Tidying &done)
    {
      const std::vector<bool>   used = points_of_cells(mesh), of_faces = points_of_faces(mesh);
      std::vector<unsigned int> fresh(mesh.points.size(), no_corner);
      std::vector<Position>     kept;
      Places                    places(mesh);
      for (unsigned int i = 0; i < mesh.points.size(); ++i)
        if (!used[i])
          continue;
        else if (const auto same = places.find(mesh.points[i]))
          {
            ++done.joined;
            fresh[i] = fresh[*same];
          }
        else
          {
            places.add(i);
            fresh[i] = static_cast<unsigned int>(kept.size());
            kept.push_back(mesh.points[i]);
          }
      for (unsigned int i = 0; i < mesh.points.size(); ++i)
        if (const auto same = !used[i] && of_faces[i] ? places.find(mesh.points[i]) : std::nullopt)
          {
            ++done.joined;
            fresh[i] = fresh[*same];
          }
        else if (!used[i])
          ++done.unused;
      for (auto *elements : {&mesh.cells, &mesh.faces})
        for (Element &element : *elements)
          for (unsigned int i = 0; i < n_corners(element.shape); ++i)
            element.corner[i] = fresh[element.corner[i]];
      mesh.points         = std::move(kept);
      const auto has_none = [](const Element &face) {
        return std::find(face.corner.begin(), face.corner.begin() + n_corners(face.shape), no_corner) !=
               face.corner.begin() + n_corners(face.shape);
      };
      const auto loose = std::remove_if(mesh.faces.begin(), mesh.faces.end(), has_none);
      done.loose       = static_cast<std::size_t>(mesh.faces.end() - loose);
      mesh.faces.erase(loose, mesh.faces.end());
    }

    void drop_second_cells(PlainMesh &mesh, Tidying &done)
    {
      std::map<std::array<unsigned int, 8>, std::size_t> known;
      std::vector<Element>                               kept;
      std::map<std::size_t, std::vector<int>>            groups;
      for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        {
          std::array<unsigned int, 8> key;
          key.fill(no_corner);
          std::copy_n(mesh.cells[i].corner.begin(), n_corners(mesh.cells[i].shape), key.begin());
          std::sort(key.begin(), key.end());
          const auto [entry, fresh] = known.emplace(key, kept.size());
          if (fresh)
            kept.push_back(mesh.cells[i]);
          else
            {
              ++done.twice;
              if (mesh.cells[i].group != 0 && mesh.cells[i].group != kept[entry->second].group)
                groups[entry->second].push_back(mesh.cells[i].group);
            }
          if (const auto more = mesh.further_groups.find(i); more != mesh.further_groups.end())
            groups[entry->second].insert(groups[entry->second].end(), more->second.begin(), more->second.end());
        }
      mesh.cells          = std::move(kept);
      mesh.further_groups = std::move(groups);
    }

    Position minus(const Position &a, const Position &b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
    double   dot(const Position &a, const Position &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
    double   distance(const Position &a, const Position &b) { return std::sqrt(dot(minus(a, b), minus(a, b))); }
    Position cross(const Position &a, const Position &b)
    {
      return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    }

    /// Whether @p x is nearer than @p tolerance to a triangle: to its plane, and not outside of an edge.
    bool lies_on(const std::array<Position, 3> &corner, const Position &x, const double tolerance)
    {
      const Position normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
      const double   size   = std::sqrt(dot(normal, normal));
      if (!(size > 0) || std::abs(dot(minus(x, corner[0]), normal)) > tolerance * size)
        return false;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Position edge = minus(corner[(i + 1) % 3], corner[i]);
          if (dot(cross(edge, minus(x, corner[i])), normal) < -tolerance * size * std::sqrt(dot(edge, edge)))
            return false;
        }
      return true;
    }

    /// Whether @p x lies on one of the triangles between the edges of a face and its middle, and is no corner of it.
    bool lies_on(const PlainMesh &mesh, const Element &face, const Position &x, const double tolerance)
    {
      const unsigned int n = n_corners(face.shape);
      Position           middle{{0, 0, 0}};
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          middle[c] += mesh.points[face.corner[i]][c] / n;
      for (unsigned int i = 0; i < n; ++i)
        if (lies_on({{mesh.points[face.corner[i]], mesh.points[face.corner[(i + 1) % n]], middle}}, x, tolerance))
          return true;
      return false;
    }

    /// Corners of the faces of the boundary, in cubes as large as such a face.
    class BoundaryPoints
    {
    public:
      BoundaryPoints(const PlainMesh &mesh, const std::vector<Element> &outer, const Position &origin)
        : mesh_(mesh)
        , origin_(origin)
      {
        std::vector<bool> is_corner(mesh.points.size(), false);
        for (const Element &face : outer)
          {
            width_ += distance(mesh.points[face.corner[0]], mesh.points[face.corner[2]]) / static_cast<double>(outer.size());
            for (unsigned int i = 0; i < n_corners(face.shape); ++i)
              is_corner[face.corner[i]] = true;
          }
        if (!(width_ > 0))
          width_ = 1;
        for (unsigned int point = 0; point < is_corner.size(); ++point)
          if (is_corner[point])
            cubes_[cube_of(mesh.points[point], 0)].push_back(point);
      }

      /// Those in cubes that the box around @p face touches, but for its own corners.
      std::vector<unsigned int> near(const Element &face, const double tolerance) const
      {
        const unsigned int *const begin = face.corner.data(), *const end = begin + n_corners(face.shape);
        Position low = mesh_.points[*begin], high = low;
        for (const unsigned int *corner = begin; corner < end; ++corner)
          for (unsigned int c = 0; c < 3; ++c)
            {
              low[c]  = std::min(low[c], mesh_.points[*corner][c]);
              high[c] = std::max(high[c], mesh_.points[*corner][c]);
            }
        const Cube                first = cube_of(low, -tolerance), last = cube_of(high, tolerance);
        std::vector<unsigned int> found;
        const auto                take = [&](const std::vector<unsigned int> &points) {
          std::copy_if(points.begin(), points.end(), std::back_inserter(found),
                                      [&](const unsigned int point) { return std::find(begin, end, point) == end; });
        };
        const double n_cubes = (last[0] - first[0] + 1.) * (last[1] - first[1] + 1.) * (last[2] - first[2] + 1.);
        if (n_cubes > static_cast<double>(cubes_.size())) // a face among much smaller ones
          for (const auto &[cube, points] : cubes_)
            take(points);
        else
          for (long i = first[0]; i <= last[0]; ++i)
            for (long j = first[1]; j <= last[1]; ++j)
              for (long k = first[2]; k <= last[2]; ++k)
                if (const auto cube = cubes_.find({{i, j, k}}); cube != cubes_.end())
                  take(cube->second);
        return found;
      }

    private:
      using Cube = std::array<long, 3>;

      Cube cube_of(const Position &x, const double more) const
      {
        Cube cube;
        for (unsigned int c = 0; c < 3; ++c)
          cube[c] = static_cast<long>(std::floor((x[c] + more - origin_[c]) / width_));
        return cube;
      }

      const PlainMesh                          &mesh_;
      Position                                  origin_;
      double                                    width_ = 0;
      std::map<Cube, std::vector<unsigned int>> cubes_;
    };

    /// The mirror image of the numbering.
    void turn(Element &cell)
    {
      auto &v = cell.corner;
      switch (cell.shape)
        {
        case Shape::hexahedron:
          std::swap_ranges(v.begin(), v.begin() + 4, v.begin() + 4);
          break;
        case Shape::wedge:
          std::swap_ranges(v.begin(), v.begin() + 3, v.begin() + 3);
          break;
        case Shape::pyramid:
          std::swap(v[1], v[3]);
          break;
        default:
          std::swap(v[1], v[2]);
        }
    }
  } // namespace

  std::array<Position, 2> box_around(const PlainMesh &mesh)
  {
    constexpr double        infinity = std::numeric_limits<double>::infinity();
    std::array<Position, 2> box{{{{infinity, infinity, infinity}}, {{-infinity, -infinity, -infinity}}}};
    for (const Element &cell : mesh.cells)
      for (unsigned int i = 0; i < n_corners(cell.shape); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          {
            box[0][c] = std::min(box[0][c], mesh.points[cell.corner[i]][c]);
            box[1][c] = std::max(box[1][c], mesh.points[cell.corner[i]][c]);
          }
    return mesh.cells.empty() ? std::array<Position, 2>{} : box;
  }

  Tidying tidy(PlainMesh &mesh)
  {
    Tidying done;
    renumber(mesh, done);
    drop_second_cells(mesh, done);
    for (Element &cell : mesh.cells)
      if (signed_volume(mesh, cell) < 0)
        {
          turn(cell);
          ++done.turned;
        }
    if (done.twice > 0)
      mesh.cell_fields.clear();
    if (done.unused + done.joined > 0)
      mesh.point_fields.clear();
    return done;
  }

  std::vector<Position> hanging_points(const PlainMesh &mesh)
  {
    const std::vector<Element> outer = outer_faces(mesh);
    const auto [low, high]           = box_around(mesh);
    const double          tolerance  = 1e-6 * distance(low, high);
    const BoundaryPoints  points(mesh, outer, low);
    std::vector<Position> hanging;
    for (const Element &face : outer)
      for (const unsigned int point : points.near(face, tolerance))
        if (lies_on(mesh, face, mesh.points[point], tolerance))
          hanging.push_back(mesh.points[point]);
    return hanging;
  }
} // namespace myolines
