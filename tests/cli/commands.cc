#include "program_runner.h"
#include "small_scenes.h"

#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>

#include <gtest/gtest.h>

using namespace myolines;

TEST(Run, WritesItsFolderAndSaysWhere)
{
  const TestFolder folder;
  folder.write("swing.xml", oscillator_scene);
  const Outcome outcome = run_program(folder, "run swing.xml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("results/swing"), std::string::npos);
  for (const char *file : {"scene.resolved.xml", "manifest.json", "ledger.json", "run.log", "steps.csv", "trajectory.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder / "results/swing" / file)) << file;
  EXPECT_NE(contents(folder / "results/swing/manifest.json").find("\"exit reason\": \"done\""), std::string::npos);
}

TEST(Run, ResolvedSceneGivesTheSameNumbers)
{
  const TestFolder folder;
  folder.write("muscle.xml", muscle_scene);
  ASSERT_EQ(run_program(folder, "run muscle.xml --out a --set \"system/geometry/width=0.02\" --quiet").exit_code, 0);
  ASSERT_EQ(run_program(folder, "run a/scene.resolved.xml --out b --quiet").exit_code, 0);
  EXPECT_EQ(contents(folder / "a/reaction.csv"), contents(folder / "b/reaction.csv"));
  EXPECT_EQ(contents(folder / "a/scene.resolved.xml"), contents(folder / "b/scene.resolved.xml"));
  EXPECT_NE(contents(folder / "a/scene.resolved.xml").find("name=\"width\" type=\"double\" value=\"0.02\""), std::string::npos);
}

/// One Newton step cannot solve a cubic: the failure is told, with exit code 3, and the folder is closed properly.
TEST(Run, FailedSolveKeepsItsBooks)
{
  const TestFolder folder;
  folder.write("swing.xml", oscillator_scene);
  const Outcome outcome =
      run_program(folder, "run swing.xml --out out --set \"solver/nonlinear/maximum iterations=1\" --set \"time/control/type=fixed\"");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("The solve failed: "), std::string::npos) << outcome.err;
  EXPECT_EQ(contents(folder / "out/manifest.json").find("\"exit reason\": \"done\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/ledger.json"));
}

TEST(Check, TellsSizesStepsAndWarnings)
{
  const TestFolder folder;
  folder.write("muscle.xml", muscle_scene);
  const Outcome outcome = run_program(folder, "check muscle.xml --set \"system/discretisation/quadrature points=3\" --set time/step=0.015");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("unknowns: 81"), std::string::npos);
  EXPECT_NE(outcome.out.find("cells: 1"), std::string::npos);
  EXPECT_NE(outcome.out.find("Warning: dynamic runs of degree 2 want at least 4"), std::string::npos);
  // steps of the plan end at 0.015, 0.03, 0.04, the kink of the strain is at 0.02
  EXPECT_NE(outcome.out.find("Steps: 4 from 0 s to 0.04 s"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(folder / "results"));
  const std::string checked = run_program(folder, "check muscle.xml").out;
  EXPECT_EQ(checked.find("Warning"), std::string::npos);
  EXPECT_NE(checked.find("tangent in Krylov solves: matrix-free"), std::string::npos);
  EXPECT_NE(checked.find("preconditioner: direct (automatic: 81 unknowns, two levels)"), std::string::npos);
}

TEST(Check, TellsWhatFollowsFromTheParametersOfTheIntegrator)
{
  const TestFolder folder;
  folder.write("swing.xml", oscillator_scene);
  const Outcome outcome = run_program(
      folder, "check swing.xml --set \"integrator/type=generalized alpha\" --set \"integrator/spectral radius at infinity=0.5\"");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("alpha_m = 0, alpha_f = 0.333333333333"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("spectral radius at infinity 0.5"), std::string::npos) << outcome.out;
}

TEST(Template, OfEverySystemAndIntegratorPassesCheck)
{
  const TestFolder folder;
  for (const SystemEntry &system : system_catalogue())
    for (const IntegratorEntry &integrator : integrator_registry())
      {
        if (!integrator.facts.dynamic && system.without_inertia.empty())
          continue;
        std::ostringstream text, report;
        template_command(system.name, integrator.facts.name, text);
        check_command(folder.write("template.xml", text.str()), {}, report);
        EXPECT_NE(report.str().find("Integrator: " + integrator.facts.name), std::string::npos);
      }
}

TEST(List, EveryTopicDescribesEveryItemItNames)
{
  for (const std::string &topic : list_topics())
    {
      std::ostringstream all;
      list_command(topic, "", all);
      std::istringstream lines(all.str());
      unsigned int       items = 0;
      for (std::string line; std::getline(lines, line);)
        if (!line.empty() && line[0] != ' ')
          {
            std::ostringstream one;
            list_command(topic, line, one);
            EXPECT_EQ(one.str().substr(0, line.size()), line);
            ++items;
          }
      EXPECT_GT(items, 0u) << topic;
    }
}

TEST(Help, IsEverywhere)
{
  const TestFolder folder;
  for (const std::string command : {"", "run", "check", "list", "template", "import", "import flexodeal"})
    {
      const Outcome outcome = run_program(folder, command + " --help");
      EXPECT_EQ(outcome.exit_code, 0) << command;
      EXPECT_NE(outcome.out.find("Usage:"), std::string::npos) << command;
    }
}
