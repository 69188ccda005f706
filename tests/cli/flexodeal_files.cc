// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_files.h"

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::test;

TEST(FlexodealFiles, AMeshReplacesTheBody)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = flexodeal_options(folder);
  files.parameters         = changed(folder, "set Grid scale          = 1e-3", "set Grid scale = 1");
  files.mesh               = myolines::test::source_folder() + "/input/gastrocnemius_running/gastrocnemius.msh";
  files.ends               = {"proximal end", "distal end"};
  import_flexodeal(files, out);
  const scene::Node scene    = read_whole_scene(files.scene, {});
  const auto       &geometry = scene.section("system").section("geometry");
  EXPECT_EQ(geometry.text("type"), "mesh");
  EXPECT_EQ(geometry.text("scale"), "1");
  EXPECT_EQ(geometry.integer("refinement"), 0) << "meshes of files are not refined";
  const auto &conditions = scene.section("system").section("boundary").named();
  EXPECT_EQ(conditions[0].text("face"), "distal end");
  EXPECT_EQ(conditions[1].text("face"), "proximal end");
  files.ends[1] = "nowhere";
  EXPECT_NE(flexodeal_refusal(files).find("--ends: the body has no face \"nowhere\""), std::string::npos);
}

TEST(FlexodealFiles, AMeshOfItsOwnHasFacesWithNumbers)
{
  const TestFolder folder;
  FlexodealOptions files         = flexodeal_options(folder);
  files.parameters               = complete(folder, "", "0.001");
  files.mesh                     = bar_of_dealii(folder, 1000);
  const scene::Node  system      = system_of(files);
  const auto        &moving      = system.section("boundary").named()[0];
  const auto        &aponeurosis = system.section("tissues").section("aponeurosis").section("fibre");
  std::istringstream along(aponeurosis.text("direction"));
  double             x, y, z;
  along >> x >> y >> z;
  EXPECT_EQ(moving.text("face"), "1");
  EXPECT_EQ(moving.number("reference length"), 0.1);
  EXPECT_EQ(system.section("boundary").named()[1].text("face"), "rest") << "deal.II writes no faces with the number 0";
  EXPECT_EQ(system.section("fibres").number("angle"), 20);
  const double angle = 20 * M_PI / 180, theta = std::asin(0.1 / 0.08 * std::sin(angle)) - angle;
  EXPECT_NEAR(x, std::cos(theta), 1e-12);
  EXPECT_NEAR(z, -std::sin(theta), 1e-12);
  EXPECT_TRUE(system.section("tissues").has("tendon"));

  files.parameters = complete(folder, "");
  EXPECT_NE(flexodeal_refusal(files).find("set Grid scale = 0.001"), std::string::npos) << flexodeal_refusal(files);
}

TEST(FlexodealFiles, PressuresAreLoadsOfFaces)
{
  const TestFolder folder;
  FlexodealOptions files   = flexodeal_options(folder);
  files.pressures          = folder.write("pressure.dat", "t 2 3\n0 0 10\n0.2 100 20\n");
  const scene::Node system = system_of(files);
  const auto       &loads  = system.section("boundary").named();
  ASSERT_EQ(loads.size(), 4u);
  EXPECT_EQ(loads[3].text("face"), "y+");
  EXPECT_EQ(loads[3].text("type"), "pressure");
  EXPECT_EQ(loads[3].number("pressure"), -1);
  EXPECT_EQ(loads[3].section("profile").text("points"), "0 10; 0.2 20");

  const auto points = [&](const std::string &text) {
    files.pressures = folder.write("pressure.dat", text);
    return system_of(files).section("boundary").named()[2].section("profile").text("points");
  };
  EXPECT_EQ(points("#time 2\n0.0 0.0\n1.0 2e5\n"), "0.0 0.0; 1.0 2e5");
  EXPECT_EQ(points("# 2\n0 1e4\n1 1e4\n"), "0 1e4; 1 1e4");
  EXPECT_EQ(points("# in pascal\n\ntime 2 # the side\n0 5\n"), "0 5");
  EXPECT_EQ(points("# on face 3\n#time 2\n0 5\n# 7 7\n"), "0 5");
  const std::vector<std::array<std::string, 2>> refused{{{"t 6\n0 0\n", "line 1: there is no face 6"}},
                                                        {{"\n# 9\n0 0\n", "line 2: there is no face 9"}},
                                                        {{"2 3\n0 1\n", "line 1: there is no line of names"}},
                                                        {{"0 1\n1 1\n", "line 1: there is no line of names"}},
                                                        {{"time 2 2\n0 1 5\n", "line 1: face 2 has two columns"}},
                                                        {{"time,2\n0,1\n", "line 1: \"time,2\" is not understood"}},
                                                        {{"time\n0\n", "line 1: there is no face"}},
                                                        {{"time top\n0 1\n", "line 1: \"top\" is not the number of a face"}},
                                                        {{"#time 2\n", "there is no control point"}},
                                                        {{"# nothing\n", "there is no face"}}};
  for (const auto &[text, message] : refused)
    {
      files.pressures = folder.write("pressure.dat", text);
      EXPECT_NE(flexodeal_refusal(files).find("pressure.dat"), std::string::npos) << text;
      EXPECT_NE(flexodeal_refusal(files).find(message), std::string::npos) << message << " not in\n" << flexodeal_refusal(files);
    }
}

TEST(FlexodealFiles, ControlPointsAsToolsWriteThem)
{
  const TestFolder folder;
  FlexodealOptions files  = flexodeal_options(folder);
  const auto       points = [&](const std::string &text) {
    files.strain = folder.write("strain.dat", text);
    return system_of(files).section("boundary").named()[0].section("strain").text("points");
  };
  EXPECT_EQ(points("0.0000\t0.0000\r\n0.0500\t0.0100\r\n\r\n"), "0.0000 0.0000; 0.0500 0.0100");
  EXPECT_EQ(points("   0.0000000e+00   0.0000000e+00\n   5.0000000E-02   1.0000000E-02\n"),
            "0.0000000e+00 0.0000000e+00; 5.0000000E-02 1.0000000E-02");
  EXPECT_EQ(points("# by hand\n0 0.01 # constant"), "0 0.01");
  const std::vector<std::array<std::string, 2>> refused{
      {{"0.0,0.0\n", "line 1: \"0.0,0.0\" is not understood"}},
      {{"t strain\n0 0\n", "line 1"}},
      {{"% t strain\n0 0\n", "hint: comments begin with #"}},
      {{"0 0\n0.1 x\n", "line 2"}},
      {{"0 0\n\n0.1 0\n0.1 1\n", "line 4: unsorted: time 0.1 follows time 0.1 of line 3"}},
      {{"0.2 1\n0.1 0\n", "line 2: unsorted"}},
      {{"0 0\n0.1 -1.5\n", "line 2: the strain is -1.5"}},
      {{"", "the file is empty"}},
      {{"# nothing\n", "there is no control point"}}};
  for (const auto &[text, message] : refused)
    {
      files.strain = folder.write("strain.dat", text);
      EXPECT_NE(flexodeal_refusal(files).find("strain.dat"), std::string::npos) << text;
      EXPECT_NE(flexodeal_refusal(files).find(message), std::string::npos) << message << " not in\n" << flexodeal_refusal(files);
    }
  files.strain     = flexodeal_data / "strain.dat";
  files.activation = folder.write("activation.dat", "0 0\n0.1 40\n");
  EXPECT_NE(flexodeal_refusal(files).find("activation.dat, line 2: the activation is 40"), std::string::npos);
}

TEST(FlexodealFiles, MarkersAreToldWithTheirLines)
{
  const TestFolder   folder;
  FlexodealOptions   files = flexodeal_options(folder);
  std::ostringstream out;
  files.markers = folder.write("markers.dat", "");
  import_flexodeal(files, out);
  EXPECT_NE(out.str().find("no markers in"), std::string::npos);
  files.markers = folder.write("markers.dat", "p;1 0 0 0\n");
  EXPECT_NE(flexodeal_refusal(files).find("markers.dat, line 1: the name \"p;1\" has a semicolon"), std::string::npos);
  files.markers = folder.write("markers.dat", "a 0 0\n");
  EXPECT_NE(flexodeal_refusal(files).find("markers.dat, line 1"), std::string::npos);
  files.markers = folder.write("markers.dat", "a 0 0 0\nb 0.5 0 0\n");
  EXPECT_NE(flexodeal_refusal(files).find("markers.dat, line 2: marker \"b\" at (0.5 0 0) m lies outside the body"), std::string::npos)
      << flexodeal_refusal(files);
}

TEST(FlexodealFiles, TablesMayNumberTheirRows)
{
  const TestFolder folder;
  FlexodealOptions files = flexodeal_options(folder);
  files.points = folder.write("points.csv", ",qp_x,qp_y,qp_z,max_iso_stress_muscle\n0,0.01,0.005,0.004,1e5\n1,0.02,0.005,0.004,2e5\n");
  EXPECT_EQ(system_of(files).section("fields").file("table").filename(), "points.csv");
  files.points = folder.write("points.csv", "qp_x,qp_y,qp_z,max_iso_stres_muscle\n0.01,0.005,0.004,1e5\n");
  EXPECT_NE(flexodeal_refusal(files).find("points.csv, line 1: unknown column \"max_iso_stres_muscle\""), std::string::npos);
  files.points = folder.write("points.csv", "qp_x,qp_y,qp_z,tissue_id\n0.01,0.005,0.004,5\n");
  EXPECT_NE(flexodeal_refusal(files).find("points.csv, column \"tissue_id\": there is no tissue 5"), std::string::npos)
      << flexodeal_refusal(files);
}
