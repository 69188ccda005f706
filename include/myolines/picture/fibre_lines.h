// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/body.h>

#include <optional>
#include <utility>
#include <vector>

namespace myolines::picture
{
  /// Finds the cell of a point of the body at rest. The body must outlive it.
  class CellLocator
  {
  public:
    explicit CellLocator(const Body &body); ///< Sorts the cells into bins.

    /// A place in a cell.
    struct Found
    {
      std::size_t cell; ///< place in Body::cells
      Vec         xi;   ///< coordinates in the cell
    };
    /// Nothing outside of the body.
    std::optional<Found> find(const Vec &rest) const;

  private:
    std::size_t bin_of(const Vec &x) const;

    const Body                           &body_;
    Vec                                   low_, width_; ///< of the bins
    std::array<std::size_t, 3>            n_;
    std::vector<std::vector<std::size_t>> bins_; ///< cells that may be there
  };

  /// Whether a run wrote what lines along the fibres need: "fibre direction".
  bool has_fibres(const Body &body);

  /// At most @p number lines along the fibres of muscle and tissues of the scene's own, spread evenly, as points of the body at rest:
  /// material lines from one end to the other, by the midpoint rule with steps of a quarter of a cell. Where the run wrote the field
  /// "tissue", lines end at aponeurosis and tendon; else at the surface. Lines that go on for ten bodies are left out.
  std::vector<std::vector<Vec>> fibre_lines(const Body &body, unsigned int number);

  /// A point of such a line at an instant.
  struct LinePoint
  {
    Vec    now;   ///< [m]
    double value; ///< of the field
  };
  /// The lines in @p body, with a value of each point of the body. Points that are not in this body's mesh are left out.
  std::vector<std::vector<LinePoint>> follow(const std::vector<std::vector<Vec>> &lines, const Body &body,
                                             const std::vector<double> &values);
} // namespace myolines::picture
