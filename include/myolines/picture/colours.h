// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>

namespace myolines::picture
{
  /// Red, green and blue in [0, 1].
  using Colour = std::array<double, 3>;

  /// "#0072b2".
  std::string hexadecimal(const Colour &colour);

  /// Colours of numbers in [0, 1].
  enum class ColourMap
  {
    viridis,   ///< from dark to light, even to the eye, the same to all eyes (S. van der Walt, N. Smith, 2015; CC0)
    diverging, ///< blue, white, red: for numbers of both signs, 0 in the middle
    tissues    ///< one of most_tissues equal parts for each: muscle, aponeurosis, tendon, then the scene's own
  };
  constexpr int most_tissues = 15;                  ///< that a body can have
  Colour        colour_of(ColourMap map, double x); ///< The colour of @p x; numbers outside [0, 1] have that of the nearer end.
} // namespace myolines::picture
