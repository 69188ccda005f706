// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cursor.h"

#include <map>
#include <string>
#include <vector>

namespace myolines
{
  /// An XML tag: "<Piece NumberOfPoints="8">" or "</Piece>".
  struct XmlTag
  {
    std::string                        name; ///< "/Piece" for the end of one
    std::map<std::string, std::string> attributes;
    bool                               closed = false; ///< "<Piece/>"

    /// "" if there is none.
    std::string attribute(const std::string &name) const;
  };

  /// Goes behind the next tag; comments and declarations are passed over. False if there is none.
  bool next_tag(Cursor &cursor, XmlTag &tag);

  /// How a file in XML has its numbers.
  struct VtuEncoding
  {
    bool             swapped = false, compressed = false, long_heads = false;
    bool             base64 = false; ///< of the appended data
    std::string_view appended;       ///< all of it
  };

  /// Numbers of an array whose tag the cursor is behind. @throws InputError
  std::vector<double> read_vtu_array(const XmlTag &array, Cursor &cursor, const VtuEncoding &encoding);
} // namespace myolines
