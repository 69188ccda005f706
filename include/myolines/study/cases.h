// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/study.h>

#include <map>
#include <string>
#include <vector>

namespace myolines::study
{
  /// One run of a study.
  struct Case
  {
    /// What the run is for.
    enum class Role
    {
      reference,   ///< that others are measured against
      cross_check, ///< that tells how good a reference is
      point,       ///< of a grid
      repeat       ///< a point once more, for its seconds
    };

    std::string                      name;               ///< stable: made of the axes and labels alone; a file name
    Role                             role = Role::point; ///< what it is for
    std::map<std::string, AxisPoint> coordinates;        ///< axis -> point
    std::vector<std::string>         settings;           ///< "path=value", in the order in which they are applied
    std::string                      reference;          ///< name of the case that this one is measured against; "" for none
    std::string                      repeated;           ///< name of the point that a repeat is of
  };

  /// "reference", "cross check", "case", "repeat".
  std::string role_name(Case::Role role);

  /// All cases: the references that the points need, their cross checks, then the points in the order of the grids, the last
  /// axis running fastest; then all points again for each repeat, so that a machine that is busy for a while spoils no median. @throws
  /// InputError if two points have the same name.
  std::vector<Case> expand(const Study &study);

  /// "method=hht_0.1,step=0.01" of {{"method", "hht 0.1"}, {"step", "0.01"}}: letters, digits and . _ + - only, at most 120
  /// characters (a longer one ends with a checksum of the whole).
  std::string case_name(const std::string &prefix, const std::vector<std::pair<std::string, std::string>> &labels);
} // namespace myolines::study
