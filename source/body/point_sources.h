// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/body_fields.h>

#include <functional>

namespace myolines
{
  /// Where properties of points come from.
  class PointProperties::Source
  {
  public:
    virtual ~Source() = default;

    /// What there is for @p x, and how far from there [m].
    virtual std::pair<Row, double> nearest(const dealii::Point<3> &x) const = 0;

    std::filesystem::path     file;
    bool                      has_fat = false, has_matrix = false, has_directions = false;
    std::vector<unsigned int> tissues;    ///< that it names
    double                    extent = 0; ///< diagonal of the box around its points [m]
  };

  /// A number that a row may have.
  struct PointQuantity
  {
    std::string                                         name;
    scene::Range                                        range;
    std::function<void(PointProperties::Row &, double)> set;
  };
  const std::vector<PointQuantity> &point_quantities();

  /// Whether @p file begins like one of VTK, XML or legacy; others are tables.
  bool is_vtk(const std::filesystem::path &file);

  inline const std::string fibre_orientation = "muscle_fibre_orientation";

  std::unique_ptr<const PointProperties::Source> table_source(const std::filesystem::path &file, double scale);
  std::unique_ptr<const PointProperties::Source> mesh_source(const std::filesystem::path &file, double scale);
} // namespace myolines
