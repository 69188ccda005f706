// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: fields of the surface alone have its area and look outwards, hold what fields of the whole body hold there, and are the same
// in either format and on any number of ranks; `picture` and `report` read them.

#include "program_runner.h"
#include "ranks.h"
#include "small_scenes.h"

#include <myolines/picture/surface.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace pictures = myolines::picture;

namespace
{
  const std::array<double, 3> sides{{0.03, 0.01, 0.02}};

  /// Turned about two axes and moved.
  pictures::Vec turned(const pictures::Vec &x)
  {
    const double        a = 0.7, b = -0.4;
    const pictures::Vec y({std::cos(a) * x[0] - std::sin(a) * x[1], std::sin(a) * x[0] + std::cos(a) * x[1], x[2]});
    return pictures::Vec({y[0] + 0.02, std::cos(b) * y[1] - std::sin(b) * y[2], std::sin(b) * y[1] + std::cos(b) * y[2] - 0.01});
  }

  /// The motion of affine_motion: x -> F x with F = [1.1 0.2 0; 0 1 0; 0 0 0.95].
  pictures::Vec     stretched(const pictures::Vec &x) { return pictures::Vec({1.1 * x[0] + 0.2 * x[1], x[1], 0.95 * x[2]}); }
  const std::string affine_motion =
      " --set \"system/initial motion/displacement x=0.1*x + 0.2*y\" --set \"system/initial motion/displacement "
      "z=-0.05*z\" --set time/step=1e-6 --set time/end=1e-6"; // the start is looked at

  /// A block as it lies, without conditions.
  std::string free_scene(const std::string &geometry)
  {
    std::string       scene = muscle_scene;
    const std::size_t from  = scene.find("    <ParameterList name=\"boundary\">"),
                      to    = scene.find("  </ParameterList>\n  <ParameterList name=\"integrator\">");
    scene.replace(from, to - from, "");
    const std::size_t begin = scene.find("      <Parameter name=\"length\""), end = scene.find("    </ParameterList>", begin);
    return scene.replace(begin, end - begin, geometry);
  }

  std::string block_geometry()
  {
    return "<Parameter name=\"length\" type=\"double\" value=\"0.03\"/><Parameter name=\"width\" type=\"double\" value=\"0.01\"/>"
           "<Parameter name=\"height\" type=\"double\" value=\"0.02\"/>";
  }

  /// The turned block of six tetrahedra about a diagonal.
  std::string mesh_of_tetrahedra()
  {
    std::string points = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
    for (int v = 0; v < 8; ++v)
      {
        const pictures::Vec x = turned(pictures::Vec({v % 2 * sides[0], v / 2 % 2 * sides[1], v / 4 * sides[2]}));
        char                line[120];
        std::snprintf(line, sizeof line, "%d %.17g %.17g %.17g\n", v + 1, x[0], x[1], x[2]);
        points += line;
      }
    return points + "$EndNodes\n$Elements\n6\n1 4 2 1 1 1 2 4 8\n2 4 2 1 1 1 4 3 8\n3 4 2 1 1 1 3 7 8\n4 4 2 1 1 1 7 5 8\n5 4 2 1 1 1 5 6 "
                    "8\n6 4 2 1 1 1 6 2 8\n$EndElements\n";
  }

  struct Measured
  {
    double        area = 0, volume = 0;
    pictures::Vec sum; ///< of areas with their normals
  };

  /// Flat faces alone.
  Measured measured(const pictures::Body &body, const std::vector<pictures::Vec> &places)
  {
    Measured all;
    for (const pictures::Body::Face &face : body.faces)
      {
        const pictures::Vec &a = places[face[0]], &b = places[face[1]], &c = places[face[2]], &d = places[face[3]];
        const pictures::Vec  area = cross_product_3d(c - a, d - b) / 2;
        all.area += area.norm();
        all.sum += area;
        all.volume += (a * cross_product_3d(b, c) + a * cross_product_3d(c, d)) / 6;
      }
    return all;
  }

  double area_of(const pictures::Vec &edge_1, const pictures::Vec &edge_2) { return cross_product_3d(edge_1, edge_2).norm(); }

  pictures::Body last(const TestFolder &folder, const std::string &name)
  {
    const pictures::RunFields fields(folder / name);
    return fields.read(fields.size() - 1);
  }

  /// Whether each face of @p one is a face of @p other that goes round the same way, with the same fields at its corners.
  void expect_same(const pictures::Body &one, const pictures::Body &other, const std::string &which)
  {
    ASSERT_EQ(one.faces.size(), other.faces.size()) << which;
    ASSERT_EQ(one.fields.size(), other.fields.size()) << which;
    for (const pictures::Body::Face &face : one.faces)
      {
        const auto distance = [&](const pictures::Body::Face &there, const std::size_t first) {
          double sum = 0;
          for (std::size_t v = 0; v < 4; ++v)
            sum += (one.rest[face[v]] - other.rest[there[(v + first) % 4]]).norm();
          return sum;
        };
        bool found = false;
        for (std::size_t f = 0; f < other.faces.size() && !found; ++f)
          for (std::size_t first = 0; first < 4 && !found; ++first)
            if (distance(other.faces[f], first) < 1e-8)
              {
                found = true;
                for (const pictures::Field &field : one.fields)
                  for (std::size_t v = 0; v < 4; ++v)
                    for (unsigned int c = 0; c < field.n_components; ++c)
                      {
                        const double a = field.values[face[v] * field.n_components + c],
                                     b = other.find(field.name)->values[other.faces[f][(v + first) % 4] * field.n_components + c];
                        EXPECT_NEAR(a, b, 1e-5 * std::abs(a) + 1e-9) << which << ", " << field.name;
                      }
              }
        ASSERT_TRUE(found) << which;
      }
  }

  /// The surface of a body alone.
  pictures::Body peeled(pictures::Body body)
  {
    body.faces = surface_of(body).quads;
    body.cells.clear();
    return body;
  }

  const std::string surface_fields =
      " --quiet --overwrite --set \"output/fields/what=displacement, stretch, pressure, fibre direction, von mises "
      "stress\" --set \"output/fields/surface only=true\" ";
} // namespace

TEST(SurfaceFields, HaveTheAreaOfTheBlockBeforeAndAfterAMotion)
{
  const TestFolder folder;
  folder.write("block.xml", free_scene(block_geometry()));
  folder.write("tetrahedra.xml", free_scene("<Parameter name=\"type\" type=\"string\" value=\"gmsh\"/>"
                                            "<Parameter name=\"file\" type=\"string\" value=\"body.msh\"/></ParameterList>"
                                            "<ParameterList name=\"fibres\"><Parameter name=\"type\" type=\"string\" value=\"direction\"/>"
                                            "<Parameter name=\"x\" type=\"double\" value=\"1\"/>"));
  folder.write("body.msh", mesh_of_tetrahedra());
  for (const bool is_turned : {false, true})
    for (const char *format : {"vtu", "hdf5"})
      for (const char *degree : {"1", "2", "3"})
        {
          if (std::string(degree) == "3" && (is_turned || std::string(format) == "hdf5"))
            continue; // takes long, and tells nothing more
          const std::string which = std::string(is_turned ? "tetrahedra, " : "block, ") + format + ", degree " + degree;
          const Outcome     run =
              run_program(folder, std::string("run ") + (is_turned ? "tetrahedra" : "block") + ".xml --out run" + surface_fields +
                                      "--set system/discretisation/degree=" + degree + " --set \"system/discretisation/quadrature points=" +
                                      std::to_string(std::stoi(degree) + 2) + "\" --set output/fields/format=" + format + affine_motion +
                                      (is_turned ? " --unset output/series/markers" : ""));
          ASSERT_EQ(run.exit_code, 0) << which << run.err;
          const pictures::Body body = pictures::RunFields(folder / "run").read(0);
          EXPECT_TRUE(body.is_surface());
          const pictures::Vec          origin = is_turned ? turned(pictures::Vec()) : pictures::Vec();
          std::array<pictures::Vec, 3> edges;
          double                       area = 0, area_now = 0, volume = 1;
          for (unsigned int c = 0; c < 3; ++c)
            {
              pictures::Vec end;
              end[c]   = sides[c];
              edges[c] = is_turned ? turned(end) - origin : end;
              volume *= sides[c];
            }
          for (unsigned int c = 0; c < 3; ++c)
            {
              area += 2 * area_of(edges[c], edges[(c + 1) % 3]);
              area_now += 2 * area_of(stretched(edges[c]), stretched(edges[(c + 1) % 3]));
            }
          const Measured rest = measured(body, body.rest), now = measured(body, body.now);
          EXPECT_NEAR(rest.area, area, 1e-6 * area) << which;
          EXPECT_NEAR(rest.volume, volume, 1e-6 * volume) << which << ": outwards";
          EXPECT_LT(rest.sum.norm(), 1e-6 * area) << which << ": closed";
          EXPECT_NEAR(now.area, area_now, 1e-6 * area_now) << which;
          EXPECT_NEAR(now.volume, 1.1 * 0.95 * volume, 1e-6 * volume) << which;
        }
}

TEST(SurfaceFields, AreThoseOfTheWholeBodyAndSmaller)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  const std::string finer =
      "--set system/geometry/refinement=2 --set system/discretisation/degree=2 --set \"system/discretisation/quadrature points=3\"";
  ASSERT_EQ(run_program(folder, "run scene.xml --out surface" + surface_fields + finer).exit_code, 0);
  ASSERT_EQ(
      run_program(folder, "run scene.xml --out whole" + surface_fields + finer + " --set \"output/fields/surface only=false\"").exit_code,
      0);
  const pictures::Body surface = last(folder, "surface"), whole = last(folder, "whole");
  expect_same(surface, peeled(whole), "the whole");
  const auto size = [&](const std::string &run) { return std::filesystem::file_size(folder / (run + "/fields-0001.vtu")); };
  EXPECT_LT(3 * size("surface"), 2 * size("whole")); // 96 faces of 64 cells
}

TEST(SurfaceFields, DoNotDependOnRanksAndFormat)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene); // one cell: further ranks have none
  const std::string command = "run scene.xml" + surface_fields +
                              "--set system/discretisation/degree=2 --set \"system/discretisation/quadrature "
                              "points=3\" --set output/fields/format=";
  ASSERT_EQ(run_program(folder, command + "vtu --out one").exit_code, 0);
  const pictures::Body one = last(folder, "one");
  struct Shared
  {
    const char *name, *format;
    int         ranks;
    bool        whole;
  };
  for (const Shared &shared :
       {Shared{"vtu3", "vtu", 3, false}, {"hdf5_2", "hdf5", 2, false}, {"hdf5_3_whole", "hdf5", 3, true}, {"vtu2_whole", "vtu", 2, true}})
    {
      const std::string whole = shared.whole ? " --set \"output/fields/surface only=false\"" : "";
      ASSERT_EQ(run_program(folder, command + shared.format + " --out " + shared.name + whole, on_ranks(shared.ranks)).exit_code, 0)
          << contents(folder / "err.txt");
      const pictures::Body body = last(folder, shared.name);
      expect_same(one, shared.whole ? peeled(body) : body, shared.name);
    }
  EXPECT_TRUE(std::filesystem::exists(folder / "vtu3/fields_0000.pvtu"));
  // Several cells on each rank.
  const std::string finer = " --set system/geometry/refinement=2 ";
  ASSERT_EQ(run_program(folder, command + "vtu --out fine" + finer).exit_code, 0);
  ASSERT_EQ(run_program(folder, command + "vtu --out shared" + finer, on_ranks(3)).exit_code, 0) << contents(folder / "err.txt");
  EXPECT_TRUE(std::filesystem::exists(folder / "shared/fields_0000.2.vtu"));
  ASSERT_EQ(run_program(folder, command + "hdf5 --out shared_hdf5" + finer, on_ranks(2)).exit_code, 0) << contents(folder / "err.txt");
  expect_same(last(folder, "fine"), last(folder, "shared"), "three ranks");
  expect_same(last(folder, "fine"), last(folder, "shared_hdf5"), "two ranks");
}

TEST(SurfaceFields, ArePicturedAndReported)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  ASSERT_EQ(run_program(folder, "run scene.xml --out run" + surface_fields).exit_code, 0);
  EXPECT_EQ(run_program(folder, "picture run --field pressure").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "run/pictures/pressure.png"));
  for (const char *inside : {"--fibres 5", "--cut z:0.5"})
    {
      const Outcome refused = run_program(folder, std::string("picture run ") + inside);
      EXPECT_EQ(refused.exit_code, 2);
      EXPECT_NE(refused.err.find("surface alone"), std::string::npos) << refused.err;
    }
  const Outcome report = run_program(folder, "report run");
  ASSERT_EQ(report.exit_code, 0) << report.err;
  const std::string html = contents(folder / "run/report.html");
  EXPECT_NE(html.find("stretch, least"), std::string::npos);
  EXPECT_NE(html.find("of the surface alone"), std::string::npos);
}
