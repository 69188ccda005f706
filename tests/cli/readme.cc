// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: the command lines of the README and of the tutorials work as they are printed.

#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
  /// The lines of all blocks of commands of a page, without comments.
  std::vector<std::string> command_lines(const std::string &page)
  {
    std::istringstream       text(contents(myolines::test::source_folder() + "/" + page));
    std::vector<std::string> lines;
    bool                     in_block = false;
    for (std::string line; std::getline(text, line);)
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

namespace
{
  /// With the program and the scenes where the page has them.
  void prepare(const TestFolder &folder)
  {
    std::filesystem::create_directories(folder / "build/release");
    std::filesystem::create_symlink(myolines::test::program_file(), folder / "build/release/myolines");
    std::filesystem::create_symlink(myolines::test::source_folder() + "/input", folder / "input");
  }

  /// The number of lines that were run.
  unsigned int run_lines_of(const std::string &page, const TestFolder &folder)
  {
    std::string  script = "set -e -o pipefail\nexport GNUTERM=dumb\n";
    unsigned int n      = 0;
    for (const std::string &line : command_lines(page))
      if (!is_left_to_the_user(line))
        {
          script += line + "\n";
          ++n;
        }
    folder.write("page.sh", script);
    EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && bash page.sh > page.txt 2>&1").c_str()), 0)
        << script << contents(folder / "page.txt");
    return n;
  }
} // namespace

TEST(Readme, ItsCommandLinesWork)
{
  const TestFolder folder;
  prepare(folder);
  // What its first line of all runs, by way of the script that builds; two steps with coarser elements.
  ASSERT_EQ(
      run_program(folder, "run input/bodies/bipennate.xml --quiet --set system/discretisation/degree=1 --set time/end=0.02").exit_code, 0);
  EXPECT_GE(run_lines_of("README.md", folder), 4u);
}

TEST(Tutorials, TheirCommandLinesWork)
{
  for (const std::string page : {"first_muscle", "own_muscle", "is_it_right", "compare_methods", "conserving_methods", "extend"})
    {
      SCOPED_TRACE(page);
      const TestFolder folder;
      prepare(folder);
      EXPECT_GE(run_lines_of("doc/manual/" + page + ".md", folder), 1u);
    }
}
