// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace myolines
{
  /// One thing wrong with what the user gave: what, where, what was expected, how to mend it.
  struct InputProblem
  {
    std::string where;    ///< file, and path of the parameter inside it ("scene.xml: time/step")
    std::string what;     ///< what is wrong, with the offending value
    std::string expected; ///< what would have been right (type, range, unit); may be empty
    std::string hint;     ///< how to mend it, such as the nearest valid name; may be empty
  };

  /// Invalid input: the program ends with exit code 2 and prints every problem.
  class InputError : public std::runtime_error
  {
  public:
    explicit InputError(std::vector<InputProblem> problems); ///< all problems at once
    explicit InputError(InputProblem problem);               ///< a single problem

    const std::vector<InputProblem> &problems() const { return problems_; } ///< in the order in which they were found

  private:
    std::vector<InputProblem> problems_;
  };

  /// A solve that cannot go on: the program ends with exit code 3, after closing all outputs.
  class SolveError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error; ///< @p what: the reason, as a sentence for the user
  };

  /// A run that was asked to stop before its end: the program ends as after a failed solve, the state being saved.
  class Interrupted : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error; ///< @p what: the reason, as a sentence for the user
  };

  /// The system refused what the program needs (disk full, input or output error, permission, memory): the program ends with exit code 4.
  class SystemError : public std::runtime_error
  {
  public:
    /// "cannot @p verb @p file: No space left on device", of the @p error_number that the system gave (errno).
    SystemError(const std::string &verb, const std::filesystem::path &file, int error_number);
    explicit SystemError(const std::string &what, int error_number = 0); ///< @p error_number: errno of the failed call, 0: none

    /// errno, 0 where there is none.
    int error_number() const { return error_number_; }

  private:
    int error_number_;
  };

  /// Exit codes of the program.
  enum class ExitCode
  {
    done           = 0, ///< the command has done what it was asked for
    internal_error = 1, ///< a fault of the program
    invalid_input  = 2, ///< an InputError
    solve_failed   = 3, ///< a SolveError; also a run that was stopped by a signal
    system_refused = 4  ///< a SystemError
  };
} // namespace myolines
