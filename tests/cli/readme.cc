// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: the command lines of the README work as they are printed.

#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
  /// The lines of all blocks of commands in README.md, without comments.
  std::vector<std::string> command_lines()
  {
    std::istringstream       readme(contents(myolines::test::source_folder() + "/README.md"));
    std::vector<std::string> lines;
    bool                     in_block = false;
    for (std::string line; std::getline(readme, line);)
      if (line.rfind("```", 0) == 0)
        in_block = line == "```sh";
      else if (in_block)
        lines.push_back(line.substr(0, line.find("  #")));
    return lines;
  }

  /// Builds, installs, or needs a screen.
  bool is_left_to_the_user(const std::string &line)
  {
    for (const char *word : {"myolines.sh", "cmake ", "ctest ", "paraview "})
      if (line.find(word) != std::string::npos)
        return true;
    return line.empty();
  }
} // namespace

TEST(Readme, ItsCommandLinesWork)
{
  const TestFolder folder;
  std::filesystem::create_directories(folder / "build/release");
  std::filesystem::create_symlink(myolines::test::program_file(), folder / "build/release/myolines");
  std::filesystem::create_symlink(myolines::test::source_folder() + "/input", folder / "input");
  // What its first line of all runs, by way of the script that builds; two steps with coarser elements.
  ASSERT_EQ(
      run_program(folder, "run input/bodies/bipennate.xml --quiet --set system/discretisation/degree=1 --set time/end=0.02").exit_code, 0);
  std::string script = "set -e\nexport GNUTERM=dumb\n";
  unsigned    n      = 0;
  for (const std::string &line : command_lines())
    if (!is_left_to_the_user(line))
      {
        script += line + "\n";
        ++n;
      }
  EXPECT_GE(n, 4u) << script;
  folder.write("readme.sh", script);
  EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && bash readme.sh > readme.txt 2>&1").c_str()), 0)
      << script << contents(folder / "readme.txt");
}
