// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/discretisation.h>

#include <string>

namespace myolines
{
  /// Rigid motions of a body that no boundary condition and no spring at a face resists: without inertia nothing says where the body is.
  struct FreeMotions
  {
    unsigned int translations = 0; ///< linearly independent ones, 0..3
    unsigned int rotations    = 0; ///< likewise

    bool        any() const { return translations + rotations > 0; } ///< whether there is one at all
    std::string words() const;                                       ///< such as "1 translation and 2 rotations"
  };

  /// Collective. Conditions count as they hold at rest; a stop, a slack tendon and a foundation count as springs that act.
  FreeMotions free_motions(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation);
} // namespace myolines
