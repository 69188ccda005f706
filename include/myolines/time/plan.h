// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/instants.h>

#include <vector>

namespace myolines
{
  /// Planned steps from start to end: pieces of equal steps. Ends of steps are multiples, never accumulated sums, and the
  /// last one is the end bit for bit.
  class Plan
  {
  public:
    /// One step of the plan.
    struct Step
    {
      double begin; ///< [s]
      double end;   ///< [s]
      double size;  ///< nominal, [s]; the last step of a plan may be shorter
    };

    /// Equal steps of @p size [s]; the last one is shorter if they do not fit.
    Plan(double start, double end, double size);

    /// @p counts[i] steps of @p sizes[i] [s]; the last piece ends at @p end, which their sum must meet up to round-off.
    Plan(double start, double end, const std::vector<unsigned int> &counts, const std::vector<double> &sizes);

    /// The planned step that contains @p t or begins there. Times within time_tolerance of its end belong to the next.
    Step at(double t) const;

  private:
    struct Piece
    {
      double begin;
      double end;
      double size;
    };
    std::vector<Piece> pieces_;
  };
} // namespace myolines
