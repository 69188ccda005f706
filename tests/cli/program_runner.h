// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/loaded_program.h"
#include "../support/places.h"
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>

/// A folder of its own for a test; it vanishes with the object.
class TestFolder
{
public:
  TestFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "myolines_cli_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a folder for the test");
    path_ = name;
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder &)            = delete;
  TestFolder &operator=(const TestFolder &) = delete;

  std::filesystem::path        operator/(const std::string &name) const { return path_ / name; }
  const std::filesystem::path &path() const { return path_; }

  std::filesystem::path write(const std::string &name, const std::string &text) const
  {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

private:
  std::filesystem::path path_;
};

inline std::string contents(const std::filesystem::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct Outcome
{
  int         exit_code;
  std::string out, err;
};

/// Runs the program, built as the target `myolines`, with @p arguments in @p folder; @p before stands before it in the shell. A command
/// that is words alone runs in a copy of the program that is loaded once.
inline Outcome run_program(const TestFolder &folder, const std::string &arguments, const std::string &before = "")
{
  const std::vector<std::string> words = before.empty() ? myolines::test::shell_words(arguments) : std::vector<std::string>();
  int                            status;
  if (!words.empty())
    {
      static const myolines::test::LoadedProgram program;
      status = program.run(folder.path(), words);
    }
  else
    {
      const std::string program = myolines::test::program_file();
      if (!std::filesystem::exists(program))
        throw std::runtime_error("build the target myolines first: " + program + " is not there");
      status = std::system(
          ("cd '" + folder.path().string() + "' && " + before + " '" + program + "' " + arguments + " > out.txt 2> err.txt < /dev/null")
              .c_str());
    }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out.txt"), contents(folder / "err.txt")};
}

/// How often @p what is in @p text.
inline std::size_t occurrences(const std::string &text, const std::string &what)
{
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}
