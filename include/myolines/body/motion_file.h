// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <filesystem>
#include <memory>
#include <utility>

namespace myolines
{
  /// Displacements and velocities of places of the body at rest, read from a file.
  /// - A mesh in a format of VTK has them as arrays of its points, `displacement` and `velocity` in any case, with three components. What
  /// lies
  ///   in a cell gets what its corners have, linearly; a `.vtu` of hexahedra of Lagrange's kind is divided between all of its points.
  /// - A CSV file has columns x, y, z and `displacement x`, `displacement y`, ..., `velocity z`, or three of these. It says something of
  /// the
  ///   places in its rows alone.
  class MotionFile
  {
  public:
    /// @p scale: metres per unit of length in the file, of places, displacements and velocities; columns of a table may have units instead.
    /// @throws InputError for a file that cannot be read, holds neither quantity, or numbers that are not finite.
    explicit MotionFile(const std::filesystem::path &file, double scale = 1);
    ~MotionFile();

    bool has_displacement() const; ///< Whether the file tells displacements.
    bool has_velocity() const;     ///< Whether the file tells velocities.

    /// What the file tells of a place at rest.
    struct Row
    {
      std::array<double, 3> displacement{}; ///< [m]
      std::array<double, 3> velocity{};     ///< [m/s]
    };

    /// Of the cell or row nearest to the place @p x [m] at rest, with its distance [m].
    std::pair<Row, double> nearest(const dealii::Point<3> &x) const;

    /// For the node that is furthest from what the file knows, on all ranks alike. @throws InputError if that is more than 1e-5 of the
    /// extent of the file.
    void check_distance(const dealii::Point<3> &x, double distance) const;

    class Source;

  private:
    std::filesystem::path         file_;
    std::unique_ptr<const Source> source_;
  };
} // namespace myolines
