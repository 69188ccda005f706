#include <myolines/base/error.h>

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
} // namespace myolines
