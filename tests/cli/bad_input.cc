// SPDX-License-Identifier: LGPL-2.1-or-later
#include "program_runner.h"
#include "small_scenes.h"

#include <gtest/gtest.h>

namespace
{
  struct BadInput
  {
    std::string name;
    std::string scene; ///< a valid one
    std::string from;  ///< what to replace in it ...
    std::string to;    ///< ... by what
    std::string message;
    std::string arguments = "run scene.xml";
  };

  std::string spoilt(const BadInput &input)
  {
    const auto at = input.scene.find(input.from);
    if (at == std::string::npos)
      throw std::logic_error("the scene has no \"" + input.from + "\"");
    std::string text = input.scene;
    return text.replace(at, input.from.size(), input.to);
  }

  const std::string &o = oscillator_scene, &m = muscle_scene;

  BadInput command(const std::string &name, const std::string &arguments, const std::string &message)
  {
    return {name, o, "", "", message, arguments};
  }

  const std::string free = "check scene.xml --unset \"system/boundary/moving end\" --unset \"system/boundary/fixed end\" ";
  const std::string push = "--set \"system/initial motion/displacement x=0.1*x\" ";

  const std::vector<BadInput> bad_inputs{
      {"free_in_equilibrium", m, "", "", "nothing holds this one against 3 translations and 3 rotations",
       free + "--set \"time/start state=equilibrium\""},
      {"free_without_inertia", m, "", "", "system/inertia: a quasi-static system needs a body that is held",
       free + "--set integrator/type=static --set system/inertia=quasi-static"},
      {"displaced_and_in_equilibrium", m, "", "", "which an equilibrium would replace",
       "check scene.xml " + push + "--set \"time/start state=equilibrium\""},
      {"velocity_without_inertia", m, "", "", "a body without inertia has no initial velocity",
       "check scene.xml --set \"system/initial motion/velocity y=0.1*x\" --set integrator/type=static --set system/inertia=quasi-static"},
      {"unknown_system", o, "\"oscillator\"", "\"ocillator\"", "nearest valid name: \"oscillator\""},
      {"missing_system", o, R"(<Parameter name="type" type="string" value="oscillator"/>)", "", "system/type"},
      {"unknown_integrator", o, "\"backward euler\"", "\"forward euler\"", "nearest valid name: \"backward euler\""},
      command("preconditioner_without_levels", "check scene.xml --set \"solver/preconditioner/type=p multigrid\"", "needs a coarser level"),
      {"unknown_list", o, "name=\"integrator\"", "name=\"integrater\"", "nearest valid name: \"integrator\""},
      {"misspelt", o, "name=\"mass\"", "name=\"mas\"", "nearest valid name: \"mass\""},
      {"unknown_parameter", m, "name=\"refinement\" type=\"int\"", "name=\"colour\" type=\"string\"",
       "system/geometry/colour: unknown parameter"},
      {"duplicate", o, "name=\"cubic stiffness\"", "name=\"mass\"", "duplicate: \"mass\""},
      {"mistyped_number", o, "value=\"2\"", "value=\"abc\"", "system/mass: \"abc\" is not a finite number"},
      {"infinite", o, "value=\"2\"", "value=\"inf\"", "\"inf\" is not a finite number"},
      {"wrong_type", o, "type=\"double\" value=\"2\"", "type=\"string\" value=\"2\"", "type=\"double\""},
      {"zero_mass", o, "value=\"2\"", "value=\"0\"", "system/mass: 0 is out of range"},
      {"negative_length", m, "value=\"0.03\"", "value=\"-0.03\"", "system/geometry/length: -0.03 is out of range"},
      {"zero_length", m, "value=\"0.03\"", "value=\"0\"", "expected: a number [m] > 0"},
      {"negative_step", o, "value=\"0.1\"", "value=\"-0.1\"", "time/step: -0.1 is out of range"},
      {"negative_refinement", m, "type=\"int\" value=\"0\"", "type=\"int\" value=\"-1\"", "in [0, 8]"},
      {"end_before_start", o, "name=\"end\" type=\"double\" value=\"1\"", "name=\"end\" type=\"double\" value=\"-1\"", "time/end"},
      {"missing_end", o, R"(<Parameter name="end" type="double" value="1"/>)", "", "missing parameter \"end\""},
      {"missing_points_file", o, "name=\"points\" type=\"string\" value=\"0 0; 0.3 1; 0.5 1\"",
       "name=\"file\" type=\"string\" value=\"nowhere.dat\"", "there is no file"},
      {"unsorted_points", o, "0.5 1", "0.2 1", "unsorted: time 0.2"},
      {"nan_point", o, "0.3 1", "0.3 nan", "\"nan\" is not a finite number"},
      {"jump", o, "0.3 1", "0 1", "strictly ascending"},
      {"unsorted_strain", m, "0 0; 0.02 0.01", "0 0; -0.02 0.01", "system/boundary/moving end/strain/points"},
      {"unknown_face", m, "\"x+\"", "\"front\"", "one of x-, x+, y-, y+, z-, z+"},
      {"inside_out", m, "0 0; 0.02 0.01", "0 0; 0.02 -1.2", "the boundary strain is -1.2"},
      {"too_active", m, "<ParameterList name=\"boundary\">",
       "<ParameterList name=\"activation\"><Parameter name=\"type\" type=\"string\" value=\"constant\"/>"
       "<Parameter name=\"value\" type=\"double\" value=\"5\"/></ParameterList><ParameterList name=\"boundary\">",
       "activation in [0, 1.1]"},
      {"too_few_points", m, "<ParameterList name=\"boundary\">",
       "<ParameterList name=\"discretisation\"><Parameter name=\"quadrature points\" type=\"int\" value=\"2\"/></ParameterList>"
       "<ParameterList name=\"boundary\">",
       "at least 3 (degree + 1)"},
      {"decimal_comma", m, "<ParameterList name=\"boundary\">",
       "<ParameterList name=\"body force\"><Parameter name=\"x\" type=\"string\" value=\"0,5*t\"/></ParameterList>"
       "<ParameterList name=\"boundary\">",
       "system/body force/x"},
      {"motion_not_prescribed", m, "value=\"strain\"/>", "value=\"strain\"/><Parameter name=\"components\" type=\"string\" value=\"y z\"/>",
       "a component x that is not prescribed"},
      {"conditions_overlap", m, "\"x+\"", "\"x-\"", "moving end"},
      {"marker_outside", m, "0.015 0.005", "0.015 0.5", "middle"},
      {"malformed_marker", m, "middle 0.015", "middle x", "output/series/markers"},
      {"malformed_xml", o, "</ParameterList>", "</Parameterlist>", "malformed XML"},
      {"empty_file", o, o, "", "non-empty file"},
      {"other_document", o, "name=\"scene\"", "name=\"study\"", "<ParameterList name=\"scene\">"},
      {"static_with_inertia", o, "\"backward euler\"", "\"static\"", "ignores inertia"},
      command("missing_scene", "run nowhere.xml", "there is no such file"),
      command("missing_argument", "run", "scene is required"),
      command("unknown_command", "chek scene.xml", "nearest valid name: \"check\""),
      command("no_command", "", "subcommand is required"),
      command("unknown_option", "run scene.xml --outt x", "--outt"),
      command("unwritable_folder", "run scene.xml --out scene.xml/results", "output folder scene.xml/results"),
      command("bad_override", "run scene.xml --set system/mas=3", "nearest valid name: \"mass\""),
      command("override_without_value", "run scene.xml --set system/mass", "path=value"),
      command("check_is_as_strict", "check scene.xml --set time/step=0", "time/step"),
      command("unknown_topic", "list integrater", "nearest valid name: \"integrators\""),
      command("unknown_item", "list integrators \"backwards euler\"", "nearest valid name: \"backward euler\""),
      command("template_of_unknown_system", "template muscle3d", "nearest valid name: \"muscle 3d\""),
      command("template_of_impossible_pair", "template oscillator static", "ignores inertia, but the system has it"),
      command("list_taken_for_a_parameter", "check scene.xml --set time=3", "\"time\" is a list, not a parameter"),
      command("parameter_taken_for_a_list", "check scene.xml --set system/mass/x=3", "\"mass\" is a parameter, not a list"),
      command("step_below_rounding", "check scene.xml --set time/step=1e-320", "below the rounding of the times"),
      command("step_below_rounding_in_a_run", "run scene.xml --set time/step=1e-17", "below the rounding of the times"),
      command("folder_as_scene", "run .", "it is a folder, not a file"),
      command("device_as_scene", "run /dev/null", "it is a device, not a file"),
      command("plot_of_a_file", "plot scene.xml", "it is a file, not a folder"),
      command("modes_along_nowhere", "modes scene.xml --along nowhere", "there is no such folder"),
      command("modes_into_nowhere", "modes scene.xml --out nowhere/modes.csv", "a file that can be made and written"),
      command("no_eigenvalues", "modes scene.xml --along . --number 0", "expected: an integer >= 1"),
      command("no_jobs", "study scene.xml --jobs 0", "expected: an integer >= 1"),
      command("resume_of_nothing", "run scene.xml --resume", "started without --resume"),
      command("import_of_nothing", "import flexodeal a.prm b.dat c.dat --out s.xml", "a.prm"),
  };

  class BadInputs : public ::testing::TestWithParam<BadInput>
  {
  };
} // namespace

/// Exit code 2, a message on stderr that names the trouble, nothing on stdout.
TEST_P(BadInputs, AreRefused)
{
  const TestFolder folder;
  folder.write("scene.xml", spoilt(GetParam()));
  const Outcome outcome = run_program(folder, GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

INSTANTIATE_TEST_SUITE_P(Table, BadInputs, ::testing::ValuesIn(bad_inputs), [](const auto &info) { return info.param.name; });

/// A misspelt command is all that is told: not that one is required.
TEST(BadInput, UnknownCommandsAreToldOnce)
{
  const TestFolder folder;
  const Outcome    outcome = run_program(folder, "chek scene.xml");
  EXPECT_EQ(outcome.err.rfind("unknown command", 0), 0u) << outcome.err;
  EXPECT_EQ(outcome.err.find("required"), std::string::npos) << outcome.err;
}

/// Only `run` has --resume.
TEST(BadInput, HintsFitTheCommand)
{
  const TestFolder folder;
  const Outcome    outcome = run_program(folder, "compare here nowhere");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.find("--resume"), std::string::npos) << outcome.err;
}

TEST(BadInput, TheUnspoiltScenesAreAccepted)
{
  const TestFolder folder;
  folder.write("oscillator.xml", oscillator_scene);
  folder.write("muscle.xml", muscle_scene);
  for (const std::string scene : {"oscillator.xml", "muscle.xml"})
    {
      const Outcome outcome = run_program(folder, "check " + scene);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_NE(outcome.out.find("The scene is valid."), std::string::npos);
    }
}
