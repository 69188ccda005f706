// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/body.h>

namespace myolines::picture
{
  /// Where a body is seen from, from afar: unit vectors to the right and upwards on the picture, and towards the viewer.
  struct View
  {
    Vec right;   ///< to the right on the picture
    Vec up;      ///< upwards on it
    Vec towards; ///< out of it

    /// To the right, upwards and towards the viewer [m].
    Vec seen(const Vec &x) const { return Vec({x * right, x * up, x * towards}); }
  };

  /// The longest axis of @p body at rest lies across the picture, with z upwards; a body that stands along z stands. Then the viewer goes
  /// @p azimuth to the right around it and @p elevation up [degree].
  View view_of(const Body &body, double azimuth, double elevation);
} // namespace myolines::picture
