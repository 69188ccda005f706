// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: measured data drive a muscle, and the commands of doc/data.md work as they are printed.

#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

namespace
{
  const std::string unit_of_samples =
      "<ParameterList name=\"scene\"><ParameterList name=\"system\">"
      "<Parameter name=\"type\" type=\"string\" value=\"muscle-tendon unit\"/>"
      "<Parameter name=\"masses\" type=\"int\" value=\"0\"/><ParameterList name=\"input\">"
      "<Parameter name=\"type\" type=\"string\" value=\"file\"/>"
      "<Parameter name=\"file\" type=\"string\" value=\"trial.csv\"/></ParameterList></ParameterList>"
      "<ParameterList name=\"integrator\"><Parameter name=\"type\" type=\"string\" value=\"backward euler\"/>"
      "</ParameterList><ParameterList name=\"time\"><Parameter name=\"start\" type=\"double\" value=\"0.6\"/>"
      "<Parameter name=\"end\" type=\"double\" value=\"0.7\"/>"
      "<Parameter name=\"step\" type=\"double\" value=\"0.01\"/></ParameterList></ParameterList>";

  std::string trial(const double begin, const std::string &length)
  {
    std::ostringstream text;
    text << "Time [s];length [m];excitation\n";
    for (unsigned int i = 0; i <= 4; ++i)
      text << begin + 0.05 * i << ";" << length << ";0.2\n";
    return text.str();
  }
} // namespace

TEST(MeasuredData, TrialsOutsideTheRunAreToldBeforeIt)
{
  const TestFolder folder;
  folder.write("unit.xml", unit_of_samples);
  folder.write("trial.csv", trial(0.6, "0.42"));
  EXPECT_EQ(run_program(folder, "run unit.xml --quiet").exit_code, 0);
  EXPECT_EQ(run_program(folder, "check unit.xml --set time/start=0.63").exit_code, 0);
  for (const char *command : {"check unit.xml", "run unit.xml --quiet --out never"})
    {
      const Outcome late = run_program(folder, std::string(command) + " --set time/end=2");
      EXPECT_EQ(late.exit_code, 2);
      EXPECT_NE(late.err.find("from 0.6 s to 0.8 s"), std::string::npos) << late.err;
      EXPECT_NE(late.err.find("from 0.6 s to 2 s"), std::string::npos) << late.err;
    }
  EXPECT_FALSE(std::filesystem::exists(folder / "never"));
  EXPECT_EQ(run_program(folder, "check unit.xml --set time/start=0").exit_code, 2);
}

TEST(MeasuredData, PathsOfOverridesAreThoseOfTheCaller)
{
  const TestFolder folder;
  std::filesystem::create_directories(folder / "scenes");
  folder.write("scenes/unit.xml", unit_of_samples);
  folder.write("scenes/trial.csv", trial(0.6, "0.42"));
  folder.write("mine.csv", trial(0.6, "0.43"));
  folder.write("trial.csv", "no table");
  EXPECT_EQ(run_program(folder, "check scenes/unit.xml").exit_code, 0); // beside the scene
  EXPECT_EQ(run_program(folder, "check scenes/unit.xml --set system/input/file=mine.csv").exit_code, 0);
  EXPECT_EQ(run_program(folder, "check scenes/unit.xml --set system/input/file=trial.csv").exit_code, 2);
  EXPECT_EQ(run_program(folder, "check scenes/unit.xml --set system/input/file=nowhere.csv").exit_code, 2);
}

TEST(MeasuredData, EmgOfThirtySecondsIsSteppedOverOrLandedOn)
{
  const TestFolder   folder;
  std::ostringstream emg;
  emg << "t,EMG [mV]\n";
  for (unsigned int i = 0; i <= 30000; ++i)
    emg << i * 1e-3 << "," << (i % 7) * (i % 3000 < 1500 ? 1 : -0.1) << "\n";
  folder.write("emg.csv", emg.str());
  const std::string list    = "--set system/excitation/";
  const std::string command = "check '" + myolines::test::source_folder() +
                              "/input/isometric_block.xml' --unset system/activation --set system/geometry/refinement=0 --set time/end=30 "
                              "--set time/step=0.025 " +
                              list + "type=file " + list + "file=emg.csv " + list + "rectify=true " + list + "normalise=maximum ";
  const Outcome smooth = run_program(folder, command + list + "low-pass=6");
  EXPECT_EQ(smooth.exit_code, 0) << smooth.err;
  EXPECT_NE(smooth.out.find("Steps: 1200 "), std::string::npos) << smooth.out;
  const Outcome lines = run_program(folder, command + list + "interpolation=lines");
  EXPECT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_NE(lines.out.find("Steps: 30000 "), std::string::npos) << lines.out;
}

TEST(MeasuredData, TheCommandsOfItsPageWork)
{
  const TestFolder folder;
  std::filesystem::create_directories(folder / "build/release");
  std::filesystem::create_symlink(myolines::test::program_file(), folder / "build/release/myolines");
  std::filesystem::create_symlink(myolines::test::source_folder() + "/input", folder / "input");
  const std::string page  = contents(myolines::test::source_folder() + "/doc/data.md");
  const auto        begin = page.find("```sh\n");
  ASSERT_NE(begin, std::string::npos);
  folder.write("page.sh", "set -e\n" + page.substr(begin + 6, page.find("\n```", begin) - begin - 5));
  EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && bash page.sh > page.txt 2>&1").c_str()), 0)
      << contents(folder / "page.txt");
}
