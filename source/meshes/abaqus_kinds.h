// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "formats.h"

#include <optional>

namespace myolines
{
  /// A type of elements of Abaqus.
  struct AbaqusKind
  {
    std::size_t                     n_nodes; ///< the corners first
    std::optional<PlainMesh::Shape> shape;   ///< none, nor a number of nodes: lines, springs, masses, which are passed over
  };

  /// @throws InputError where @p type, in capital letters, is none that is known.
  AbaqusKind abaqus_kind(const std::string &type, const Cursor &cursor);

  /// In capital letters.
  std::string upper(std::string text);
} // namespace myolines
