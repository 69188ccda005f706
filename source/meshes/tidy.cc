#include <myolines/meshes/tidy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

  std::vector<std::size_t> parts_of(const PlainMesh &mesh)
  {
    std::vector<unsigned int> leader(mesh.points.size());
    std::iota(leader.begin(), leader.end(), 0u);
    const auto find = [&leader](unsigned int v) {
      while (leader[v] != v)
        v = leader[v] = leader[leader[v]];
      return v;
    };
    for (const Element &cell : mesh.cells)
      for (unsigned int i = 1; i < n_corners(cell.shape); ++i)
        leader[find(cell.corner[i])] = find(cell.corner[0]);
    std::map<unsigned int, std::size_t> first;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
      first.emplace(find(mesh.cells[i].corner[0]), i);
    std::vector<std::size_t> parts;
    for (const auto &[point, cell] : first)
      parts.push_back(cell);
    return parts;
  }

  std::vector<Position> hanging_points(const PlainMesh &mesh)
  {
    Places places(mesh);
    for (unsigned int i = 0; i < mesh.points.size(); ++i)
      places.add(i);
    std::vector<Position> hanging;
    const auto            look_at = [&](const std::vector<unsigned int> &corners) {
      Position middle{{0, 0, 0}};
      for (const unsigned int corner : corners)
        for (unsigned int c = 0; c < 3; ++c)
          middle[c] += mesh.points[corner][c] / static_cast<double>(corners.size());
      if (places.find(middle))
        hanging.push_back(middle);
    };
    for (const Element &face : outer_faces(mesh))
      {
        const unsigned int n = n_corners(face.shape);
        for (unsigned int i = 0; i < n; ++i)
          look_at({face.corner[i], face.corner[(i + 1) % n]});
        look_at({face.corner.begin(), face.corner.begin() + n});
      }
    return hanging;
  }
} // namespace myolines
