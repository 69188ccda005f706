// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: `verify` gives values with errors that hold exact or much finer ones, goes on where it was, and tells what it cannot do.

#include "program_runner.h"
#include "small_scenes.h"

#include <myolines/scene/csv.h>
#include <myolines/study/processes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>

namespace
{
  /// A cell of verify.csv.
  std::string verified_cell(const TestFolder &folder, const std::size_t row, const std::string &column)
  {
    const auto table = myolines::scene::read_csv(folder / "out/verify.csv");
    return table.value().rows.at(row).at(table->column(column).value());
  }

  double verified_number(const TestFolder &folder, const std::size_t row, const std::string &column)
  {
    return std::stod(verified_cell(folder, row, column));
  }

  /// That the interval of a row holds @p exact, and is not wider than @p widest times the error.
  void expect_holds(const TestFolder &folder, const std::size_t row, const double exact, const double widest)
  {
    const std::string mesh  = verified_cell(folder, row, "error of mesh");
    const double      error = std::abs(verified_number(folder, row, "value") - exact),
                 stated     = verified_number(folder, row, "error of steps") + (mesh.empty() ? 0 : std::stod(mesh));
    EXPECT_GE(stated, error) << row;
    EXPECT_LE(stated, widest * error) << row;
  }
} // namespace

/// With a method of first order; a run that is lost is run again, and no other; what the runs do not have is refused without a run.
TEST(Verify, HoldsTheExactOscillationAndGoesOn)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const std::string command = "verify scene.xml --out out --jobs 1 --quantity ",
                    known   = "trajectory.csv:displacement --quantity \"trajectory.csv:Velocity [m/s]:smallest\""
                              " --quantity \"trajectory.csv:displacement:at 1\"";
  ASSERT_EQ(run_program(folder, command + known).exit_code, 0);
  std::filesystem::remove_all(folder / "out/cases/time_step=0.025");
  const Outcome outcome = run_program(folder, command + known);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(occurrences(contents(folder / "out/study.log"), "  done  "), 6u); // five, and one again
  EXPECT_EQ(outcome.out, contents(folder / "out/verify.txt") + "Results are in out: verify.txt, verify.csv, runs.csv\n");
  EXPECT_NE(outcome.out.find("there is no mesh"), std::string::npos);
  EXPECT_EQ(verified_cell(folder, 0, "steps"), "as in theory");
  expect_holds(folder, 0, std::cos(2), 1.3);
  expect_holds(folder, 1, -1, 1.3);
  expect_holds(folder, 2, std::cos(1), 1.3);

  const auto refusal = [&](const std::string &quantity) {
    const Outcome refused = run_program(folder, command + "\"" + quantity + "\"");
    EXPECT_EQ(refused.exit_code, 2) << quantity;
    return refused.err;
  };
  EXPECT_NE(refusal("trajectory.csv:displacment").find("nearest: \"Displacement\""), std::string::npos);
  EXPECT_NE(refusal("trajectry.csv:displacement").find("nearest: \"trajectory.csv\""), std::string::npos);
  EXPECT_NE(refusal("trajectory.csv:displacement:biggest").find("largest"), std::string::npos);
  EXPECT_NE(refusal("trajectory.csv:displacement:at 3").find("from 0 s to 2 s"), std::string::npos);
}

/// Killed after one of five runs, and after two: no run is done twice, and what it says is what one left alone says.
TEST(Verify, KilledAndCalledAgainGoesOn)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const std::string              arguments = " --jobs 1 --set time/step=1e-4 --quantity trajectory.csv:displacement";
  const std::vector<std::string> command   = {myolines::test::program_file(),
                                              "verify",
                                              (folder / "scene.xml").string(),
                                              "--out",
                                              (folder / "out").string(),
                                              "--jobs",
                                              "1",
                                              "--set",
                                              "time/step=1e-4",
                                              "--quantity",
                                              "trajectory.csv:displacement"};
  const auto                     runs_done = [&] { return occurrences(contents(folder / "out/study.log"), "  done  "); };
  for (const std::size_t n : {1u, 2u})
    {
      myolines::study::Processes          processes;
      const pid_t                         verification = processes.start(command, folder / "console");
      std::vector<myolines::study::Ended> ended;
      while (ended.empty() && runs_done() < n)
        ended = processes.wait(0.005);
      if (ended.empty())
        processes.send(verification, SIGKILL);
      while (ended.empty())
        ended = processes.wait(1);
      ASSERT_EQ(ended.front().signal, SIGKILL) << contents(folder / "console");
      EXPECT_FALSE(std::filesystem::exists(folder / "out/verify.csv"));
    }
  ASSERT_EQ(run_program(folder, "verify scene.xml --out out" + arguments).exit_code, 0);
  EXPECT_EQ(runs_done(), 5u);
  ASSERT_EQ(run_program(folder, "verify scene.xml --out alone" + arguments).exit_code, 0);
  const auto killed = myolines::scene::read_csv(folder / "out/verify.csv"), alone = myolines::scene::read_csv(folder / "alone/verify.csv");
  for (const char *const column : {"value", "error of steps", "rate in steps", "steps", "to halve it"})
    EXPECT_EQ(killed->rows.at(0).at(killed->column(column).value()), alone->rows.at(0).at(alone->column(column).value())) << column;
}

/// The trapezoidal rule keeps the peak: what is left is what lies between the rows.
TEST(Verify, HoldsAPeakBetweenRows)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const Outcome outcome = run_program(folder, "verify scene.xml --out out --jobs 1 --set integrator/type=newmark"
                                              " --quantity trajectory.csv:velocity:smallest");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_holds(folder, 0, -1, 2);
}

TEST(Verify, HoldsTheExactWaveOfARod)
{
  const TestFolder folder;
  folder.write("scene.xml", pulled_rod);
  const Outcome outcome =
      run_program(folder, "verify scene.xml --out out --jobs 1 --quantity \"reaction.csv:moving end x\" --quantity \"trace.csv:u(0.5 L)\""
                          " --quantity \"trace.csv:u(0.9 L)\"");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const double stiffness = 3 * 1e6 * (1 - 2 * 0.499), density = 1060, c = std::sqrt(stiffness / density), t = 0.3;
  expect_holds(folder, 0, 1e-4 * std::sqrt(stiffness * density) * 0.3 * t * t, 5);
  expect_holds(folder, 1, 0.1 * std::pow(t - 0.25 / c, 3), 5);
  expect_holds(folder, 2, 0.1 * std::pow(t - 0.05 / c, 3), 5);
  EXPECT_EQ(verified_cell(folder, 2, "largest error"), "mesh");
  EXPECT_NE(outcome.out.find("system/elements 4: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("system/degree 2: "), std::string::npos) << outcome.out;
}

/// Backward Euler damps the oscillation away with the step, with half of it and with a quarter: only another method tells.
TEST(Verify, SeesWhatAMethodTakesAwayAtAllSteps)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const std::string settings = " --set time/step=1 --set time/end=40";
  const Outcome     outcome  = run_program(folder, "verify scene.xml --out out --jobs 1 --quantity trajectory.csv:displacement" + settings);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(run_program(folder, "run scene.xml --out other --quiet --set integrator/type=sdirk3" + settings).exit_code, 0);
  const auto   table = myolines::scene::read_csv(folder / "other/trajectory.csv");
  const double other = std::stod(table->rows.back()[table->column("Displacement [m]").value()]);
  EXPECT_GT(std::abs(other), 0.1);
  EXPECT_GE(verified_number(folder, 0, "error of steps"), std::abs(other - verified_number(folder, 0, "value")) - 1e-12);
  expect_holds(folder, 0, std::cos(40), 10);
  EXPECT_NE(outcome.out.find("integrator/type sdirk3: "), std::string::npos) << outcome.out;
  EXPECT_EQ(run_program(folder, "verify scene.xml --out best --jobs 1 --quantity trajectory.csv:displacement --set integrator/type=sdirk3")
                .out.find("  method"),
            std::string::npos); // there is none of a higher order
}

/// With a period of 0.8 steps, which sdirk3 damps as well, the value at any instant is as uncertain as the amplitude. What vibrates slowly
/// is no such case.
TEST(Verify, TellsAVibrationThatTheMethodsDamp)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const std::string stiff = " --set time/end=8 --set time/step=0.5 --set system/stiffness=246.74", // omega = 5 pi
      command             = "verify scene.xml --jobs 1 --quantity trajectory.csv:displacement"
                            " --quantity trajectory.csv:displacement:smallest --quantity \"trajectory.csv:displacement:at 6\"";
  const Outcome outcome   = run_program(folder, command + " --out out" + stiff);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("in a vibration of"), std::string::npos) << outcome.out;
  EXPECT_GE(verified_number(folder, 0, "error of steps"), 1);
  EXPECT_GE(verified_number(folder, 2, "error of steps"), 1);
  EXPECT_EQ(run_program(folder, command + " --out slow --set time/end=40 --set time/step=0.25").out.find("in a vibration of"),
            std::string::npos);
}

/// Steps by error: tolerances are what becomes finer.
TEST(Verify, MakesTolerancesSmaller)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const Outcome outcome = run_program(folder, "verify scene.xml --out out --jobs 1 --quantity trajectory.csv:displacement"
                                              " --set integrator/type=sdirk2 --set time/control/type=error");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_holds(folder, 0, std::cos(2), 10);
  EXPECT_NE(outcome.out.find("tolerances of time/control, times 1: "), std::string::npos) << outcome.out;
}

/// A cell of muscle: eight, and one of degree 3, are finer; 64 are the reference.
TEST(Verify, HoldsAFinerBlock)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  const Outcome outcome = run_program(folder, "verify scene.xml --out out --jobs 1 --at-most 8 --quantity \"reaction.csv:moving end x\"");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(run_program(folder, "run scene.xml --out fine --quiet --set system/geometry/refinement=2 --set time/step=0.0025").exit_code, 0);
  const auto fine = myolines::scene::read_csv(folder / "fine/reaction.csv");
  expect_holds(folder, 0, std::stod(fine->rows.back()[fine->column("moving end x [N]").value()]), 20);
  EXPECT_NE(outcome.out.find("Energy: the balance of the scene drifts by"), std::string::npos) << outcome.out;
}

/// Newton's method has two iterations, too few for steps four times as long.
TEST(Verify, NamesTheRunThatFailsAndKeepsTheOthers)
{
  const TestFolder folder;
  folder.write("scene.xml", oscillator_scene);
  const Outcome outcome = run_program(folder, "verify scene.xml --out out --jobs 1 --at-most 1 --quantity trajectory.csv:displacement"
                                              " --set time/control/type=fixed --set solver/nonlinear/maximum\\ iterations=2"
                                              " --set time/step=0.025");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_NE(outcome.err.find("the run \"time_step=0.1\" failed: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("time/step 0.05: "), std::string::npos) << outcome.out;
}
