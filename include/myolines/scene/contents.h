// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// One name of a list of a scene: a parameter or a list in it, with what its schema says.
  struct Item
  {
    std::string                name;            ///< as in a scene
    bool                       is_list = false; ///< else it is a parameter
    bool                       named   = false; ///< a list with a name of the user's choice
    bool                       present = false; ///< it has a value, or the list is there
    bool                       written = false; ///< by the scene itself
    std::optional<std::string> text;            ///< value in force; of parameters
    Entry                      entry;           ///< of parameters
    std::string                doc;             ///< of lists
  };

  /// A list of a scene.
  struct Contents
  {
    std::string       doc;        ///< one sentence on the list
    std::vector<Item> items;      ///< in the order of the schema, what may be there and is not included
    bool              takes_more; ///< lists with names of the user's choice
  };

  /// The list at @p path ("system/boundary/moving end"; "" for the whole scene) of @p root, a scene that @p schema has validated. Lists
  /// that are not written show what they would hold. @throws InputError with the nearest name for a path that leads to no list.
  Contents contents_of(const Node &root, const Schema &schema, const std::string &path);
} // namespace myolines::scene
