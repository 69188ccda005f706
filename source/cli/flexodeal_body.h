// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "flexodeal_translation.h"

#include <myolines/body/geometry.h>

#include <string>
#include <vector>

namespace myolines
{
  /// The body of Flexodeal's parameters, or of a mesh: a block, the idealised gastrocnemius or what the mesh has.
  struct FlexodealBody
  {
    Geometry                 geometry; ///< of the size only what plausibility needs
    int                      refinement = 0;
    std::vector<std::string> tissues;                  ///< of the body and of the table of points
    bool                     table_directions = false; ///< whether the table of points has fibres
    bool                     table_fat        = false; ///< and fat

    bool        has(const std::string &tissue) const;
    std::string face(int boundary_id) const; ///< its name; "" if there is none
    std::string faces() const;               ///< their names
  };

  /// Adds the geometry and the table of points to the scene.
  FlexodealBody add_body(FlexodealTranslation &translation);

  /// Adds the directions of the fibres.
  void add_fibres(FlexodealTranslation &translation, const FlexodealBody &body);
} // namespace myolines
