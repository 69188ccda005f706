// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study_files.h"

#include <myolines/base/error.h>
#include <myolines/study/plot.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::study;
using namespace myolines::testing;

namespace
{
  const std::string column =
      section("error in u", parameter("file", "trajectory.csv") + parameter("column", "Displacement [m]") + parameter("measure", "final"));
} // namespace

/// Units stand on the axes, quotes do no harm, and what a logarithm cannot show is left out.
TEST(Pictures, ScriptHoldsDataAndUnits)
{
  Picture picture;
  picture.name    = "a";
  picture.title   = "it's";
  picture.x_label = "step [s]";
  picture.y_label = "error [m]";
  picture.log_x = picture.log_y = true;
  picture.curves                = {{"be", {{0.1, 1e-3}, {0.05, 0}, {0.025, 2.5e-4}}}, {"none", {}}};
  const std::string script      = gnuplot_script(picture);
  EXPECT_NE(script.find("set title 'it''s'"), std::string::npos);
  EXPECT_NE(script.find("set xlabel 'step [s]'"), std::string::npos);
  EXPECT_NE(script.find("0.1 0.001\n0.025 0.00025\nEOD"), std::string::npos) << script;
  EXPECT_EQ(script.find("title 'none'"), std::string::npos);
  EXPECT_NE(script.find("set logscale y"), std::string::npos);
}

/// Labels of narrow panels do not touch: few of them, at round numbers.
TEST(Pictures, PanelsHaveFewTicks)
{
  Picture panel, picture;
  panel.curves   = {{"be", {{0.59, 0}, {0.69, 1}}}, {"nm", {{0.6, 0}, {0.68, 1}}}};
  picture.panels = {panel};
  EXPECT_NE(gnuplot_script(picture).find("set xtics 0.02\n"), std::string::npos) << gnuplot_script(picture);
  picture.panels[0].curves = {{"be", {{0, 0}, {1, 1}}}};
  EXPECT_NE(gnuplot_script(picture).find("set xtics 0.2\n"), std::string::npos);
  picture.panels[0].log_x = true;
  EXPECT_EQ(gnuplot_script(picture).find("set xtics"), std::string::npos);
}

TEST(Pictures, ColumnsOfOneUnitShareOneAndRunsAreCompared)
{
  const TestFolder folder;
  for (const char *run : {"a", "b"})
    {
      std::filesystem::create_directory(folder / run);
      folder.write(std::string(run) + "/r.csv", "Time [s],x [N],y [N],V [m^3]\n0,1,2,3\n1,4,5,6\n");
      folder.write(std::string(run) + "/steps.csv", "step,t [s]\n1,0\n");
    }
  const auto one = pictures_of_runs({folder / "a"}, "");
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[0].y_label, "force [N]");
  EXPECT_EQ(one[0].title, "r");
  ASSERT_EQ(one[0].curves.size(), 2u);
  EXPECT_EQ(one[0].curves[1].points[1], (std::pair<double, double>(1, 5)));
  const auto both = pictures_of_runs({folder / "a", folder / "b"}, "r.csv");
  ASSERT_EQ(both.size(), 3u);
  EXPECT_EQ(both[2].y_label, "V [m^3]");
  EXPECT_EQ(both[2].title, "V [m^3]");
  EXPECT_EQ(both[2].curves[1].title, "b");
  EXPECT_THROW(pictures_of_runs({folder / "c"}, ""), InputError);
  folder.write("a/manifest.json",
               R"({"program": "myolines", "exit reason": "done", "files": ["r.csv"], "titles": {"r.csv": "Forces of the day"}})");
  EXPECT_EQ(pictures_of_runs({folder / "a"}, "").front().title, "Forces of the day");
}

TEST(Pictures, MapsHaveOneForEachPointOfTheOtherAxes)
{
  const StudyFolder folder;
  const std::string axes = groups("method", {{"be", "integrator/type=backward euler"}, {"nm", "integrator/type=newmark"}}) +
                           listed("step", "time/step", "0.1 | 0.05", parameter("unit", "s")) + listed("mass", "system/mass", "1 | 2");
  const auto file = folder.write_study(
      grid("all", axes), parameter("kind", "stability map") + parameter("abscissa", "step") + parameter("ordinate", "method") +
                             parameter("file", "trajectory.csv") + parameter("column", "Displacement [m]") +
                             section("reference", parameter("settings", "time/step=0.01") + parameter("instead of", "method | step")));
  std::filesystem::copy(file, folder / "study.resolved.xml");
  folder.write(
      "study.csv",
      "case,role,method,step [s],mass,status,reason,class,notes\n"
      "a,case,be,0.1,1,done,,stable,\nb,case,nm,0.1,1,failed,no,failed,\nc,case,nm,0.05,2,done,,oscillating,\nd,case,be,0.05,2,open,,,\n"
      "r,reference,,,1,done,,,\n");
  folder.write("seconds.csv", "case,CPU [s],wall clock [s]\na,1,1\nb,1,1\nc,1,1\nr,1,1\n");
  const auto maps = pictures_of_study(folder.path());
  ASSERT_EQ(maps.size(), 2u);
  EXPECT_EQ(maps[0].x_label, "step [s]");
  EXPECT_EQ(maps[0].title, ": mass 1"); // the study has no title
  ASSERT_EQ(maps[0].y_words.size(), 2u);
  const auto &stable = maps[0].curves[0], &failed = maps[0].curves[3];
  EXPECT_EQ(stable.title, "stable");
  EXPECT_EQ(stable.points, (std::vector<std::pair<double, double>>{{0.1, 0}}));
  EXPECT_EQ(failed.points, (std::vector<std::pair<double, double>>{{0.1, 1}}));
  EXPECT_EQ(maps[1].curves[1].points, (std::vector<std::pair<double, double>>{{0.05, 1}}));
}

/// The pictures of a sweep are along the first axis with numbers, a curve for each method.
TEST(Pictures, SweepsHaveACurveForEachMethod)
{
  const StudyFolder folder;
  const std::string axes = groups("method", {{"be", "integrator/type=backward euler"}, {"nm", "integrator/type=newmark"}}) +
                           listed("step", "time/step", "0.1 | 0.05");
  std::filesystem::copy(folder.write_study(grid("all", axes), section("quantities", column)), folder / "study.resolved.xml");
  folder.write("study.csv", "case,role,method,step,status,reason,error in u "
                            "[m],notes\na,case,be,0.1,done,,4,\nb,case,be,0.05,done,,2,\nc,case,nm,0.1,done,,1,\n");
  folder.write("seconds.csv", "case,CPU [s],wall clock [s]\na,1,1\nb,1,1\nc,1,1\n");
  const auto pictures = pictures_of_study(folder.path());
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures[0].y_label, "error in u [m]");
  ASSERT_EQ(pictures[0].curves.size(), 2u);
  EXPECT_EQ(pictures[0].curves[0].title, "be");
  EXPECT_EQ(pictures[0].curves[0].points, (std::vector<std::pair<double, double>>{{0.05, 2}, {0.1, 4}}));
}

/// Quantities that share a picture: a curve for each of them and each method, the others on their own.
TEST(Pictures, SweepsMayHaveSeveralQuantities)
{
  const StudyFolder folder;
  const std::string axes = groups("method", {{"be", "integrator/type=backward euler"}, {"nm", "integrator/type=newmark"}}) +
                           listed("step", "time/step", "0.1 | 0.05");
  const auto final_of = [](const std::string &name, const std::string &header) {
    return section(name, parameter("file", "trajectory.csv") + parameter("column", header) + parameter("measure", "final"));
  };
  const std::string quantities = final_of("u", "u [m]") + final_of("v", "v [m/s]") + final_of("w", "w [m]");
  std::filesystem::copy(folder.write_study(grid("all", axes), parameter("together", "w | u") + section("quantities", quantities)),
                        folder / "study.resolved.xml");
  folder.write("study.csv", "case,role,method,step,status,reason,u [m],v [m/s],w [m],notes\n"
                            "a,case,be,0.1,done,,4,5,6,\nb,case,nm,0.1,done,,1,2,3,\n");
  folder.write("seconds.csv", "case,CPU [s],wall clock [s]\na,1,1\nb,1,1\n");
  const auto pictures = pictures_of_study(folder.path());
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].y_label, "v [m/s]");
  EXPECT_EQ(pictures[1].y_label, "[m]");
  ASSERT_EQ(pictures[1].curves.size(), 4u);
  EXPECT_EQ(pictures[1].curves[3].title, "w, nm");
  EXPECT_EQ(pictures[1].curves[3].points, (std::vector<std::pair<double, double>>{{0.1, 3}}));
}

TEST(Pictures, TimeSeriesHaveAPanelForEachColumnAndACurveForEachCase)
{
  const StudyFolder folder;
  const std::string axes = groups("method", {{"be", "integrator/type=backward euler"}, {"nm", "integrator/type=newmark"}}) +
                           listed("mass", "system/mass", "1 | 2");
  const std::string picture =
      parameter("file", "s.csv") + parameter("columns", "a [m] | b [m]") + parameter("of", "mass=1") + parameter("from", "0.5", "double");
  std::filesystem::copy(folder.write_study(grid("all", axes), section("pictures", section("waves", picture))),
                        folder / "study.resolved.xml");
  folder.write("study.csv", "case,role,method,mass,status,reason,notes\n"
                            "\"method=be,mass=1\",case,be,1,done,,\n\"method=nm,mass=1\",case,nm,1,failed,no,\n"
                            "\"method=be,mass=2\",case,be,2,done,,\n\"method=nm,mass=2\",case,nm,2,done,,\n");
  folder.write("seconds.csv", "case,CPU [s],wall clock [s]\n");
  for (const char *name : {"method=be,mass=1", "method=nm,mass=1", "method=be,mass=2"})
    {
      std::filesystem::create_directories(folder / "cases" / name);
      folder.write(std::string("cases/") + name + "/s.csv", "Time [s],a [m],b [m]\n0,1,2\n1,3,4\n2,5,6\n");
    }
  const auto pictures = pictures_of_study(folder.path());
  const auto waves    = std::find_if(pictures.begin(), pictures.end(), [](const Picture &p) { return p.name == "waves"; });
  ASSERT_NE(waves, pictures.end());
  ASSERT_EQ(waves->panels.size(), 2u);
  EXPECT_EQ(waves->panels[1].title, "b [m]");
  EXPECT_EQ(waves->panels[1].x_label, "Time [s]");
  ASSERT_EQ(waves->panels[1].curves.size(), 1u) << "one is done, with mass 1";
  EXPECT_EQ(waves->panels[1].curves[0].title, "be");
  EXPECT_EQ(waves->panels[1].curves[0].points, (std::vector<std::pair<double, double>>{{1, 4}, {2, 6}}));
  EXPECT_EQ(draw({*waves}, folder.path()), 1u);
  EXPECT_GT(std::filesystem::file_size(folder / "waves.png"), 1000u);
}

TEST(Pictures, TimeSeriesOfWhatTheStudyHasNotAreRefused)
{
  for (const char *of : {"masses=1", "mass=3", "mass"})
    {
      const StudyFolder folder;
      const std::string picture = parameter("file", "s.csv") + parameter("columns", "a [m]") + parameter("of", of);
      EXPECT_THROW(folder.study(grid("all", listed("mass", "system/mass", "1 | 2")), section("pictures", section("waves", picture))),
                   InputError)
          << of;
    }
}
