// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>
#include <myolines/scene/schema.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace myolines::scene
{
  /// A validated list of parameters. Asking for a name or a kind that the schema does not declare is a programming
  /// error (std::logic_error); everything a user can get wrong was refused when the node was made.
  class Node
  {
  public:
    double                number(const std::string &name) const;  ///< of Kind::number
    int                   integer(const std::string &name) const; ///< of Kind::integer
    bool                  boolean(const std::string &name) const; ///< of Kind::boolean
    std::string           text(const std::string &name) const;    ///< also for choices
    std::filesystem::path file(const std::string &name) const;    ///< resolved against the folder of the scene

    /// The finite numbers, separated by blanks, that a text holds. @throws InputError, as refuse(), where it holds none or something else.
    std::vector<double> numbers(const std::string &name, const std::string &expected) const;

    /// All files that this list and those in it name.
    std::vector<std::filesystem::path> files() const;

    /// True if a value or default of @p name is there, or the (optional) list @p name was written.
    bool has(const std::string &name) const;
    /// True if the scene itself wrote @p name.
    bool written(const std::string &name) const;

    const Node &section(const std::string &name) const; ///< The list @p name in this one; an optional one must be there, see has().

    /// Lists with names of the user's choice (Schema::named_sections), in the order written.
    const std::vector<Node> &named() const;

    /// Of the root: what overrides have left out of the file, a sentence each.
    const std::vector<std::string> &notes() const { return notes_; }

    const std::string &name() const { return name_; } ///< Of this list, without the lists around it.
    /// "system/boundary/moving end"; "" for the root.
    const std::string &path() const { return path_; }
    /// The scene file and the path of @p name inside it, for InputProblem::where.
    std::string where(const std::string &name) const;

    /// Throws InputError about parameter @p name of this list, for conditions that no range can express.
    [[noreturn]] void refuse(const std::string &name, const std::string &what, const std::string &expected = "",
                             const std::string &hint = "") const;

  private:
    friend class NodeBuilder;
    friend class SceneWriter;

    struct Value
    {
      std::string text;
      Kind        kind    = Kind::text;
      bool        written = false;
    };
    const Value &value(const std::string &name, Kind kind) const;

    std::string                                name_;
    std::string                                path_;
    bool                                       written_ = false;
    std::filesystem::path                      scene_file_;
    std::vector<std::pair<std::string, Value>> values_; ///< in order of declaration, defaults included
    std::vector<Node>                          sections_;
    std::vector<Node>                          named_;
    std::vector<std::string>                   declared_; ///< every name the schema knows here, for has()
    std::vector<std::string>                   notes_;
  };

  /// What goes along with an override: @p path gets @p text, unless an override says otherwise; Node::notes() tells, with @p why.
  struct Preset
  {
    std::string path; ///< of the parameter
    std::string text; ///< its value
    std::string why;  ///< the reason, as half a sentence
  };

  /// Reads a scene, applies the overrides ("time/step=1e-3"), validates everything against @p schema.
  /// All problems are collected into one InputError: unreadable or malformed XML, unknown (with the nearest valid name),
  /// duplicate, misspelt, mistyped or out-of-range entries, missing required ones, missing files.
  /// An override may create lists that the scene does not write, but no named ones (boundary conditions). One that chooses another
  /// alternative, such as "integrator/type=bdf2", takes away what the file has for the former one (Node::notes()); "~time/step" takes away
  /// what the file has there.
  /// @p root is the name of the outermost list, which tells what kind of document it is.
  Node read_scene(const std::filesystem::path &file, const Schema &schema, const std::vector<std::string> &overrides = {},
                  const std::string &root = "scene", const std::vector<Preset> &presets = {});

  /// The same from XML text; @p name stands for the file in messages, @p folder resolves relative paths.
  Node parse_scene(const std::string &xml, const Schema &schema, const std::string &name = "scene",
                   const std::filesystem::path &folder = ".", const std::vector<std::string> &overrides = {},
                   const std::string &root = "scene");

  /// The list that @p schema declares, all defaults but @p entries ("restart=30"), which nobody writes in a scene; @p name as above.
  Node list_of_defaults(const Schema &schema, const std::string &name, const std::vector<std::string> &entries = {});

  /// The texts of the parameters at @p paths ("system/type") with @p overrides applied, before any validation; nothing where one
  /// is not written. For what decides which schema applies. @throws InputError if the file is unreadable or malformed.
  std::vector<std::optional<std::string>> peek_texts(const std::filesystem::path &file, const std::vector<std::string> &paths,
                                                     const std::vector<std::string> &overrides = {});

  /// Of one of them.
  std::optional<std::string> peek_text(const std::filesystem::path &file, const std::string &path,
                                       const std::vector<std::string> &overrides = {});

  /// A parameter path and its text: {"system/boundary/moving end/face", "x+"}.
  using Setting = std::pair<std::string, std::string>;

  /// The scene that sets @p settings and leaves the rest to the defaults, validated like one that was read.
  Node compose_scene(const Schema &schema, const std::vector<Setting> &settings, const std::string &name = "scene",
                     const std::filesystem::path &folder = ".");

  /// XML with every value in force, its outermost list named @p name; reading it back gives an equal node. File paths are
  /// written absolute.
  std::string resolved_xml(const Node &root, const std::string &name = "scene");

  /// XML with only the values that the scene itself wrote.
  std::string written_xml(const Node &root);

  /// The scene compose_scene() makes of @p settings with every default, each parameter preceded by a comment with kind,
  /// unit, range and sentence; what is optional and absent stands there as a comment.
  std::string template_xml(const Schema &schema, const std::vector<Setting> &settings = {});

  /// The declarations of @p schema as indented plain text for `myolines list`.
  std::string describe(const Schema &schema, int indent = 2);
} // namespace myolines::scene
