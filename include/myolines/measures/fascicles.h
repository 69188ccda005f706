// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace myolines
{
  /// Lines along the fibres of the muscle at rest, from one end of the muscle tissue to the other: what an anatomist measures as fascicles.
  /// Each goes through the centre of a cell of muscle in the slab of the line of action (anywhere in the muscle where the body has no such
  /// line, or no muscle there), in both directions, with steps of an eighth of a cell by the midpoint rule; directions are those at the
  /// quadrature points, linear between them. They are material lines: as the body deforms their points move with it.
  class Fascicles
  {
  public:
    /// Where a line ends.
    enum class End
    {
      surface, ///< of the body
      tissue,  ///< at another tissue: aponeurosis or tendon
      none     ///< nowhere: the line is longer than ten bodies
    };

    /// One line at one state.
    struct Shape
    {
      double length;    ///< [m]
      double rate;      ///< of the length [m/s]
      double curvature; ///< mean over the length [1/m]
      double angle;     ///< between the chord and the line of action, 0 to 90 degrees; not a number without such a line
    };

    /// At most @p number lines, evenly among the cells. Collective; @p system must outlive the object.
    Fascicles(const Muscle3dSystem &system, unsigned int number);
    ~Fascicles();

    std::size_t                   size() const;              ///< those that end nowhere are left out
    const std::vector<double>    &rest_lengths() const;      ///< [m]
    double                        mean_rest_length() const;  ///< [m]; not a number without lines
    std::array<std::size_t, 3>    ends() const;              ///< how many ends are at surface, at tissue; and how many lines were left out
    std::vector<dealii::Point<3>> line(std::size_t i) const; ///< points at rest

    /// At one state. Collective.
    std::vector<Shape> shapes(const State &state) const;

  private:
    struct Lines;
    std::unique_ptr<const Lines> lines_;
    const Muscle3dSystem        &system_;
  };

  /// Lines of which `check` and ReferenceFibre are means.
  constexpr unsigned int enough_fascicles = 100;

  /// L_f0 of thesis (7.2.1): the length of the straight fibres of a block or the idealised gastrocnemius, the mean length of a hundred
  /// Fascicles of any other body.
  class ReferenceFibre
  {
  public:
    /// @p system outlives the object. Nothing is traced yet.
    explicit ReferenceFibre(const Muscle3dSystem &system)
      : system_(system)
    {}
    /// [m]; traced when it is asked for first; not a number where no fascicle ends. Collective.
    double length() const;

  private:
    const Muscle3dSystem         &system_;
    mutable std::optional<double> traced_;
  };
} // namespace myolines
