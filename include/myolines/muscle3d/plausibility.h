// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/parameters.h>

namespace myolines
{
  /// What no muscle has, with what was probably meant; empty if the size is one of muscles: no longer than 1 m and no thinner than 0.1 mm.
  std::string implausible_size(const Geometry &geometry);

  /// The factor that probably makes metres of the lengths of a body whose size is implausible; 0 if none is known, 1 if none is needed.
  double probable_scale(const Geometry &geometry);

  /// One sentence for every value that no muscle has: size, maximum isometric stress outside 1e3 to 1e7 Pa, density outside 500 to
  /// 2000 kg/m^3, bulk modulus outside 1e4 to 1e10 Pa, or outside 2 to 1e6 times the shear modulus at rest; and for cells that are nearly
  /// degenerate. Values are those of the lists, not of fields.
  std::vector<std::string> implausible_values(const Muscle3dParameters &parameters);
} // namespace myolines
