// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: the scene that `advise` writes has the accuracy that was asked for, with the error that was predicted; it goes on where it
// was, and tells what it cannot do.

#include "program_runner.h"
#include "small_scenes.h"

#include <myolines/scene/csv.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using Row = std::map<std::string, std::string>;

  /// The row of advise.csv of the method that is advised, or of another one.
  Row row_of_advice(const TestFolder &folder, const std::string &method = "")
  {
    const auto table = myolines::scene::read_csv(folder / "out/advise.csv");
    for (const auto &cells : table.value().rows)
      if (method.empty() ? cells.at(table->column("advised").value()) == "yes" : cells.front() == method)
        {
          Row row;
          for (std::size_t i = 0; i < cells.size(); ++i)
            row[table->header[i]] = cells[i];
          return row;
        }
    throw std::runtime_error("advise.csv has no row of \"" + method + "\"");
  }

  /// Runs advised.xml and gives the last value of a column.
  double value_as_advised(const TestFolder &folder, const std::string &file, const std::string &column)
  {
    const Outcome outcome = run_program(folder, "run advised.xml --out advised --quiet");
    if (outcome.exit_code != 0)
      throw std::runtime_error(outcome.err);
    const auto table = myolines::scene::read_csv(folder / ("advised/" + file));
    return std::stod(table->rows.back().at(table->column(column).value()));
  }

  const std::string of_oscillation = "advise scene.xml --out out --quantity trajectory.csv:displacement --jobs 1 --write advised.xml";
} // namespace

/// u(2) = cos(2).
TEST(Advise, OscillationHasTheErrorThatWasPredicted)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  for (const double accuracy : {0.01, 1e-4})
    {
      const Outcome outcome = run_program(folder, of_oscillation + " --accuracy " + std::to_string(100 * accuracy) + "%");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const double error     = std::abs(value_as_advised(folder, "trajectory.csv", "Displacement [m]") - std::cos(2)),
                   predicted = std::stod(row_of_advice(folder)["error of steps, trajectory.csv:displacement"]);
      EXPECT_LE(error, accuracy * std::abs(std::cos(2))) << outcome.out;
      EXPECT_LE(error, 2 * predicted) << outcome.out;
      EXPECT_EQ(row_of_advice(folder, "backward euler")["advised"], "no");
      std::filesystem::remove_all(folder / "advised");
    }
}

/// Each method that has a rank among the accurate ones is as accurate as its row says.
TEST(Advise, ErrorsOfMethodsAreThoseBesideTheExactSolution)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  ASSERT_EQ(run_program(folder, of_oscillation + " --accuracy 0.01").exit_code, 0);
  const auto table = myolines::scene::read_csv(folder / "out/advise.csv");
  int        found = 0;
  for (const auto &cells : table.value().rows)
    if (const std::string value = cells.at(table->column("value, trajectory.csv:displacement").value()); !value.empty())
      {
        const double error = std::stod(cells.at(table->column("error of steps, trajectory.csv:displacement").value()));
        EXPECT_LE(std::abs(std::stod(value) - std::cos(2)), 1.5 * error + 1e-12) << cells.front();
        ++found;
      }
  EXPECT_GE(found, 15);
}

TEST(Advise, GoesOnWhereItWas)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const std::string command   = of_oscillation + " --accuracy \"1 %\"";
  const Outcome     cut_short = run_program(folder, command + " --budget 0.02");
  EXPECT_EQ(cut_short.exit_code, 3);
  EXPECT_NE(cut_short.err.find("0.02 s of --budget are spent"), std::string::npos) << cut_short.err;
  ASSERT_EQ(run_program(folder, command).exit_code, 0);
  const std::size_t n       = occurrences(contents(folder / "out/study.log"), "  done  ");
  const std::string advised = contents(folder / "out/advise.csv");
  ASSERT_EQ(run_program(folder, command).exit_code, 0);
  EXPECT_EQ(occurrences(contents(folder / "out/study.log"), "  done  "), n);
  EXPECT_EQ(contents(folder / "out/advise.csv"), advised);
}

/// Until the wave comes back the force of a rod that is pulled by 0.1 t^3 is A sqrt(E rho) 0.3 t^2.
TEST(Advise, ChoosesTheMeshOfARod)
{
  const TestFolder folder;
  folder.write("scene.xml", pulled_rod);
  const double  stiffness = 3 * 1e6 * (1 - 2 * 0.499), density = 1060, exact = 1e-4 * std::sqrt(stiffness * density) * 0.3 * 0.3 * 0.3;
  const Outcome outcome = run_program(folder, "advise scene.xml --out out --jobs 1 --write advised.xml --accuracy \"4 %\" --at-most 100"
                                              " --quantity \"reaction.csv:moving end x\"");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("system/elements = "), std::string::npos) << outcome.out;
  const Row    row       = row_of_advice(folder);
  const double error     = std::abs(value_as_advised(folder, "reaction.csv", "moving end x [N]") - exact),
               predicted = std::stod(row.at("error of steps, reaction.csv:moving end x")) +
                           std::stod(row.at("error of mesh, reaction.csv:moving end x"));
  EXPECT_LE(error, 0.04 * exact) << outcome.out;
  EXPECT_LE(error, 2 * predicted) << outcome.out;

  const Outcome refused = run_program(folder, "advise scene.xml --out out --jobs 1 --accuracy \"0.001 %\" --at-most 1"
                                              " --quantity \"reaction.csv:moving end x\"");
  EXPECT_EQ(refused.exit_code, 3) << refused.out;
  EXPECT_NE(refused.err.find("--keep-mesh"), std::string::npos) << refused.err;
}

/// One cell of muscle, with steps that the scene has as a schedule.
TEST(Advise, KeepsTheMeshOfAMuscle)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  const std::string smooth = " --set \"system/boundary/moving end/strain/type=smooth step\""
                             " --set \"system/boundary/moving end/strain/amplitude=0.05\""
                             " --set \"system/boundary/moving end/strain/duration=0.2\" --set time/end=0.2";
  const Outcome     outcome =
      run_program(folder, "advise scene.xml" + smooth +
                              " --unset time/step --set \"time/steps=2 x 0.05; 4 x 0.025\" --out out --jobs 1"
                              " --keep-mesh --write advised.xml --accuracy \"0.1 %\" --quantity \"reaction.csv:moving end x\"");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(
      run_program(folder, "run scene.xml" + smooth + " --set time/step=1e-3 --set integrator/type=sdirk2 --out fine --quiet").exit_code, 0);
  const auto   fine  = myolines::scene::read_csv(folder / "fine/reaction.csv");
  const double truth = std::stod(fine->rows.back().at(fine->column("moving end x [N]").value())),
               error = std::abs(value_as_advised(folder, "reaction.csv", "moving end x [N]") - truth);
  EXPECT_LE(error, 0.001 * std::abs(truth)) << outcome.out;
  EXPECT_LE(error, 2 * std::stod(row_of_advice(folder)["error of steps, reaction.csv:moving end x"])) << outcome.out;
  EXPECT_NE(row_of_advice(folder, "static")["outcome"].find("inertia"), std::string::npos);
}

TEST(Advise, RefusesByName)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const auto refusal = [&](const std::string &arguments) {
    const Outcome refused = run_program(folder, "advise scene.xml --out out --jobs 1 " + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments << refused.out;
    return refused.err;
  };
  const std::string known = " --quantity trajectory.csv:displacement ";
  EXPECT_NE(refusal("--accuracy 1%").find("--quantity"), std::string::npos);
  EXPECT_NE(refusal(known).find("--accuracy"), std::string::npos);
  EXPECT_NE(refusal(known + "--accuracy much").find("\"1 %\""), std::string::npos);
  EXPECT_NE(refusal(known + "--accuracy 0").find("positive"), std::string::npos);
  EXPECT_NE(refusal(known + "--accuracy=-1%").find("positive"), std::string::npos);
  EXPECT_NE(refusal(known + "--accuracy 1% --unset time/step").find("neither"), std::string::npos);
  EXPECT_NE(refusal(known + "--accuracy 1% --write scene.xml").find("the scene itself"), std::string::npos);
  EXPECT_NE(refusal("--accuracy 1% --quantity trajectory.csv:displacment").find("nearest: \"Displacement\""), std::string::npos);
  EXPECT_NE(refusal("--accuracy 1% --quantity \"trajectory.csv:displacement\" --set system/displacement=0").find("is 0"),
            std::string::npos);
}
