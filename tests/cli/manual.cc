// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirements: the program tells its versions, prints its manual page and a completion that bash understands; all three name what it has.

#include "program_runner.h"

#include <myolines/integrators/sundials_tools.h>
#include <myolines/output/version.h>
#include <myolines/study/database.h>

#include <gtest/gtest.h>

#include <regex>

using namespace myolines;

namespace
{
  /// The first words of the indented lines behind "Subcommands:".
  std::vector<std::string> commands_of_the_help(const std::string &help)
  {
    std::vector<std::string> names;
    std::istringstream       lines(help.substr(help.find("Subcommands:\n") + 13));
    for (std::string line; std::getline(lines, line) && line.rfind("  ", 0) == 0;)
      if (line[2] != ' ')
        names.push_back(line.substr(2, line.find(' ', 2) - 2));
    return names;
  }

  /// What bash offers for @p line, whose last word is being typed.
  std::string completed(const TestFolder &folder, const std::string &line)
  {
    const std::string script = ". ./completion; COMP_WORDS=(" + line +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                               "_myolines myolines \"${COMP_WORDS[-1]}\" \"${COMP_WORDS[-2]}\"; echo \"${COMPREPLY[@]}\" > offered";
    folder.write("try.sh", script);
    EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && bash try.sh").c_str()), 0);
    return contents(folder / "offered");
  }
} // namespace

TEST(Versions, AreThoseOfProgramAndLibraries)
{
  const TestFolder folder;
  const Outcome    outcome = run_program(folder, "--version");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind(std::string("myolines ") + version + "\n", 0), 0u) << outcome.out;
  Versions all = library_versions();
  all.push_back({"SUNDIALS", sundials_version()});
  all.push_back({"SQLite", study::sqlite_version()});
  EXPECT_GE(all.size(), 8u);
  for (const auto &[name, number] : all)
    {
      EXPECT_TRUE(std::regex_search(number, std::regex("\\d+\\.\\d+"))) << name << ": " << number;
      EXPECT_TRUE(std::regex_search(outcome.out, std::regex("\n  " + name + " +" + number + "\n"))) << name << "\n" << outcome.out;
    }
  EXPECT_TRUE(std::regex_search(outcome.out, std::regex("\n  compiler +\\w+ \\d+\\."))) << outcome.out;
}

TEST(Manual, HasEveryCommandWithItsOptions)
{
  const TestFolder               folder;
  const std::string              page     = run_program(folder, "manual").out;
  const std::vector<std::string> commands = commands_of_the_help(run_program(folder, "--help").out);
  ASSERT_GE(commands.size(), 10u);
  for (const std::string &command : commands)
    EXPECT_NE(page.find("\n.SS " + command + "\n"), std::string::npos) << command;
  EXPECT_NE(page.find("\n.SS import flexodeal\n"), std::string::npos);
  EXPECT_NE(page.find("\n.TP\n\\fB\\-\\-unset\\fR \\fIPATH\\fR\nRemoves a parameter"), std::string::npos);
  EXPECT_NE(page.find("\n.SH ENVIRONMENT\n.TP\n\\fBMYOLINES_PLUGIN_PATH\\fR\n"), std::string::npos);
  EXPECT_NE(page.find("\n.SH EXIT STATUS\n"), std::string::npos);
  for (const std::string &line : std::vector<std::string>{"\n..", "\n'"}) // no line of text is taken for a request
    EXPECT_EQ(page.find(line), std::string::npos);
}

TEST(Completion, OffersCommandsOptionsAndFixedValues)
{
  const TestFolder folder;
  folder.write("completion", run_program(folder, "completion").out);
  EXPECT_EQ(completed(folder, "myolines ch"), "check\n");
  EXPECT_EQ(completed(folder, "myolines run s.xml --res"), "--resume\n");
  EXPECT_EQ(completed(folder, "myolines study s.xml --emit sl"), "slurm\n");
  EXPECT_EQ(completed(folder, "myolines list integ"), "integrators\n");
  EXPECT_EQ(completed(folder, "myolines import flexodeal --mar"), "--markers\n");
  EXPECT_EQ(completed(folder, "myolines import flexodeal --he"), "--help\n");
  EXPECT_EQ(completed(folder, "myolines list bound"), "boundary\\ conditions\n");
  EXPECT_EQ(completed(folder, "myolines list 'boundary\\ c'"), "boundary\\ conditions\n");
  EXPECT_EQ(completed(folder, "myolines list '\"boundary c'"), "boundary conditions\n");
  EXPECT_EQ(completed(folder, "myolines run sce"), "\n"); // a file: left to bash
}
