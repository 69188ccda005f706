// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/picture/surface.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace myolines::picture
{
  namespace
  {
    /// Numbers of points that lie together, by a grid that is as wide as the tolerance.
    std::vector<std::size_t> merged(const std::vector<Vec> &points)
    {
      Vec low = points.front(), high = low;
      for (const Vec &x : points)
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c]  = std::min(low[c], x[c]);
            high[c] = std::max(high[c], x[c]);
          }
      const double tolerance = std::max((high - low).norm() * 2e-6, 1e-300); // files have floats
      std::unordered_map<std::uint64_t, std::vector<std::size_t>> bins;
      const auto                                                  bin = [&](const Vec &x, const int i, const int j, const int k) {
        const auto number = [&](const unsigned int c, const int shift) {
          return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor((x[c] - low[c]) / tolerance)) + shift) & 0x1FFFFF;
        };
        return number(0, i) | number(1, j) << 21 | number(2, k) << 42;
      };
      std::vector<std::size_t> name(points.size());
      for (std::size_t p = 0; p < points.size(); ++p)
        {
          name[p] = p;
          for (int n = 0; n < 27 && name[p] == p; ++n)
            if (const auto found = bins.find(bin(points[p], n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)); found != bins.end())
              for (const std::size_t other : found->second)
                if ((points[other] - points[p]).norm() <= tolerance)
                  {
                    name[p] = other;
                    break;
                  }
          if (name[p] == p)
            bins[bin(points[p], 0, 0, 0)].push_back(p);
        }
      return name;
    }

    /// Points of the faces of a cell in going round, outwards where the cell is right-handed.
    constexpr unsigned char faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

    void add_edges(const std::vector<std::size_t> &name, Surface &surface)
    {
      std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
      for (const Quad &quad : surface.quads)
        for (unsigned int v = 0; v < 4; ++v)
          {
            const std::size_t a = quad[v], b = quad[(v + 1) % 4];
            const auto [there, is_new] = known.insert({std::minmax(name[a], name[b]), surface.edges.size()});
            if (is_new)
              surface.edges.push_back({a, b, {{quad, quad}}, true});
            else
              {
                surface.edges[there->second].between[1] = quad;
                surface.edges[there->second].open       = false;
              }
          }
    }

    /// The part of a polygon on the near side of the cut; @p height of its corners above the plane.
    void clip(Polygon &polygon, const std::vector<double> &height)
    {
      Polygon           left{{}, {}, polygon.normal};
      const std::size_t n = polygon.corners.size();
      for (std::size_t v = 0; v < n; ++v)
        {
          const std::size_t w = (v + 1) % n;
          if (height[v] <= 0)
            {
              left.corners.push_back(polygon.corners[v]);
              left.values.push_back(polygon.values[v]);
            }
          if ((height[v] <= 0) != (height[w] <= 0))
            {
              const double s = height[v] / (height[v] - height[w]);
              left.corners.push_back(polygon.corners[v] + s * (polygon.corners[w] - polygon.corners[v]));
              left.values.push_back(polygon.values[v] + s * (polygon.values[w] - polygon.values[v]));
            }
        }
      polygon = left;
    }

    /// Where the plane cuts a tetrahedron of points of the body: three or four corners.
    Polygon face_of_cut(const std::array<std::size_t, 4> &points, const Body &body, const std::vector<double> &values,
                        const std::vector<double> &height)
    {
      Polygon                  polygon;
      std::vector<std::size_t> below, above;
      for (const std::size_t p : points)
        (height[p] <= 0 ? below : above).push_back(p);
      const auto add = [&](const std::size_t a, const std::size_t b) {
        const double s = height[a] / (height[a] - height[b]);
        polygon.corners.push_back(body.now[a] + s * (body.now[b] - body.now[a]));
        polygon.values.push_back(values[a] + s * (values[b] - values[a]));
      };
      if (below.size() == 2)
        for (const auto &[i, j] : {std::pair<int, int>{0, 0}, {0, 1}, {1, 1}, {1, 0}}) // going round
          add(below[i], above[j]);
      else
        for (const std::size_t a : below)
          for (const std::size_t b : above)
            add(a, b);
      Vec towards;
      for (const std::size_t a : above)
        towards += body.now[a] / static_cast<double>(above.size());
      if (polygon.corners.size() >= 3)
        {
          polygon.normal = cross_product_3d(polygon.corners[1] - polygon.corners[0], polygon.corners[2] - polygon.corners[0]);
          if (polygon.normal * (towards - polygon.corners[0]) < 0)
            polygon.normal *= -1;
        }
      return polygon;
    }

    bool normalise(Vec &x)
    {
      const double length = x.norm();
      if (length > 0)
        x /= length;
      return length > 0;
    }

    /// Six tetrahedra about the diagonal of a cell.
    constexpr unsigned char tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  } // namespace

  Vec normal(const Quad &quad, const std::vector<Vec> &places)
  {
    return cross_product_3d(places[quad[2]] - places[quad[0]], places[quad[3]] - places[quad[1]]);
  }

  Surface surface_of(const Body &body)
  {
    const std::vector<std::size_t>       name = merged(body.rest);
    std::map<Quad, std::pair<Quad, int>> seen; // sorted points: the face, and how many cells have it
    for (const Body::Cell &cell : body.cells)
      {
        const Vec one = place(body.rest, cell, Vec({0.5, 0.5, 0.5}));
        for (const auto &face : faces)
          {
            Quad quad{{cell[face[0]], cell[face[1]], cell[face[2]], cell[face[3]]}}, key;
            Vec  centre;
            for (unsigned int v = 0; v < 4; ++v)
              {
                key[v] = name[quad[v]];
                centre += body.rest[quad[v]] / 4;
              }
            if (normal(quad, body.rest) * (centre - one) < 0) // a left-handed cell
              std::swap(quad[1], quad[3]);
            std::sort(key.begin(), key.end());
            ++seen.insert({key, {quad, 0}}).first->second.second;
          }
      }
    Surface surface;
    surface.quads = body.faces;
    for (const auto &[key, face] : seen)
      if (face.second == 1)
        surface.quads.push_back(face.first);
    add_edges(name, surface);
    return surface;
  }

  std::vector<Segment> outline(const Surface &surface, const std::vector<Vec> &places, const Vec &direction)
  {
    std::vector<Segment> segments;
    for (const Surface::Edge &edge : surface.edges)
      {
        Vec one = normal(edge.between[0], places), other = normal(edge.between[1], places);
        if (!normalise(one) || !normalise(other))
          continue;
        if (edge.open || one * other < 0.77 || (one * direction < 0) != (other * direction < 0))
          segments.push_back({{places[edge.a], places[edge.b]}});
      }
    return segments;
  }

  std::vector<Polygon> polygons(const Body &body, const Surface &surface, const std::vector<double> &values, const std::optional<Cut> &cut)
  {
    std::vector<Polygon> all;
    std::vector<double>  height;
    if (cut)
      for (const Vec &x : body.rest)
        height.push_back(x[cut->axis] - cut->place);
    for (const Quad &quad : surface.quads)
      {
        Polygon polygon;
        for (const std::size_t p : quad)
          {
            polygon.corners.push_back(body.now[p]);
            polygon.values.push_back(values[p]);
          }
        polygon.normal = normal(quad, body.now);
        if (cut)
          clip(polygon, {height[quad[0]], height[quad[1]], height[quad[2]], height[quad[3]]});
        if (polygon.corners.size() >= 3 && normalise(polygon.normal))
          all.push_back(polygon);
      }
    if (cut)
      for (const Body::Cell &cell : body.cells)
        for (const auto &corners : tetrahedra)
          {
            const std::array<std::size_t, 4> points{{cell[corners[0]], cell[corners[1]], cell[corners[2]], cell[corners[3]]}};
            const auto below = std::count_if(points.begin(), points.end(), [&](const std::size_t p) { return height[p] <= 0; });
            if (below == 0 || below == 4)
              continue;
            Polygon polygon = face_of_cut(points, body, values, height);
            if (normalise(polygon.normal))
              all.push_back(polygon);
          }
    return all;
  }
} // namespace myolines::picture
