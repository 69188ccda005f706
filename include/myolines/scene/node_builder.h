// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/document.h>
#include <myolines/scene/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// Makes a validated Node of a raw list and its schema; everything wrong is appended to the problems, and the node is
  /// of use only if there are none.
  class NodeBuilder
  {
  public:
    /// @p name stands for the file in messages, relative paths start from @p folder; @p notes are those of the root so far.
    NodeBuilder(std::string name, std::filesystem::path folder, std::vector<InputProblem> &problems, std::vector<std::string> notes = {});

    /// @p raw is nullptr for a list that was not written and takes its defaults.
    Node build(const RawList *raw, const Schema &schema, const std::string &list_name, const std::string &path);

  private:
    struct Names;

    void read_entry(const RawList &raw, const Entry &entry, Node &node);
    void read_section(const RawList &raw, const Schema::Section &section, Node &node);
    void read_named(const RawList &raw, const Schema &each, const Names &names, Node &node);
    void refuse_duplicates(const RawList &raw, const Node &node);
    void refuse_unknown(const RawList &raw, const Names &names, const Node &node);
    void drop_former(RawList &raw, const std::vector<const Schema *> &chain, const Names &names, const std::string &path);
    std::optional<std::string> checked(const RawParameter &raw, const Entry &entry, const std::string &where);
    std::optional<std::string> checked_file(const std::string &text, const Entry &entry, const std::string &where, bool from_override);
    std::string                where(const Node &node, const std::string &name, bool from_override) const;

    std::string                name_;
    std::filesystem::path      folder_;
    std::vector<InputProblem> &problems_;
    std::vector<std::string>   notes_;
  };
} // namespace myolines::scene
