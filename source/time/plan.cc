// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/plan.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  Plan::Plan(const double start, const double end, const double size)
    : pieces_({{start, end, size}})
  {}

  Plan::Plan(const double start, const double end, const std::vector<unsigned int> &counts, const std::vector<double> &sizes)
  {
    double begin = start;
    for (std::size_t i = 0; i < counts.size(); ++i)
      {
        const double piece_end = i + 1 == counts.size() ? end : begin + counts[i] * sizes[i];
        pieces_.push_back({begin, piece_end, sizes[i]});
        begin = piece_end;
      }
  }

  Plan::Step Plan::at(const double t) const
  {
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && t >= pieces_[i].end - time_tolerance(t, pieces_[i].size))
      ++i;
    const Piece &piece = pieces_[i];
    const double slack = time_tolerance(t, piece.size);
    const double k     = std::floor((t - piece.begin + slack) / piece.size);
    const double begin = piece.begin + k * piece.size;
    double       end   = piece.begin + (k + 1) * piece.size;
    if (end > piece.end - slack)
      end = piece.end;
    return {begin, end, piece.size};
  }
} // namespace myolines
