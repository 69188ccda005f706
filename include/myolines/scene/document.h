// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>

#include <filesystem>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// What stands in a scene file, in its order, before anything is known about its meaning.
  struct RawParameter
  {
    std::string name;                  ///< attribute "name"
    std::string type;                  ///< attribute "type"; "" for overrides, which have none
    std::string text;                  ///< attribute "value", entities replaced
    bool        from_override = false; ///< set on the command line, not in the file
    std::string replaced;              ///< of an override: the text that the file has, "" if none
  };

  /// A list of parameters and lists, as written.
  struct RawList
  {
    std::string               name;                  ///< attribute "name"
    std::vector<RawParameter> parameters;            ///< in the order of the file
    std::vector<RawList>      lists;                 ///< in the order of the file
    bool                      from_override = false; ///< not in the file; an override made it
  };

  /// The tree of @p xml, whose outermost list must be named @p root; what is not a parameter list goes to @p problems, with
  /// @p file in front. Works on the document itself, not on Teuchos::ParameterList, because that hides duplicates.
  RawList parse_document(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems,
                         const std::string &root = "scene");

  /// Sets the parameter at @p path ("time/step"), making the lists on the way where there are none.
  void set_parameter(RawList &root, const std::string &path, const std::string &text, bool from_override);

  /// Makes the list at @p path, and those on the way, as a file does that writes them; nothing where they are there.
  void add_list(RawList &root, const std::string &path);

  /// Removes the parameter or list at @p path; false: there is none.
  bool remove_entry(RawList &root, const std::string &path);

  /// Applies overrides, in their order: "path=value" as set_parameter() does, "~path" as remove_entry().
  void apply_overrides(RawList &root, const std::vector<std::string> &overrides, std::vector<InputProblem> &problems);

  /// The parameter at @p path, or nullptr.
  const RawParameter *find_parameter(const RawList &root, const std::string &path);
  const RawList      *find_list_at(const RawList &root, const std::string &path); ///< The list at @p path, or nullptr.

  /// The names of the lists at @p path ("system/boundary") in a scene file, in their order, before any validation; none where it is not
  /// written. @throws InputError if the file is unreadable or malformed.
  std::vector<std::string> lists_at(const std::filesystem::path &file, const std::string &path);
} // namespace myolines::scene
