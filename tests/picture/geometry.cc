// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: surfaces, cuts and lines along the fibres are those of the body, wherever it lies and however it is deformed.

#include "bodies.h"

#include <myolines/picture/fibre_lines.h>
#include <myolines/picture/surface.h>

#include <gtest/gtest.h>

#include <cmath>

namespace myolines::picture
{
  using test::block;

  namespace
  {
    double area(const Polygon &polygon)
    {
      Vec sum;
      for (std::size_t v = 2; v < polygon.corners.size(); ++v)
        sum += cross_product_3d(polygon.corners[v - 1] - polygon.corners[0], polygon.corners[v] - polygon.corners[0]) / 2;
      return sum.norm();
    }

    /// Turned about all axes.
    Vec turned(const Vec &x)
    {
      const double a = 0.4, b = 1.1;
      const Vec    y({std::cos(a) * x[0] - std::sin(a) * x[1], std::sin(a) * x[0] + std::cos(a) * x[1], x[2]});
      return Vec({y[0] + 5, std::cos(b) * y[1] - std::sin(b) * y[2], std::sin(b) * y[1] + std::cos(b) * y[2]});
    }

    /// x -> F x with a stretch and a shear; volume 1.1.
    Vec sheared(const Vec &x) { return Vec({1.1 * x[0] + 0.3 * x[1], x[1] - 0.2 * x[2], x[2]}); }
  } // namespace

  TEST(Surface, IsThatOfTheBlock)
  {
    const Body    body    = block(3, 2, 2, turned);
    const Surface surface = surface_of(body);
    EXPECT_EQ(surface.quads.size(), 2u * (3 * 2 + 2 * 2 + 3 * 2));
    const std::vector<double> values(body.rest.size(), 0);
    double                    whole = 0;
    Vec                       sum, middle = turned(Vec({1.5, 1, 0.5}));
    for (const Polygon &polygon : polygons(body, surface, values, std::nullopt))
      {
        whole += area(polygon);
        sum += area(polygon) * polygon.normal;
        EXPECT_GT(polygon.normal * (polygon.corners[0] - middle), 0) << "outwards";
      }
    EXPECT_NEAR(whole, 22, 1e-12);
    EXPECT_NEAR(sum.norm(), 0, 1e-12) << "a closed surface";
    // Euler: points - edges + faces = 2.
    EXPECT_EQ(surface.edges.size(), surface.quads.size() * 2);
    for (const Surface::Edge &edge : surface.edges)
      EXPECT_FALSE(edge.open);
  }

  TEST(Surface, OfLeftHandedCellsLooksOutwardsToo)
  {
    const Body body = block(2, 1, 1, [](const Vec &x) { return Vec({-x[0], x[1], x[2]}); });
    for (const Polygon &polygon : polygons(body, surface_of(body), std::vector<double>(body.rest.size(), 0), std::nullopt))
      EXPECT_GT(polygon.normal * (polygon.corners[0] - Vec({-1.5, 1, 0.5})), 0);
  }

  TEST(Surface, OutlineOfABlockIsItsTwelveEdges)
  {
    const Body    body    = block(3, 2, 1, test::same);
    const Surface surface = surface_of(body);
    double        length  = 0;
    for (const Segment &segment : outline(surface, body.rest, Vec({0.3, 0.4, 0.8})))
      length += (segment[1] - segment[0]).norm();
    EXPECT_NEAR(length, 4 * (3 + 2 + 1), 1e-12);
  }

  TEST(Cut, LeavesHalfTheBlockAndShowsTheFace)
  {
    Body body = block(4, 3, 2, test::same);
    for (std::size_t p = 0; p < body.rest.size(); ++p)
      body.now[p] = sheared(body.rest[p]);
    std::vector<double> values;
    for (const Vec &x : body.rest)
      values.push_back(2 * x[0] - x[1] + 3 * x[2]);
    double whole = 0, face = 0;
    for (const Polygon &polygon : polygons(body, surface_of(body), values, Cut{0, 1.25}))
      {
        Vec  mean;
        bool on_plane = true;
        for (std::size_t v = 0; v < polygon.corners.size(); ++v)
          {
            const Vec    now = polygon.corners[v]; // F^-1 of it
            const double z = now[2], y = now[1] + 0.2 * z, x = (now[0] - 0.3 * y) / 1.1;
            EXPECT_LE(x, 1.25 + 1e-12);
            EXPECT_NEAR(polygon.values[v], 2 * x - y + 3 * z, 1e-11) << "linear fields are exact";
            on_plane = on_plane && std::abs(x - 1.25) < 1e-12;
          }
        whole += area(polygon);
        face += on_plane ? area(polygon) : 0;
      }
    // The face is spanned by F e_y and F e_z.
    EXPECT_NEAR(face, 2 * cross_product_3d(Vec({0.3, 1, 0}), Vec({0, -0.2, 1})).norm(), 1e-11);
    EXPECT_GT(whole, face);
  }

  TEST(CellLocator, FindsPlacesInSkewCells)
  {
    const Body body = block(5, 4, 3, [](const Vec &x) { return turned(Vec({x[0] + 0.1 * x[1] * x[2], x[1] + 0.05 * x[0] * x[2], x[2]})); });
    const CellLocator locator(body);
    for (std::size_t cell = 0; cell < body.cells.size(); ++cell)
      for (const Vec &xi : {Vec({0.1, 0.9, 0.4}), Vec({0.5, 0.5, 0.5}), Vec({0.97, 0.03, 0.6})})
        {
          const auto found = locator.find(place(body.rest, body.cells[cell], xi));
          ASSERT_TRUE(found) << cell;
          EXPECT_EQ(found->cell, cell);
          EXPECT_NEAR((found->xi - xi).norm(), 0, 1e-8);
        }
    EXPECT_FALSE(locator.find(turned(Vec({-0.2, 1, 0.5}))));
    EXPECT_FALSE(locator.find(Vec({1e9, 0, 0})));
  }

  TEST(FibreLines, AreStraightAtRestWhateverTheDeformation)
  {
    Body      body = block(6, 4, 3, test::same);
    const Vec a0   = Vec({0.8, 0.6, 0});
    Vec       a;
    for (std::size_t p = 0; p < body.rest.size(); ++p)
      body.now[p] = sheared(body.rest[p]);
    a = sheared(a0);
    a /= a.norm();
    test::add_vector_field(body, "fibre direction", [&](const Vec &) { return a; });
    const auto lines = fibre_lines(body, 12);
    ASSERT_EQ(lines.size(), 12u);
    for (const auto &line : lines)
      {
        const Vec along = line.back() - line.front();
        EXPECT_NEAR(std::abs(along * a0), along.norm(), 1e-9);
        double length = 0;
        for (std::size_t i = 1; i < line.size(); ++i)
          length += (line[i] - line[i - 1]).norm();
        EXPECT_NEAR(length, along.norm(), 1e-9);
        for (const Vec &end : {line.front(), line.back()})
          {
            double outside = 1e9; // distance to the surface
            for (unsigned int c = 0; c < 2; ++c)
              outside = std::min({outside, std::abs(end[c]), std::abs(end[c] - (c == 0 ? 3 : 2))});
            EXPECT_LT(outside, 2e-3) << "from surface to surface";
          }
      }
    std::vector<double> values;
    for (const Vec &x : body.rest)
      values.push_back(x[0]);
    const auto now = follow(lines, body, values);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t k = 0; k < lines[i].size(); ++k)
        {
          EXPECT_NEAR((now[i][k].now - sheared(lines[i][k])).norm(), 0, 1e-8);
          EXPECT_NEAR(now[i][k].value, lines[i][k][0], 1e-8);
        }
  }

  TEST(FibreLines, EndAtOtherTissues)
  {
    Body body = block(6, 2, 2, test::same);
    test::add_vector_field(body, "fibre direction", [](const Vec &) { return Vec({1, 0, 0}); });
    picture::Field tissue{"tissue", 1, {}};
    for (const Body::Cell &cell : body.cells)
      for (std::size_t v = 0; v < 8; ++v)
        tissue.values.push_back(body.rest[cell[0]][0] < 0.9 ? 2 : 1);
    body.fields.push_back(tissue);
    for (const auto &line : fibre_lines(body, 4))
      {
        const auto ends = std::minmax(line.front()[0], line.back()[0]);
        EXPECT_NEAR(ends.first, 1, 2e-3);
        EXPECT_NEAR(ends.second, 3, 2e-3);
      }
  }
} // namespace myolines::picture
