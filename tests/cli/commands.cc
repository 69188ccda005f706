// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/places.h"
#include "program_runner.h"
#include "small_scenes.h"

#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>

#include <gtest/gtest.h>

using namespace myolines;

namespace
{
  /// All numbers of a table of them, row by row, without its header.
  std::vector<double> read_numbers(const std::filesystem::path &table)
  {
    std::ifstream file(table);
    std::string   cell;
    std::getline(file, cell);
    std::vector<double> numbers;
    for (std::string line; std::getline(file, line);)
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        numbers.push_back(std::stod(cell));
    return numbers;
  }
} // namespace

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
  EXPECT_NE(contents(folder / "results/swing/ledger.json").find("\"CPU of the run\""), std::string::npos);
}

TEST(Commands, RefuseAnEmptyPlaceToWriteTo)
{
  const TestFolder folder;
  folder.write("scene.xml", oscillator_scene);
  for (const char *command :
       {"run scene.xml", "study scene.xml", "verify scene.xml --quantity motion.csv:u", "plot results", "report results"})
    {
      const Outcome outcome = run_program(folder, std::string(command) + " --out ''");
      EXPECT_EQ(outcome.exit_code, 2) << command;
      EXPECT_NE(outcome.err.find("it has no name"), std::string::npos) << outcome.err;
      EXPECT_FALSE(std::filesystem::exists(folder / "results")) << command;
    }
  // Nor is the folder that one is in meant.
  for (const char *command : {"run ''", "study ''", "plot ''", "picture ''", "report ''", "compare '' ''", "compare results ''",
                              "import flexodeal '' strain.dat activation.dat --out new.xml"})
    {
      const Outcome outcome = run_program(folder, command);
      EXPECT_EQ(outcome.exit_code, 2) << command;
      EXPECT_NE(outcome.err.find("it has no name"), std::string::npos) << command << "\n" << outcome.err;
    }
}

/// On every processor that there is, the narrowest kernels do; forces of the widest agree to the tolerance of the solvers.
TEST(Run, HasTheKernelsThatItIsAskedFor)
{
  const TestFolder folder;
  folder.write("muscle.xml", muscle_scene);
  ASSERT_EQ(run_program(folder, "run muscle.xml --quiet --out narrow --set time/end=0.02 --instruction-set baseline").exit_code, 0);
  EXPECT_NE(contents(folder / "narrow/manifest.json").find("\"instruction set\": \"baseline\""), std::string::npos);
  EXPECT_NE(contents(folder / "narrow/checkpoint").find("\"instruction set\": \"baseline\""), std::string::npos);
  const Outcome resumed = run_program(folder, "run muscle.xml --quiet --out narrow --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ASSERT_EQ(run_program(folder, "run muscle.xml --quiet --out widest").exit_code, 0);
  const auto [of_narrow, of_widest] = std::pair(read_numbers(folder / "narrow/reaction.csv"), read_numbers(folder / "widest/reaction.csv"));
  ASSERT_EQ(of_narrow.size(), of_widest.size());
  for (std::size_t i = 0; i < of_widest.size(); ++i)
    EXPECT_NEAR(of_narrow[i], of_widest[i], 1e-6 * (1 + std::abs(of_widest[i])));
  const InstructionSet widest = widest_instruction_set();
  if (widest != InstructionSet::baseline)
    {
      EXPECT_NE(contents(folder / "narrow/manifest.json").find(std::string("instruction set: ") + name(widest) + " instead of baseline"),
                std::string::npos);
    }
  const Outcome unknown = run_program(folder, "run muscle.xml --out unknown --instruction-set sse9");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("there is no \"sse9\""), std::string::npos) << unknown.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "unknown"));
  EXPECT_EQ(run_program(folder, "run muscle.xml --out wide --instruction-set avx512").exit_code, widest == InstructionSet::avx512 ? 0 : 2);
}

/// u = 1, v = 0 of u'' + u = 0: backward Euler leaves 1/(1 + h^2) of the energy in every step.
TEST(Run, EndsWithTheBalanceOfItsEnergy)
{
  const TestFolder  folder;
  const std::string free = "run swing.xml --set system/mass=1 --set \"system/cubic stiffness=0\" --set \"system/force/points=0 0; 1 0\" ";
  folder.write("swing.xml", oscillator_scene);
  const Outcome outcome = run_program(folder, free + "--out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Energy: 0.0474 J, 9.47 % of the 0.5 J exchanged, went into numerical dissipation of \"backward euler\"."),
            std::string::npos)
      << outcome.out;
  const std::string manifest = contents(folder / "out/manifest.json");
  EXPECT_NE(manifest.find("\"exchanged [J]\": 0.5"), std::string::npos) << manifest;
  EXPECT_NE(manifest.find("\"drift [J]\": -0.047"), std::string::npos) << manifest;

  const Outcome refused =
      run_program(folder, "run swing.xml --out g --set \"time/control/largest gain=1e-30\"  --set integrator/type=newmark");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("the balance of energy gains "), std::string::npos) << refused.err;
  EXPECT_NE(contents(folder / "g/steps.csv").find("energy gained"), std::string::npos);
}

/// A method that is linearly implicit is wrong in steps that are much too long, and does not fail.
TEST(Run, WarnsOfEnergyFromNowhereInAMuscle)
{
  const TestFolder  folder;
  const std::string active = "run muscle.xml --set time/step=5e-3 --set system/activation/type=ramp --set system/activation/duration=0.02 "
                             "--set system/activation/amplitude=0.5 ";
  folder.write("muscle.xml", muscle_scene);
  const Outcome outcome = run_program(folder, active + "--out out --set integrator/type=rosenbrock");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Warning: from t = 0 s to t = 0.04 s the balance of energy gains "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\"rosenbrock\" is wrong there"), std::string::npos) << outcome.out;
  const Outcome usual = run_program(folder, active + "--out usual");
  EXPECT_NE(usual.out.find("Energy: "), std::string::npos) << usual.out;
  EXPECT_EQ(usual.out.find("the balance of energy gains"), std::string::npos) << usual.out;

  const Outcome refused = run_program(
      folder,
      active + "--out refused --set integrator/type=rosenbrock --set time/control/type=fixed --set \"time/control/largest gain=1e-4\"");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("more than 0.0001 J"), std::string::npos) << refused.err;
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

/// It writes out the muscle that the body does not have, with its defaults.
TEST(Run, ResolvedSceneOfABodyWithoutMuscleIsOne)
{
  const TestFolder  folder;
  std::string       scene    = muscle_scene;
  const std::string geometry = "<ParameterList name=\"geometry\">", boundary = "<ParameterList name=\"boundary\">";
  scene.insert(scene.find(geometry) + geometry.size(), "<Parameter name=\"tissue\" type=\"string\" value=\"rubber\"/>");
  scene.insert(scene.find(boundary),
               "<ParameterList name=\"tissues\"><ParameterList name=\"own\"><ParameterList name=\"rubber\"><ParameterList name=\"laws\">"
               "<ParameterList name=\"base\"><Parameter name=\"type\" type=\"string\" value=\"yeoh\"/></ParameterList>"
               "</ParameterList></ParameterList></ParameterList></ParameterList>");
  folder.write("rubber.xml", scene);
  const Outcome run = run_program(folder, "run rubber.xml --out a --quiet");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Outcome again = run_program(folder, "run a/scene.resolved.xml --out b --quiet");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(contents(folder / "a/reaction.csv"), contents(folder / "b/reaction.csv"));
  const Outcome wrong = run_program(folder, "check rubber.xml --set \"system/tissues/muscle/fibre/maximum isometric stress=1e5\"");
  EXPECT_EQ(wrong.exit_code, 2) << "a muscle of one's own is not passed over";
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

TEST(Run, StepsChosenByErrorEndAtTheirMinimum)
{
  // A push within a microsecond, smooth, so that no kink tells of it.
  const TestFolder folder;
  folder.write("push.xml", R"(<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="oscillator"/>
    <ParameterList name="force">
      <Parameter name="type" type="string" value="smooth step"/>
      <Parameter name="amplitude" type="double" value="1e6"/>
      <Parameter name="start" type="double" value="0.5"/>
      <Parameter name="duration" type="double" value="1e-6"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="tr-bdf2"/></ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="1"/>
    <Parameter name="step" type="double" value="0.01"/>
    <ParameterList name="control">
      <Parameter name="type" type="string" value="error"/>
      <Parameter name="minimum step" type="double" value="1e-3"/>
    </ParameterList>
  </ParameterList>
</ParameterList>)");
  const Outcome checked = run_program(folder, "check push.xml");
  EXPECT_NE(checked.out.find("Steps: chosen by error from 0 s to 1 s, estimated by the method"), std::string::npos) << checked.out;
  const Outcome run = run_program(folder, "run push.xml --out out --quiet");
  EXPECT_EQ(run.exit_code, 3);
  for (const char *part : {"times the tolerance", "\"minimum step\"", "--resume"})
    EXPECT_NE(run.err.find(part), std::string::npos) << part << " in: " << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/checkpoint"));
  const Outcome resumed = run_program(folder, "run push.xml --out out --quiet --resume --set \"time/control/minimum step=0\"");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

TEST(Run, OutputNeverChangesTheSteps)
{
  const TestFolder folder;
  folder.write("swing.xml", oscillator_scene);
  folder.write("muscle.xml", muscle_scene);
  const std::string by_error = " --quiet --set time/control/type=error --set time/step=0.01 ";
  ASSERT_EQ(run_program(folder, "run swing.xml --out plain" + by_error).exit_code, 0);
  ASSERT_EQ(run_program(folder, "run swing.xml --out dense --set output/motion/interval=0.01" + by_error).exit_code, 0);
  EXPECT_EQ(contents(folder / "dense/steps.csv"), contents(folder / "plain/steps.csv"));
  const std::string motion = contents(folder / "dense/motion.csv");
  EXPECT_EQ(motion.substr(0, motion.find('\n')), "Time [s],Displacement [m],Velocity [m/s]");
  EXPECT_EQ(std::count(motion.begin(), motion.end(), '\n'), 102) << "a header, and 0, 0.01, ..., 1";

  std::string       muscle  = muscle_scene;
  const std::size_t markers = muscle.find("\"markers\"");
  ASSERT_NE(markers, std::string::npos);
  ASSERT_EQ(run_program(folder, "run muscle.xml --out muscle --quiet --set output/motion/interval=0.005").exit_code, 0);
  EXPECT_NE(contents(folder / "muscle/motion.csv").find("_x [m]"), std::string::npos);
  const std::size_t begin = muscle.rfind('<', markers);
  muscle.erase(begin, muscle.find("/>", markers) + 2 - begin);
  folder.write("muscle.xml", muscle);
  const Outcome refused = run_program(folder, "check muscle.xml --set output/motion/interval=0.01");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("no markers"), std::string::npos) << refused.err;
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

TEST(Check, WarnsOfNoMethodThatMeetsAJumpOfVelocity)
{
  const TestFolder  folder;
  const std::string coarse =
      "check " + myolines::test::source_folder() +
      "/input/kinked_block.xml --set system/geometry/refinement=1 --set 'time/boundary rates=exact' --set time/events=restart ";
  for (const std::string method : {"sdirk2", "newmark", "generalized alpha", "tr-bdf2"})
    {
      const Outcome outcome = run_program(folder, coarse + "--set 'integrator/type=" + method + "'");
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(outcome.out.find("Warning:"), std::string::npos) << outcome.out;
    }
  EXPECT_NE(run_program(folder, coarse + "--set 'integrator/type=wilson theta'").out.find("met beyond the ends of steps"),
            std::string::npos);
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
        std::ostringstream text, report;
        try
          {
            template_command(system.name, integrator.facts.name, text);
          }
        catch (const InputError &)
          {
            EXPECT_TRUE(!integrator.facts.dynamic || integrator.facts.two_states) << system.name << ", " << integrator.facts.name;
            continue;
          }
        check_command(folder.write("template.xml", text.str()), {}, false, report);
        EXPECT_NE(report.str().find("Integrator: " + integrator.facts.name), std::string::npos);
      }
}

// Without a name it follows doc/which_method.md.
TEST(Template, BeginsWithSdirk3AndStepsByError)
{
  const TestFolder folder;
  for (const SystemEntry &system : system_catalogue())
    {
      std::ostringstream text, report;
      template_command(system.name, "", text);
      check_command(folder.write("template.xml", text.str()), {}, false, report);
      EXPECT_NE(report.str().find("Integrator: sdirk3"), std::string::npos) << system.name;
      EXPECT_NE(report.str().find("Steps: chosen by error"), std::string::npos) << system.name;
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
      if (topic != "plug-ins") // there are none here
        EXPECT_GT(items, 0u) << topic;
    }
}

/// The manual has it as pages, which doc/check compares.
TEST(Reference, HasEveryMethodAndRefusesOtherPages)
{
  const TestFolder folder;
  const Outcome    all = run_program(folder, "list --markdown");
  EXPECT_EQ(all.exit_code, 0);
  for (const IntegratorEntry &integrator : integrator_registry())
    EXPECT_NE(all.out.find("\n## " + integrator.facts.name + "\n"), std::string::npos) << integrator.facts.name;
  for (const SystemEntry &system : system_catalogue())
    EXPECT_NE(all.out.find("\n## " + system.name + "\n"), std::string::npos) << system.name;
  EXPECT_NE(all.out.find("**`system/geometry/type = block`**"), std::string::npos);
  const Outcome other = run_program(folder, "list sytems --markdown");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("systems"), std::string::npos) << other.err;
}

TEST(Help, IsEverywhere)
{
  const TestFolder folder;
  for (const std::string command : {"", "run", "check", "study", "plot", "list", "template", "import", "import flexodeal"})
    {
      const Outcome outcome = run_program(folder, command + " --help");
      EXPECT_EQ(outcome.exit_code, 0) << command;
      EXPECT_NE(outcome.out.find("Usage:"), std::string::npos) << command;
    }
}

/// Planning a million steps takes moments; more are not counted.
TEST(Check, DoesNotPlanWithoutEnd)
{
  const TestFolder folder;
  folder.write("scene.xml", oscillator_scene);
  const Outcome few = run_program(folder, "check scene.xml --set time/step=0.25 --set time/events=ignore");
  EXPECT_NE(few.out.find("Steps: 4 from 0 s to 1 s, if none is rejected\n  4 x 0.25 s\n"), std::string::npos) << few.out;
  const Outcome many = run_program(folder, "check scene.xml --set time/step=1e-9");
  EXPECT_EQ(many.exit_code, 0) << many.err;
  EXPECT_NE(many.out.find("Steps: more than 1000000 from 0 s"), std::string::npos) << many.out;
}
