// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>

#include <cstring>

namespace myolines
{
  namespace
  {
    std::string describe(const std::vector<InputProblem> &problems)
    {
      std::string text;
      for (const InputProblem &problem : problems)
        {
          if (!text.empty())
            text += '\n';
          text += problem.where + ": " + problem.what;
          if (!problem.expected.empty())
            text += "\n  expected: " + problem.expected;
          if (!problem.hint.empty())
            text += "\n  hint: " + problem.hint;
        }
      return text;
    }
  } // namespace

  InputError::InputError(std::vector<InputProblem> problems)
    : std::runtime_error(describe(problems))
    , problems_(std::move(problems))
  {}

  InputError::InputError(InputProblem problem)
    : InputError(std::vector<InputProblem>{std::move(problem)})
  {}

  SystemError::SystemError(const std::string &verb, const std::filesystem::path &file, const int error_number)
    : SystemError("cannot " + verb + " " + file.string() + ": " + std::strerror(error_number), error_number)
  {}

  SystemError::SystemError(const std::string &what, const int error_number)
    : std::runtime_error(what)
    , error_number_(error_number)
  {}
} // namespace myolines
