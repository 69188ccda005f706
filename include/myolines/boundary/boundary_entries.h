// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/entries.h>
#include <myolines/boundary/boundary.h>

#include <memory>
#include <string>

namespace myolines
{
  // Parameters that several boundary conditions share, each declared beside its reading.

  /// `components`, any of x y z.
  void                add_components(scene::Schema &schema);
  std::array<bool, 3> read_components(const scene::Node &node); ///< Reads it: whether x, y and z are named. @throws InputError

  /// `direction`, a unit vector, @p doc says of what. Default: x; of a mesh the line of action, towards the face from the other end.
  /// @throws InputError
  void    add_direction(scene::Schema &schema, const std::string &doc);
  Vector3 read_direction_of(const scene::Node &node, const BoundaryReading &reading); ///< Reads that list.

  /// `x from`, `x to`, ...: the part of the face that a load acts on. @throws InputError
  void add_box(scene::Schema &schema);
  Box  read_box(const scene::Node &node); ///< Reads that list.

  /// A number times a given function of time, the list `profile`, or the number alone.
  class ProfiledLoad
  {
  public:
    /// Declares the number @p name and the list `profile`.
    static void add(scene::Schema &schema, const std::string &name, const std::string &unit, const std::string &doc);
    ProfiledLoad(const scene::Node &node, const std::string &name); ///< Reads them. @throws InputError

    double size() const { return size_; } ///< the number
    /// its value at @p t
    double                     at(double t, Side side) const { return profile_ ? size_ * profile_->value(t, side) : size_; }
    std::vector<const Drive *> drives() const; ///< the profile, if there is one

  private:
    double                       size_;
    std::shared_ptr<const Drive> profile_;
  };
} // namespace myolines
