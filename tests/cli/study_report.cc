// SPDX-License-Identifier: LGPL-2.1-or-later
// The page of a study: what was asked, how good the numbers are, what they cost, what has no value and why.
#include "../study/study_files.h"

#include <myolines/scene/csv.h>

#include <gtest/gtest.h>

using namespace myolines::testing;

namespace
{
  std::string twin(const std::string &name, const std::string &method)
  {
    return section(name,
                   parameter("settings", "integrator/type=" + method + " | time/step=0.01") + parameter("instead of", "method | step"));
  }

  /// Three methods, of which one cannot take such steps.
  std::string study_of(const StudyFolder &folder, const std::string &more)
  {
    const std::string methods =
        groups("method", {{"euler", "integrator/type=backward euler"},
                          {"sdirk2", "integrator/type=sdirk2"},
                          {"explicit", "integrator/type=explicit central difference | system/stiffness=1e9 | time/control/type=fixed"}});
    const std::string steps = listed("step", "time/step", "0.1 | 0.05", parameter("unit", "s"));
    folder.write_study(
        section("all", methods + steps),
        parameter("title", "Costs &lt;of&gt; it") + parameter("kind", "work-precision") + parameter("curves", "method") +
            parameter("precision", "error in u") + parameter("work", "iterations") + parameter("target", "0.02", "double") +
            section("quantities", error_against_cosine() + section("state", parameter("type", "state")) +
                                      section("iterations", parameter("type", "count") + parameter("name", "newton iterations"))) +
            twin("reference", "sdirk3") + more);
    EXPECT_EQ(run_program(folder, "study study.xml --out r --quiet --jobs 1").exit_code, 0) << contents(folder / "err.txt");
    const Outcome report = run_program(folder, "report r --out r.html");
    EXPECT_EQ(report.exit_code, 0) << report.err;
    return contents(folder / "r.html");
  }
} // namespace

TEST(StudyReport, TellsWhatWasAskedAndHowGoodItIs)
{
  const StudyFolder folder;
  const std::string html = study_of(folder, twin("cross check", "sdirk2"));
  EXPECT_EQ(html.find("Costs <of> it"), std::string::npos);
  for (const char *part :
       {"Costs &lt;of&gt; it", "axis: method", "euler, sdirk2, explicit", "0.1, 0.05 s", "8 cases: 6 done, 2 failed",
        "is the difference from the exact solution cos(t).", "Errors are differences from a reference run, with integrator/type=sdirk3",
        "in place of method, step", "The reference and its cross check",
        "differ by error in u [m] = ", ", state = ", "smaller errors mean nothing", "Cost at equal error: error in u = 0.02", "All cases",
        "What has no value, and why", "stable step", "As in the manifest of the case"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  const auto table = myolines::scene::read_csv(folder / "r/study.csv");
  for (const auto &row : table.value().rows)
    EXPECT_NE(html.find(row.front()), std::string::npos) << row.front();
}

TEST(StudyReport, SaysWhatIsNotKnown)
{
  const StudyFolder folder;
  EXPECT_NE(study_of(folder, "").find("The reference has no cross check: how good it is itself is not known."), std::string::npos);
  for (const char *name : {"study.csv", "seconds.csv", "equal_error.csv", "study.sqlite"})
    std::filesystem::remove(folder / ("r/" + std::string(name)));
  const Outcome report = run_program(folder, "report r --out empty.html");
  ASSERT_EQ(report.exit_code, 0) << report.err;
  EXPECT_NE(contents(folder / "empty.html").find("There is no table yet: no case has ended."), std::string::npos);
}
