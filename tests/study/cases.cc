// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study_files.h"

#include <myolines/base/error.h>
#include <myolines/study/cases.h>

#include <gtest/gtest.h>

#include <set>

using namespace myolines;
using namespace myolines::study;
using namespace myolines::testing;

namespace
{
  std::vector<std::string> names(const std::vector<Case> &cases)
  {
    std::vector<std::string> all;
    for (const Case &each : cases)
      all.push_back(each.name);
    return all;
  }

  const std::string method_axis =
      groups("method", {{"be", "integrator/type=backward euler"}, {"hht 0.1", "integrator/type=hht alpha | integrator/alpha=-0.1"}});
  const std::string step_axis = listed("step", "time/step", "0.1 | 0.05");
} // namespace

TEST(Cases, AxesAreCrossedTheLastFastest)
{
  const StudyFolder folder;
  const auto        cases = expand(folder.study(grid("all", method_axis + step_axis)));
  EXPECT_EQ(names(cases),
            (std::vector<std::string>{"method=be,step=0.1", "method=be,step=0.05", "method=hht_0.1,step=0.1", "method=hht_0.1,step=0.05"}));
  EXPECT_EQ(cases[3].settings, (std::vector<std::string>{"integrator/type=hht alpha", "integrator/alpha=-0.1", "time/step=0.05"}));
  EXPECT_EQ(cases[3].coordinates.at("step").number, 0.05);
  EXPECT_EQ(cases[3].reference, "");
}

TEST(Cases, ZippedAxesGoAlong)
{
  const StudyFolder folder;
  const auto cases = expand(folder.study(grid("all", step_axis + listed("end", "time/end", "1 | 2", parameter("zipped with", "step")) +
                                                         listed("mass", "system/mass", "1 | 3"))));
  EXPECT_EQ(names(cases), (std::vector<std::string>{"step=0.1,end=1,mass=1", "step=0.1,end=1,mass=3", "step=0.05,end=2,mass=1",
                                                    "step=0.05,end=2,mass=3"}));
}

TEST(Cases, RangesHitTheirEndsExactly)
{
  const StudyFolder folder;
  const std::string ranges =
      section("m", parameter("type", "range") + parameter("parameter", "system/mass") + parameter("first", "1", "double") +
                       parameter("last", "2", "double") + parameter("number", "3", "int")) +
      section("h", parameter("type", "log range") + parameter("parameter", "time/step") + parameter("first", "1e-5", "double") +
                       parameter("last", "0.1", "double") + parameter("number", "5", "int"));
  const Study study = folder.study(grid("all", ranges));
  ASSERT_EQ(expand(study).size(), 15u);
  const std::vector<AxisPoint> &m = study.axis("m").points, &h = study.axis("h").points;
  EXPECT_EQ(m[1].settings.front(), "system/mass=1.5");
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(*h[i].number / std::pow(10., i - 5), 1, 1e-14);
  EXPECT_EQ(*h[4].number, 0.1);
}

/// One reference for every point of the axes that it keeps; its settings come last.
TEST(Cases, ReferencesStandForTheAxesTheyReplace)
{
  const StudyFolder folder;
  const std::string reference =
      section("reference", parameter("settings", "integrator/type=sdirk3 | time/step=1e-3") + parameter("instead of", "method | step"));
  const std::string check =
      section("cross check", parameter("settings", "integrator/type=sdirk2 | time/step=1e-3") + parameter("instead of", "method | step"));
  const auto cases = expand(folder.study(grid("all", method_axis + listed("mass", "system/mass", "1 | 3") + step_axis), reference + check));
  ASSERT_EQ(cases.size(), 2u + 2u + 8u);
  EXPECT_EQ(cases[0].name, "reference,mass=1");
  EXPECT_EQ(cases[1].settings, (std::vector<std::string>{"system/mass=3", "integrator/type=sdirk3", "time/step=1e-3"}));
  EXPECT_EQ(cases[2].name, "cross_check,mass=1");
  EXPECT_EQ(cases[2].reference, "reference,mass=1");
  EXPECT_EQ(cases[11].reference, "reference,mass=3");
}

TEST(Cases, GridsAreJoinedAndMayNotOverlap)
{
  const StudyFolder folder;
  EXPECT_EQ(expand(folder.study(grid("a", step_axis) + grid("b", listed("step", "time/step", "0.01")))).size(), 3u);
  EXPECT_THROW(expand(folder.study(grid("a", step_axis) + grid("b", listed("step", "time/step", "0.05 | 0.01")))), InputError);
}

TEST(Cases, NamesAreOfFilesAndStable)
{
  EXPECT_EQ(case_name("", {{"rise time", "0.1 s/2"}}), "rise_time=0.1_s_2");
  const std::string long_label(200, 'x');
  const std::string name = case_name("", {{"a", long_label + "1"}});
  EXPECT_EQ(name.size(), 120u);
  EXPECT_NE(name, case_name("", {{"a", long_label + "2"}}));
  EXPECT_EQ(name.substr(111), "-b05e8679"); // of Python: zlib.crc32(b"|a=" + 200 * b"x" + b"1")
}

TEST(Cases, WrongStudiesAreRefusedWithTheNameMeant)
{
  const StudyFolder folder;
  const auto        complaint = [&](const std::string &grids, const std::string &more) {
    try
      {
        folder.study(grids, more);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  EXPECT_NE(complaint(grid("a", step_axis), section("reference", parameter("settings", "time/step=1") + parameter("instead of", "steps")))
                .find("\"step\""),
            std::string::npos);
  EXPECT_NE(complaint(grid("a", step_axis), section("quantities", section("e", parameter("file", "f") + parameter("column", "c") +
                                                                                   parameter("measure", "final error"))))
                .find("nothing to compare with"),
            std::string::npos);
  EXPECT_NE(complaint(grid("a", step_axis + listed("x", "time/end", "1 | 2 | 3", parameter("zipped with", "step"))), "").find("3 points"),
            std::string::npos);
  EXPECT_NE(complaint(grid("a", step_axis), section("cross check", parameter("settings", "time/step=1"))).find("no reference"),
            std::string::npos);
  EXPECT_NE(complaint(grid("a", listed("step", "time/step", " | ")), "").find("no value"), std::string::npos);
  EXPECT_NE(complaint(grid("a", method_axis + step_axis + listed("mass", "system/mass", "1 | 3")),
                      parameter("kind", "work-precision") + parameter("curves", "method") + parameter("precision", "error in u") +
                          section("quantities", error_against_cosine()))
                .find("2 axes beside it"),
            std::string::npos);
  const std::string precise = parameter("kind", "work-precision") + parameter("curves", "method") + parameter("precision", "error in u") +
                              section("quantities", error_against_cosine());
  EXPECT_NE(complaint(grid("a", method_axis + step_axis) + grid("b", method_axis + listed("mass", "system/mass", "1 | 3")), precise)
                .find("along \"step\" and \"mass\""),
            std::string::npos);
  const auto of_formula = [&](const std::string &formula, const std::string &columns) {
    return complaint(
        grid("a", step_axis),
        section("quantities", section("sum", parameter("type", "formula") + parameter("file", "f.csv") + parameter("measure", "final") +
                                                 parameter("formula", formula) + parameter("columns", columns))));
  };
  EXPECT_EQ(of_formula("x - 2*y + t", "x = x [N] | y = y [N]"), "");
  EXPECT_NE(of_formula("x - z", "x = x [N] | y = y [N]").find("z"), std::string::npos);
  EXPECT_NE(of_formula("x", "x [N]").find("NAME = HEADER"), std::string::npos);
  EXPECT_NE(of_formula("x", "x = a | x = b").find("names no column"), std::string::npos);
  EXPECT_NE(complaint("", "").find("no grid"), std::string::npos);
  EXPECT_NE(complaint(grid("a", step_axis), parameter("kid", "sweep")).find("\"kind\""), std::string::npos);
}

TEST(Cases, GridsBeyondUseAreRefusedBeforeTheyAreMade)
{
  const StudyFolder folder;
  const auto        long_axis = [](const std::string &name) {
    return section(name, parameter("type", "range") + parameter("parameter", "system/mass") + parameter("first", "1", "double") +
                                    parameter("last", "2", "double") + parameter("number", "1000000", "int"));
  };
  try
    {
      folder.study(grid("all", long_axis("m") + long_axis("k")));
      FAIL() << "a grid of 1e12 cases";
    }
  catch (const InputError &error)
    {
      for (const char *word : {"all", "1e+06 (m) x 1e+06 (k)", "1e+12 cases"})
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}
