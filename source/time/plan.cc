#include <myolines/time/plan.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    /// Times should agree within this part of a step: after very many of them round-off is more than a billionth of one.
    double tolerance(const double t, const double size)
    {
      return std::max(1e-9, 4 * std::numeric_limits<double>::epsilon() * std::abs(t) / size);
    }
  }

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
    while (i + 1 < pieces_.size() && t >= pieces_[i].end - tolerance(t, pieces_[i].size) * pieces_[i].size)
      ++i;
    const Piece &piece = pieces_[i];
    const double slack = tolerance(t, piece.size);
    const double k     = std::floor((t - piece.begin) / piece.size + slack);
    const double begin = piece.begin + k * piece.size;
    double       end   = piece.begin + (k + 1) * piece.size;
    if (end > piece.end - slack * piece.size)
      end = piece.end;
    return {begin, end, piece.size};
  }
} // namespace myolines
