// SPDX-License-Identifier: LGPL-2.1-or-later
// Scenes of input/ against numbers of other programs.
#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

namespace
{
  /// The last row of a CSV file of the run `run ARGUMENTS`.
  std::vector<double> last_row(const TestFolder &folder, const std::string &arguments, const std::string &file)
  {
    const Outcome outcome = run_program(folder, "run " + myolines::test::source_folder() + "/input/" + arguments + " --quiet --out out");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream lines(contents(folder / "out" / file));
    std::string        last;
    for (std::string line; std::getline(lines, line);)
      last = line;
    std::istringstream  cells(last);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');)
      row.push_back(std::stod(cell));
    return row;
  }
} // namespace

/// Against deal.II's tutorial program step 44 (version 9.4.1, Q2 with discontinuous P1, 10 load steps, direct solver).
TEST(Verification, IndentedBlock)
{
  const std::pair<std::string, double> cases[] = {
      {"--set system/geometry/refinement=1 --set 'solver/preconditioner/type=p multigrid'", -2.118656564863e-04},
      {"--set system/geometry/refinement=1 --set solver/preconditioner/type=direct", -2.118656564863e-04},
      {"--set system/geometry/refinement=2 --set solver/preconditioner/type=direct", -2.186237161713e-04}};
  for (const auto &[settings, corner] : cases)
    {
      const TestFolder folder;
      const auto       row = last_row(folder, "verification/indented_block.xml " + settings, "displacements-3d.csv");
      ASSERT_EQ(row.size(), 4u);
      EXPECT_NEAR(row[2], corner, 1e-6 * std::abs(corner)) << settings;
      EXPECT_EQ(contents(folder / "out" / "steps.csv").find("not converged"), std::string::npos);
    }
}

/// Problem 1 of Land et al. (2015), doi:10.1098/rspa.2015.0641: the codes of the benchmark find the tip at z = 4.0 to 4.2 mm, 1 mm of which
/// is its height.
TEST(Verification, BeamOfGuccione)
{
  const TestFolder folder;
  const auto       row = last_row(folder, "verification/guccione_beam.xml", "displacements-3d.csv");
  ASSERT_EQ(row.size(), 4u);
  EXPECT_GT(1e-3 + row[3], 4.10e-3);
  EXPECT_LT(1e-3 + row[3], 4.20e-3);
  EXPECT_NEAR(row[2], 0, 1e-9); // nothing bends it sideways
  EXPECT_EQ(contents(folder / "out" / "steps.csv").find("not converged"), std::string::npos);
}

/// Against an independent serial study: 26.845 N at the end, 20 steps, none rejected.
TEST(Verification, ActiveLengthening)
{
  const TestFolder folder;
  const auto       row = last_row(folder, "active_lengthening.xml", "reaction.csv");
  ASSERT_EQ(row.size(), 9u); // two vectors and their parts along the line
  EXPECT_NEAR(row[1], 26.845, 1e-3 * 26.845);
  EXPECT_EQ(contents(folder / "out" / "steps.csv").find("not converged"), std::string::npos);
}

/// The solvers of SUNDIALS, whose Newton's method is damped: each solves all its equations, and comes to the force of a
/// method of ours with short steps. At default tolerances the force of `cvode` is right to 1e-3 or not by the order in which numbers are
/// added up; at these it is to 4e-5 with the kernels of every processor.
TEST(Verification, ActiveLengtheningByOtherSolvers)
{
  const std::string scene =
      "active_lengthening.xml --unset 'time/boundary rates' --set system/geometry/refinement=0 --set integrator/type=";
  const std::string fixed = "sdirk3 --set time/step=2e-3";
  const std::string error = " --set time/control/type=error --set 'time/control/displacement/relative tolerance=1e-4'"
                            " --set 'time/control/displacement/absolute tolerance=1e-8'";
  const TestFolder  folder;
  const auto        ours = last_row(folder, scene + fixed, "reaction.csv");
  ASSERT_EQ(ours.size(), 9u);
  for (const char *method : {"arkode", "cvode --set 'integrator/maximum order=2'", "ida --set 'integrator/maximum order=2'"})
    {
      const TestFolder other;
      const auto       row = last_row(other, scene + method + error, "reaction.csv");
      ASSERT_EQ(row.size(), 9u) << method;
      EXPECT_NEAR(row[1], ours[1], 1e-3 * ours[1]) << method;
      EXPECT_NE(contents(other / "out" / "ledger.json").find("\"nonlinear convergence failures\": 0,"), std::string::npos) << method;
    }
}
