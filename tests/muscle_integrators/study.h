// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace myolines::testing
{
  /// What the study of tests/data/integrators_3d.csv found for one scheme with n steps.
  struct StudyEntry
  {
    unsigned int          n;
    double                error;          ///< eU
    std::optional<double> velocity_error; ///< eV
    double                variation;      ///< TV
  };

  /// Its entries for @p scheme at @p refinement, n ascending.
  std::vector<StudyEntry> study(unsigned int refinement, const std::string &scheme);

  /// Steps of the SDIRK3 run that its errors refer to: 512 reproduces the table at refinement 1, 256 is what it says of refinement 2.
  unsigned int steps_of_reference(unsigned int refinement);

  /// @p x and @p printed, a number of two digits, differ by no more than one in the last one.
  bool same_digits(double x, double printed);
} // namespace myolines::testing
