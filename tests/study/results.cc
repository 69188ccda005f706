// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study_files.h"

#include <myolines/base/error.h>
#include <myolines/study/csv_table.h>
#include <myolines/study/results.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::study;
using namespace myolines::testing;

namespace
{
  const std::string methods = groups("method", {{"be", "integrator/type=backward euler"}, {"nm", "integrator/type=newmark"}});
  const std::string steps   = listed("step", "time/step", "0.1 | 0.05 | 0.025");
  const std::string error =
      section("quantities", error_against_cosine() + section("solves", parameter("type", "count") + parameter("name", "linear solves")));

  /// Rows of the cases in order, all done, with the values given: error and work.
  std::vector<Row> rows_with(const std::vector<Case> &cases, const std::vector<std::pair<double, double>> &values)
  {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < cases.size(); ++i)
      {
        Row row;
        row.which          = &cases[i];
        row.outcome.name   = cases[i].name;
        row.outcome.status = "done";
        row.values         = {{values[i].first, ""}, {values[i].second, ""}};
        rows.push_back(row);
      }
    return rows;
  }
} // namespace

/// Errors c h^p have the rate p, within each method.
TEST(Results, RatesOfPowersAreTheirExponents)
{
  const StudyFolder folder;
  const Study study = folder.study(grid("all", steps + methods), parameter("kind", "convergence") + parameter("sizes", "step") + error);
  const auto  cases = expand(study);
  ASSERT_EQ(cases[1].name, "step=0.1,method=nm");
  std::vector<std::pair<double, double>> values;
  for (const double h : {0.1, 0.05, 0.025})
    values.insert(values.end(), {{3 * h, 1}, {0.5 * h * h, 1}});
  std::vector<Row> rows = rows_with(cases, values);
  add_rates(study, rows);
  EXPECT_FALSE(rows[0].rates[0].value.has_value());
  EXPECT_FALSE(rows[1].rates[0].value.has_value());
  for (const std::size_t i : {2, 4})
    {
      EXPECT_NEAR(rows[i].rates[0].value.value(), 1, 1e-13);
      EXPECT_NEAR(rows[i + 1].rates[0].value.value(), 2, 1e-13);
      EXPECT_FALSE(rows[i].rates[1].value.has_value()); // a count is no error
    }
}

/// In time and space at once: an axis that is zipped with that of the sizes goes along with it.
TEST(Results, RatesAlongZippedAxes)
{
  const StudyFolder folder;
  const Study       study =
      folder.study(grid("all", steps + listed("mass", "system/mass", "3 | 2 | 1", parameter("zipped with", "step")) + methods),
                   parameter("kind", "convergence") + parameter("sizes", "step") + error);
  const auto       cases = expand(study);
  std::vector<Row> rows  = rows_with(cases, {{8, 1}, {9, 1}, {4, 1}, {3, 1}, {2, 1}, {1, 1}});
  add_rates(study, rows);
  EXPECT_DOUBLE_EQ(rows[2].rates[0].value.value(), 1);
  EXPECT_DOUBLE_EQ(rows[5].rates[0].value.value(), std::log(3.) / std::log(2.));
}

/// Work w at error 1/w and 1/w^2: the target 1e-2 costs 100 and 10.
TEST(Results, EqualErrorInterpolatesInLogarithms)
{
  const StudyFolder folder;
  const Study       study = folder.study(grid("all", methods + steps), parameter("kind", "work-precision") + parameter("curves", "method") +
                                                                           parameter("precision", "error in u") + parameter("work", "solves") +
                                                                           parameter("target", "1e-2", "double") + error);
  const auto        cases = expand(study);
  const auto        costs =
      equal_error(study, rows_with(cases, {{1. / 30, 30}, {1. / 70, 70}, {1. / 300, 300}, {1. / 16, 4}, {1. / 49, 7}, {1. / 400, 20}}));
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_NEAR(costs[0].work.value.value(), 100, 1e-10);
  EXPECT_NEAR(costs[1].work.value.value(), 10, 1e-10);
  EXPECT_NEAR(costs[0].ratio.value.value(), 10, 1e-10);
  const auto short_of = equal_error(study, rows_with(cases, {{1, 30}, {0.5, 70}, {0.2, 300}, {1. / 16, 4}, {1. / 49, 7}, {1. / 400, 20}}));
  EXPECT_FALSE(short_of[0].work.value.has_value()); // never extrapolated
  EXPECT_FALSE(short_of[0].at_most.value.has_value());

  const auto best = equal_error(study, rows_with(cases, {{1. / 30, 30}, {1. / 70, 70}, {1. / 300, 300}, {1e-3, 4}, {1e-4, 7}, {1e-5, 20}}));
  EXPECT_FALSE(best[1].work.value.has_value());
  EXPECT_EQ(best[1].at_most.value.value(), 4);
  EXPECT_FALSE(best[0].at_most.value.has_value());
  EXPECT_NEAR(best[0].work.value.value(), 100, 1e-10);
  EXPECT_FALSE(best[0].ratio.value.has_value()); // the cheapest costs 4 or less
}

/// One method takes steps, the other tolerances: each is interpolated along its own axis.
TEST(Results, EqualErrorAlongTwoAxes)
{
  const StudyFolder folder;
  const auto        method = [](const std::string &name) { return groups("method", {{name, "integrator/type=newmark"}}); };
  const Study       study  = folder.study(
             grid("steps", method("fixed") + listed("step", "time/step", "0.1 | 0.05")) +
                 grid("tolerances", method("by error") + listed("tolerance", "time/control/displacement/relative tolerance", "1e-3 | 1e-4")),
             parameter("kind", "work-precision") + parameter("curves", "method") + parameter("precision", "error in u") +
                 parameter("work", "solves") + parameter("target", "1e-2", "double") + error);
  const auto cases = expand(study);
  const auto costs = equal_error(study, rows_with(cases, {{1. / 30, 30}, {1. / 300, 300}, {1. / 5, 5}, {1. / 500, 500}}));
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_EQ(costs[1].method, "by error");
  EXPECT_NEAR(costs[0].work.value.value(), 100, 1e-10);
  EXPECT_NEAR(costs[1].work.value.value(), 100, 1e-10);
}

/// Of three runs: the median and the range of their seconds; counts that are not the same are no number; a repeat that is not done is told.
TEST(Results, RepeatsAreTakenTogether)
{
  const StudyFolder folder;
  const std::string quantities =
      section("quantities", section("solves", parameter("type", "count") + parameter("name", "linear solves")) +
                                section("in residual", parameter("type", "seconds") + parameter("name", "residual")));
  const Study study = folder.study(grid("all", steps), parameter("repeats", "3", "int") + quantities);
  const auto  cases = expand(study);
  ASSERT_EQ(cases.size(), 9u);
  EXPECT_EQ(cases[3].name, "step=0.1,repeat=2"); // after all points: not at one time with the first
  EXPECT_EQ(cases[3].settings, cases[0].settings);
  std::vector<Row> rows = rows_with(cases, {{5, 0.3}, {5, 1}, {5, 1}, {5, 0.7}, {5, 1}, {6, 1}, {5, 0.2}, {5, 1}, {5, 1}});
  for (std::size_t i = 0; i < rows.size(); ++i)
    {
      rows[i].outcome.wall_seconds = static_cast<double>(i);
      rows[i].outcome.cpu_seconds  = 10. - static_cast<double>(i * i);
    }
  rows[4].outcome.status = "failed";
  rows[4].outcome.reason = "no room";
  rows[4].values         = {{}, {}};
  take_repeats_together(study, rows);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].values[0].value.value(), 5);
  EXPECT_EQ(rows[0].values[1].value.value(), 0.3);
  EXPECT_EQ(rows[0].spread.values[1].value(), 0.7 - 0.2);
  EXPECT_EQ(rows[0].outcome.wall_seconds, 3);
  EXPECT_EQ(rows[0].spread.wall.value(), 6);
  EXPECT_EQ(rows[0].outcome.cpu_seconds.value(), 1);
  EXPECT_EQ(rows[0].spread.cpu.value(), 36);
  EXPECT_EQ(rows[0].spread.runs, 3u);
  EXPECT_EQ(rows[1].outcome.status, "failed");
  EXPECT_EQ(rows[1].outcome.reason, "step=0.05,repeat=2: no room");
  EXPECT_FALSE(rows[1].values[0].value.has_value());
  EXPECT_FALSE(rows[2].values[0].value.has_value());
  EXPECT_EQ(rows[2].values[0].note, "repeats differ: 5 and 6");
  EXPECT_EQ(rows[2].values[1].value.value(), 1);
}

/// Of two runs, one that went on from a checkpoint and has no CPU seconds, and one that is still open.
TEST(Results, RepeatsThatAreMissing)
{
  const StudyFolder folder;
  const Study       study     = folder.study(grid("all", listed("step", "time/step", "0.1")), parameter("repeats", "3", "int") + error);
  const auto        cases     = expand(study);
  std::vector<Row>  rows      = rows_with(cases, {{5, 1}, {5, 1}, {5, 1}});
  rows[0].outcome.cpu_seconds = 2;
  rows[2].outcome.status      = "open";
  take_repeats_together(study, rows);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].outcome.status, "done");
  EXPECT_EQ(rows[0].outcome.cpu_seconds.value(), 2);
  EXPECT_FALSE(rows[0].spread.cpu.has_value());
  EXPECT_EQ(rows[0].spread.runs, 2u);
}

TEST(Results, ClassesFollowTheRules)
{
  study::View view;
  view.overshoot      = 1;
  view.variation      = 1.5;
  const auto class_of = [&view](const double overshoot, const double late, const double variation) {
    return stability_class(view, true, {{overshoot, ""}, {late, ""}, {variation, ""}});
  };
  EXPECT_EQ(stability_class(view, false, {}), "failed");
  EXPECT_EQ(stability_class(view, true, {{{}, not_finite}, {}, {}}), "diverged");
  EXPECT_EQ(class_of(1.1, 1.1, 9), "diverged");
  EXPECT_EQ(class_of(1.1, 0.9, 1), "oscillating");
  EXPECT_EQ(class_of(0.9, 0.9, 1.6), "oscillating");
  EXPECT_EQ(class_of(0.9, 0.9, 1.4), "stable");
  EXPECT_EQ(stability_class(view, true, {{{}, "its reference is not done"}, {}, {}}), "unknown");
}

TEST(Results, HeadersCarryUnits)
{
  Quantity quantity;
  quantity.name    = "force";
  quantity.column  = "moving end x [N]";
  quantity.measure = "final";
  EXPECT_EQ(header_of(quantity), "force [N]");
  quantity.measure = "decay time";
  EXPECT_EQ(header_of(quantity), "force [s]");
  for (const char *ratio : {"overshoot", "late overshoot", "relative variation", "growth"})
    {
      quantity.measure = ratio;
      EXPECT_EQ(header_of(quantity), "force");
    }
  EXPECT_EQ(unit_in("no unit"), "");
}

/// A case that failed keeps its row, with the reason, and no numbers; one that has not run is open.
TEST(Results, TablesKeepFailures)
{
  const StudyFolder        folder;
  const Study              study = folder.study(grid("all", listed("step", "time/step", "0.1 | 0.05")), error);
  const auto               cases = expand(study);
  myolines::study::Outcome failed;
  failed.name   = cases[0].name;
  failed.status = "failed";
  failed.reason = "no, \"really\"";
  Database               database(folder / "study.sqlite");
  const std::vector<Row> rows = evaluate(study, cases, {{failed.name, failed}}, folder.path());
  write_tables(study, rows, folder.path(), database);
  const auto table = read_csv(folder / "study.csv");
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->rows[0], (std::vector<std::string>{"step=0.1", "case", "0.1", "failed", "no, \"really\"", "", "", ""}));
  EXPECT_EQ(table->rows[1], (std::vector<std::string>{"step=0.05", "case", "0.05", "open", "", "", "", ""}));
  EXPECT_EQ(read_csv(folder / "seconds.csv")->rows.size(), 1u);
}

namespace
{
  myolines::study::Outcome done_with(const std::string &name, const std::string &ledger)
  {
    myolines::study::Outcome done;
    done.name   = name;
    done.status = "done";
    done.ledger = ledger;
    return done;
  }
} // namespace

/// A count that only other cases have is 0; one that no case has is no number, and its note names the nearest.
TEST(Results, CountsThatNoCaseHasAreMissing)
{
  const StudyFolder folder;
  const auto        count = [](const std::string &of) { return section(of, parameter("type", "count") + parameter("name", of)); };
  const Study       study = folder.study(grid("all", listed("step", "time/step", "0.1 | 0.05")),
                                         section("quantities", count("linear solves") + count("linear solvs")));
  const auto        cases = expand(study);
  const auto        rows  = evaluate(study, cases,
                                     {{cases[0].name, done_with(cases[0].name, R"({"counts": {"linear solves": 7}, "seconds": {}})")},
                                      {cases[1].name, done_with(cases[1].name, R"({"counts": {"accepted steps": 3}, "seconds": {}})")}},
                                     folder.path());
  EXPECT_EQ(rows[0].values[0].value, 7.);
  EXPECT_EQ(rows[1].values[0].value, 0.);
  for (const Row &row : rows)
    {
      EXPECT_FALSE(row.values[1].value.has_value());
      EXPECT_NE(row.values[1].note.find("nearest: \"linear solves\""), std::string::npos) << row.values[1].note;
    }
}

/// A column is a function of time alone, and a reference file must have it.
TEST(Results, ReferencesThatCannotBeAreRefusedAtReading)
{
  const StudyFolder folder;
  const std::string one_axis = grid("all", listed("step", "time/step", "0.1 | 0.05"));
  const auto        with     = [](const std::string &reference, const std::string &text) {
    return section("quantities", section("e", parameter("file", "trajectory.csv") + parameter("column", "Displacement [m]") +
                                                             parameter("measure", "final error") + parameter(reference, text)));
  };
  folder.write("good.csv", "Time [s],Displacement [m]\n0,1\n");
  folder.write("bad.csv", "Time [s],Displacement [mm]\n0,1\n");
  EXPECT_NO_THROW(folder.study(one_axis, with("reference formula", "cos(pi*t)")));
  EXPECT_NO_THROW(folder.study(one_axis, with("reference file", "good.csv")));
  for (const char *formula : {"x", "cos(t) + y", "t*z"})
    EXPECT_THROW(folder.study(one_axis, with("reference formula", formula)), myolines::InputError) << formula;
  EXPECT_THROW(folder.study(one_axis, with("reference file", "bad.csv")), myolines::InputError);
}
