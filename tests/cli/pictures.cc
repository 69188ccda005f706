// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: fields that a run writes are read back as they are, in either format and with cells of any degree; `picture`, `report`,
// `plot` and `check --brief` tell of a run what it is.

#include "../picture/decoded_png.h"
#include "program_runner.h"
#include "small_scenes.h"

#include <myolines/picture/body.h>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace pictures = myolines::picture;

namespace
{
  /// A block that begins stretched and sheared: u = G x with F = 1 + G the same everywhere.
  std::string affine_run(const std::string &more)
  {
    return "run scene.xml --quiet --overwrite --set \"system/initial motion/displacement x=0.1*x + 0.2*y\" --set \"system/initial "
           "motion/displacement "
           "z=-0.05*z\" --set time/end=0.02 " +
           more;
  }

  const std::string all_tensors =
      "displacement, stress xx, stress yy, stress zz, stress xy, stress yz, stress zx, von mises stress, principal stress 1, "
      "principal stress 2, principal stress 3, green strain xx, green strain yy, green strain zz, green strain xy, "
      "principal green strain 1, principal green strain 3, fibre direction, fibre direction at rest, "
      "principal green strain direction 1, principal green strain direction 3, principal stress direction 1";

  double at(const pictures::Body &body, const std::string &field, const std::size_t p)
  {
    const pictures::Field *found = body.find(field);
    if (found == nullptr)
      throw std::runtime_error("no field " + field);
    return found->values[p];
  }

  pictures::Vec vector_at(const pictures::Body &body, const std::string &field, const std::size_t p)
  {
    const pictures::Field *found = body.find(field);
    if (found == nullptr || found->n_components != 3)
      throw std::runtime_error("no vector field " + field);
    return pictures::Vec({found->values[3 * p], found->values[3 * p + 1], found->values[3 * p + 2]});
  }

  /// The scene without conditions, so that the initial motion is all of the motion.
  std::string free_block()
  {
    std::string       scene = muscle_scene;
    const std::size_t from  = scene.find("    <ParameterList name=\"boundary\">"),
                      to    = scene.find("  </ParameterList>\n  <ParameterList name=\"integrator\">");
    return scene.replace(from, to - from, "");
  }
} // namespace

TEST(Fields, TensorsAreThoseOfAnAffineMotion)
{
  const TestFolder folder;
  folder.write("scene.xml", free_block());
  const Outcome run = run_program(folder, affine_run("--out run --set \"output/fields/what=" + all_tensors + "\""));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const pictures::Body body = pictures::RunFields(folder / "run").read(0);
  ASSERT_GT(body.rest.size(), 0u);
  for (std::size_t p = 0; p < body.rest.size(); ++p)
    {
      const pictures::Vec &X = body.rest[p];
      EXPECT_NEAR(body.now[p][0], 1.1 * X[0] + 0.2 * X[1], 1e-8);
      // E = (F^T F - 1) / 2 with F = [1.1 0.2 0; 0 1 0; 0 0 0.95].
      EXPECT_NEAR(at(body, "green strain xx", p), (1.21 - 1) / 2, 1e-6);
      EXPECT_NEAR(at(body, "green strain yy", p), 0.04 / 2, 1e-6);
      EXPECT_NEAR(at(body, "green strain zz", p), (0.9025 - 1) / 2, 1e-6);
      EXPECT_NEAR(at(body, "green strain xy", p), 0.22 / 2, 1e-6);
      // The principal values of the xy block: mean +- sqrt(half difference^2 + shear^2).
      const double mean = (0.105 + 0.02) / 2, reach = std::hypot((0.105 - 0.02) / 2, 0.11);
      EXPECT_NEAR(at(body, "principal green strain 1", p), mean + reach, 1e-6);
      EXPECT_NEAR(at(body, "principal green strain 3", p), std::min(mean - reach, (0.9025 - 1) / 2), 1e-6);
      const double xx = at(body, "stress xx", p), yy = at(body, "stress yy", p), zz = at(body, "stress zz", p),
                   xy = at(body, "stress xy", p), yz = at(body, "stress yz", p), zx = at(body, "stress zx", p);
      const double mises =
          std::sqrt(((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) / 2 + 3 * (xy * xy + yz * yz + zx * zx));
      const double size = std::abs(xx) + std::abs(yy) + std::abs(zz);
      EXPECT_GT(size, 1) << "[Pa]";
      EXPECT_NEAR(at(body, "von mises stress", p), mises, 1e-5 * size);
      EXPECT_NEAR(at(body, "principal stress 1", p) + at(body, "principal stress 2", p) + at(body, "principal stress 3", p), xx + yy + zz,
                  1e-5 * size);
      EXPECT_GE(at(body, "principal stress 1", p), at(body, "principal stress 3", p));

      const pictures::Vec a0 = vector_at(body, "fibre direction at rest", p);
      EXPECT_NEAR(a0.norm(), 1, 1e-6);
      const pictures::Vec a({1.1 * a0[0] + 0.2 * a0[1], a0[1], 0.95 * a0[2]});
      EXPECT_NEAR((vector_at(body, "fibre direction", p) - a / a.norm()).norm(), 0, 1e-6);
      const auto strained = [](const pictures::Vec &d) {
        return pictures::Vec({0.105 * d[0] + 0.11 * d[1], 0.11 * d[0] + 0.02 * d[1], (0.9025 - 1) / 2 * d[2]});
      };
      for (const char *which : {"1", "3"})
        {
          const pictures::Vec d = vector_at(body, std::string("principal green strain direction ") + which, p);
          EXPECT_NEAR(d.norm(), 1, 1e-6);
          EXPECT_NEAR((strained(d) - at(body, std::string("principal green strain ") + which, p) * d).norm(), 0, 1e-6);
        }
      const pictures::Vec s = vector_at(body, "principal stress direction 1", p);
      const pictures::Vec stressed(
          {xx * s[0] + xy * s[1] + zx * s[2], xy * s[0] + yy * s[1] + yz * s[2], zx * s[0] + yz * s[1] + zz * s[2]});
      EXPECT_NEAR((stressed - at(body, "principal stress 1", p) * s).norm(), 0, 1e-5 * size);
    }
}

/// At every point that is written, between the nodes of the projection, too, and in the middle of a state that is not homogeneous.
TEST(Fields, DirectionsAreThoseOfTheTensorWrittenThere)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  std::string what = "displacement, principal green strain direction 1, principal green strain direction 2";
  for (const char *component : {"xx", "yy", "zz", "xy", "yz", "zx"})
    what += std::string(", green strain ") + component;
  ASSERT_EQ(run_program(folder, "run scene.xml --quiet --out run --set system/discretisation/degree=3 --set \"system/discretisation/"
                                "quadrature points=4\" --set time/start=0 --set \"output/fields/what=" +
                                    what + "\"")
                .exit_code,
            0);
  const pictures::RunFields fields(folder / "run");
  const pictures::Body      body  = fields.read(fields.size() - 1);
  std::size_t               apart = 0;
  for (std::size_t p = 0; p < body.rest.size(); ++p)
    for (const char *which : {"1", "2"})
      {
        const auto          e = [&](const char *component) { return at(body, std::string("green strain ") + component, p); };
        const pictures::Vec d = vector_at(body, std::string("principal green strain direction ") + which, p),
                            strained({e("xx") * d[0] + e("xy") * d[1] + e("zx") * d[2], e("xy") * d[0] + e("yy") * d[1] + e("yz") * d[2],
                                      e("zx") * d[0] + e("yz") * d[1] + e("zz") * d[2]});
        EXPECT_NEAR((strained - (strained * d) * d).norm(), 0, 1e-5) << p;
        EXPECT_LT(std::abs(d.norm() * (d.norm() - 1)), 1e-6) << p << ": of length one, or none where two values are the same";
        apart += d.norm() > 0.5;
      }
  EXPECT_GT(apart, body.rest.size());
}

TEST(Fields, OfAStateWithoutStrainHaveNoPrincipalDirections)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  ASSERT_EQ(
      run_program(folder, "run scene.xml --quiet --out run --set \"output/fields/what=displacement, principal green strain direction 1\"")
          .exit_code,
      0);
  const pictures::Body start = pictures::RunFields(folder / "run").read(0);
  for (std::size_t p = 0; p < start.rest.size(); ++p)
    EXPECT_EQ(vector_at(start, "principal green strain direction 1", p).norm(), 0);
}

TEST(Fields, AreWrittenAtGivenTimes)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  const std::string run = "run scene.xml --quiet --overwrite --out run --set \"output/fields/at=";
  ASSERT_EQ(run_program(folder, run + "0.013 0.04\"").exit_code, 0);
  const pictures::RunFields fields(folder / "run");
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_NEAR(fields.time(0), 0.013, 1e-15);
  EXPECT_NEAR(fields.time(1), 0.04, 1e-15);
  ASSERT_EQ(run_program(folder, run + "0 0.02\" --set output/fields/format=hdf5").exit_code, 0);
  EXPECT_EQ(pictures::RunFields(folder / "run").size(), 2u) << "the start, and a step that ends there by itself";
  EXPECT_NE(run_program(folder, "check scene.xml --set output/fields/at=0.013").out.find("Steps: 3 "), std::string::npos);
  for (const char *wrong : {"0.05\"", "-1\"", "soon\"", "0.01\" --set output/fields/every=2"})
    {
      const Outcome outcome = run_program(folder, run + wrong);
      EXPECT_EQ(outcome.exit_code, 2) << wrong;
      EXPECT_TRUE(std::regex_search(outcome.err, std::regex("output/fields/at|list \"at\""))) << outcome.err;
    }
}

TEST(Fields, AreTheSameInBothFormatsAndForAnyDegree)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  for (const char *degree : {"1", "2", "3"})
    {
      const std::string run = std::string("run scene.xml --quiet --overwrite --set system/discretisation/degree=") + degree +
                              " --set \"system/discretisation/quadrature points=" + std::to_string(std::stoi(degree) + 2) +
                              "\" --set \"output/fields/what=displacement, stretch\" --set output/fields/format=";
      ASSERT_EQ(run_program(folder, run + "vtu --out vtu").exit_code, 0);
      ASSERT_EQ(run_program(folder, run + "hdf5 --out hdf5").exit_code, 0);
      const pictures::RunFields vtu(folder / "vtu"), hdf5(folder / "hdf5");
      ASSERT_EQ(vtu.size(), hdf5.size());
      const pictures::Body a = vtu.read(vtu.size() - 1), b = hdf5.read(hdf5.size() - 1);
      EXPECT_NEAR(a.t, b.t, 1e-12);
      ASSERT_EQ(a.cells.size(), b.cells.size()) << degree;
      // Cells come in one order; each is the same hexahedron with the same values, which tells wrong orders of points.
      for (std::size_t c = 0; c < a.cells.size(); ++c)
        {
          std::size_t         other  = b.cells.size();
          const pictures::Vec centre = pictures::place(a.rest, a.cells[c], pictures::Vec({0.5, 0.5, 0.5}));
          for (std::size_t d = 0; d < b.cells.size(); ++d)
            if ((pictures::place(b.rest, b.cells[d], pictures::Vec({0.5, 0.5, 0.5})) - centre).norm() < 1e-8)
              other = d;
          ASSERT_LT(other, b.cells.size()) << degree;
          for (const pictures::Vec &xi : {pictures::Vec({0.1, 0.2, 0.9}), pictures::Vec({0.9, 0.4, 0.1}), pictures::Vec({0.3, 0.8, 0.6})})
            {
              EXPECT_NEAR((pictures::place(a.rest, a.cells[c], xi) - pictures::place(b.rest, b.cells[other], xi)).norm(), 0, 1e-8)
                  << degree;
              EXPECT_NEAR((pictures::place(a.now, a.cells[c], xi) - pictures::place(b.now, b.cells[other], xi)).norm(), 0, 1e-8) << degree;
              EXPECT_NEAR(pictures::value(*a.find("stretch"), 0, a.cells[c], xi),
                          pictures::value(*b.find("stretch"), 0, b.cells[other], xi), 1e-6)
                  << degree;
            }
        }
    }
}

TEST(Pictures, AreDrawnOfARun)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  ASSERT_EQ(
      run_program(folder, "run scene.xml --quiet --out run --set \"output/fields/what=displacement, stretch, fibre direction\"").exit_code,
      0);
  const Outcome first = run_program(folder, "picture run --fibres 5 --cut z:0.5");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(contents(folder / "run/pictures/stretch_fibres_cut_z_0.5.png").substr(1, 3), "PNG");
  EXPECT_NE(contents(folder / "run/pictures/stretch_fibres_cut_z_0.5.svg").find("t = 0.04 s"), std::string::npos);
  EXPECT_EQ(run_program(folder, "picture run run --field \"displacement x\" --frames --out films").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "films/displacement_x-0002.png"));
  EXPECT_NE(contents(folder / "films/displacement_x_animation.png").find("acTL"), std::string::npos);
  const Outcome unknown = run_program(folder, "picture run --field stress");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("displacement x"), std::string::npos) << "what there is";
  EXPECT_EQ(run_program(folder, "picture run --cut w:2").exit_code, 2);
  std::filesystem::resize_file(folder / "run/fields-0001.vtu", std::filesystem::file_size(folder / "run/fields-0001.vtu") / 2);
  EXPECT_EQ(run_program(folder, "picture run --frames").exit_code, 2) << "a damaged file is told";
  // The next run there takes the pictures away, with what else was of the former one.
  ASSERT_EQ(run_program(folder, "run scene.xml --quiet --out run --overwrite").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "run/pictures/stretch_fibres_cut_z_0.5.png"));
  const Outcome none = run_program(folder, "picture run");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("output/fields/what"), std::string::npos) << "how to get some";
}

TEST(Pictures, FramesOfRunsWithOtherTimesShareScaleAndFrame)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  const std::string run = "run scene.xml --quiet --set \"output/fields/what=displacement, stretch\" --out ";
  ASSERT_EQ(run_program(folder, run + "few").exit_code, 0);                                           // 0, 0.02, 0.04 s
  ASSERT_EQ(run_program(folder, run + "many --set time/step=0.01 --set time/end=0.03").exit_code, 0); // 0, 0.01, 0.02, 0.03 s
  for (const char *order : {"few many", "many few"})
    {
      const Outcome film = run_program(folder, std::string("picture ") + order + " --frames --out films");
      ASSERT_EQ(film.exit_code, 0) << film.err;
      EXPECT_NE(film.out.find("6 pictures"), std::string::npos) << "five times and the animation: " << film.out;
      std::vector<pictures::Pixels> frames;
      for (int i = 0; i < 5; ++i)
        frames.push_back(myolines::test::decoded(contents(folder / ("films/stretch-000" + std::to_string(i) + ".png"))));
      EXPECT_FALSE(std::filesystem::exists(folder / "films/stretch-0005.png"));
      const auto strip = [](const pictures::Pixels &pixels, const double from, const double to) {
        std::vector<std::uint8_t> part;
        for (std::size_t y = 60; y < pixels.height; ++y) // below the titles
          for (std::size_t x = static_cast<std::size_t>(from * pixels.width); x < to * pixels.width; ++x)
            part.insert(part.end(), &pixels.rgb[3 * (y * pixels.width + x)], &pixels.rgb[3 * (y * pixels.width + x)] + 3);
        return part;
      };
      for (const pictures::Pixels &frame : frames)
        {
          ASSERT_EQ(frame.width, frames[0].width);
          ASSERT_EQ(frame.height, frames[0].height);
          EXPECT_EQ(strip(frame, 0.86, 1), strip(frames[0], 0.86, 1)) << "the colour bar";
        }
      EXPECT_NE(strip(frames[4], 0, 0.84), strip(frames[0], 0, 0.84)) << "the bodies move";
      EXPECT_NE(strip(frames[1], 0, 0.84), strip(frames[2], 0, 0.84));
    }
}

TEST(Pictures, ARunThatFailedInItsFirstStepSaysSo)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  EXPECT_EQ(run_program(folder,
                        "run scene.xml --quiet --out run --set \"solver/nonlinear/maximum iterations=1\" --set \"system/boundary/moving "
                        "end/strain/points=0 0; 0.02 0.9\"")
                .exit_code,
            3);
  const Outcome plot = run_program(folder, "plot run");
  EXPECT_EQ(plot.exit_code, 2);
  EXPECT_NE(plot.err.find("the tables have the start alone, as no step was written: "), std::string::npos) << plot.err;
  ASSERT_EQ(run_program(folder, "report run").exit_code, 0);
  const std::string html = contents(folder / "run/report.html");
  EXPECT_NE(html.find("Values at the start ("), std::string::npos);
  EXPECT_EQ(html.find("What stays constant"), std::string::npos);
}

TEST(Pictures, PlotHasAnIndexAndNoConstants)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  ASSERT_EQ(run_program(folder, "run scene.xml --quiet --out run").exit_code, 0);
  const Outcome plot = run_program(folder, "plot run");
  ASSERT_EQ(plot.exit_code, 0) << plot.err;
  const std::string index = contents(folder / "run/pictures/index.html");
  EXPECT_NE(index.find("Forces with which the boundary conditions pull on the body"), std::string::npos);
  EXPECT_NE(index.find("What stays constant"), std::string::npos);
  std::size_t n = 0;
  for (std::size_t at = index.find("<img src=\""); at != std::string::npos; at = index.find("<img src=\"", at + 1))
    {
      const std::size_t begin = at + 10;
      EXPECT_TRUE(std::filesystem::exists(folder / "run/pictures" / index.substr(begin, index.find('"', begin) - begin)));
      ++n;
    }
  EXPECT_GT(n, 2u);
}

TEST(Report, OfARunHasWhatDiffersFromDefaults)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  ASSERT_EQ(run_program(folder, "run scene.xml --quiet --out run --set \"output/fields/what=displacement, stretch\"").exit_code, 0);
  const Outcome report = run_program(folder, "report run");
  ASSERT_EQ(report.exit_code, 0) << report.err;
  const std::string html = contents(folder / "run/report.html");
  EXPECT_NE(html.find("<h1>one cell</h1>"), std::string::npos);
  EXPECT_NE(html.find("<td>time/step</td><td>0.02 s</td>"), std::string::npos);
  EXPECT_EQ(html.find("<td>solver/linear/restart</td>"), std::string::npos) << "a default";
  EXPECT_NE(html.find("<tr><td>output quadrature</td><td>not asked for</td></tr>"), std::string::npos) << "what was skipped";
  EXPECT_NE(html.find("drift of the energy balance"), std::string::npos);
  EXPECT_NE(html.find("stretch, least"), std::string::npos);
  EXPECT_NE(html.find("<td>force of moving end, along the line of action</td>"), std::string::npos);
  EXPECT_NE(html.find("Fibres of the muscle "), std::string::npos);
  EXPECT_TRUE(std::regex_search(
      html, std::regex("myolines verify [^ ]*scene.xml --quantity &#39;reaction.csv:moving end along the line \\[N\\]&#39;")));
  EXPECT_LT(html.size(), 6000000u);
}

TEST(Check, BriefTellsTheCost)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  const Outcome check = run_program(folder, "check scene.xml --brief");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  for (const char *words : {"unknowns: ", "steps: 2, from 0 s to 0.04 s", "memory of a rank: about ", "cost: about "})
    EXPECT_NE(check.out.find(words), std::string::npos) << words << "\n" << check.out;
  EXPECT_EQ(check.out.find("<ParameterList"), std::string::npos);
}
