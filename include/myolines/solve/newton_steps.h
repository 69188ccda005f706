// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

namespace myolines
{
  /// Judges a Newton iteration by the importance of its steps (NonlinearProblem::importance). With theta the ratio of the last
  /// two, what remains after the last step s is at most theta/(1 - theta) s (Hairer and Wanner, doi:10.1007/978-3-642-05221-7,
  /// IV.8). After a single step that does not matter itself what remains, a smaller one, does not either.
  class NewtonSteps
  {
  public:
    /// The next step. @p importance: none if the problem does not tell, or if the step was shortened.
    void taken(const std::optional<double> importance)
    {
      previous_ = last_;
      last_     = importance;
    }

    /// Whether what remains does not matter.
    bool enough() const
    {
      if (!last_)
        return false;
      if (!previous_)
        return *last_ <= 1;
      const double ratio = *previous_ > 0 ? *last_ / *previous_ : 0;
      return ratio < 1 && ratio / (1 - ratio) * *last_ <= 1;
    }

  private:
    std::optional<double> previous_, last_;
  };
} // namespace myolines
