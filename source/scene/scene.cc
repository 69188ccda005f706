// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/document.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/node_builder.h>
#include <myolines/scene/scene.h>

namespace myolines::scene
{
  namespace
  {
    void throw_if_any(const std::vector<InputProblem> &problems)
    {
      if (!problems.empty())
        throw InputError(problems);
    }

    /// A wrong document is refused before its contents are looked at: what follows would only repeat it.
    RawList raw_scene(const std::string &xml, const std::string &name, const std::vector<std::string> &overrides,
                      const std::string &root_name = "scene")
    {
      std::vector<InputProblem> problems;
      RawList                   root = parse_document(xml, name, problems, root_name);
      apply_overrides(root, overrides, problems);
      throw_if_any(problems);
      return root;
    }

    /// What the presets have changed, a sentence each.
    std::vector<std::string> apply_presets(RawList &root, const std::vector<Preset> &presets)
    {
      std::vector<std::string> notes;
      for (const Preset &preset : presets)
        {
          const RawParameter *present = find_parameter(root, preset.path);
          if (present != nullptr && (present->from_override || present->text == preset.text))
            continue;
          set_parameter(root, preset.path, preset.text, true);
          notes.push_back(preset.path + " is \"" + preset.text + "\": " + preset.why);
        }
      return notes;
    }

    Node build_root(const RawList &root, const Schema &schema, const std::string &name, const std::filesystem::path &folder,
                    const std::vector<std::string> &notes = {})
    {
      std::vector<InputProblem> problems;
      Node                      node = NodeBuilder(name, folder, problems, notes).build(&root, schema, "", "");
      throw_if_any(problems);
      return node;
    }
  } // namespace

  Node read_scene(const std::filesystem::path &file, const Schema &schema, const std::vector<std::string> &overrides,
                  const std::string &root, const std::vector<Preset> &presets)
  {
    RawList                        raw   = raw_scene(read_input_text(file), file.string(), overrides, root);
    const std::vector<std::string> notes = apply_presets(raw, presets);
    return build_root(raw, schema, file.string(), file.parent_path(), notes);
  }

  Node parse_scene(const std::string &xml, const Schema &schema, const std::string &name, const std::filesystem::path &folder,
                   const std::vector<std::string> &overrides, const std::string &root)
  {
    return build_root(raw_scene(xml, name, overrides, root), schema, name, folder);
  }

  Node list_of_defaults(const Schema &schema, const std::string &name, const std::vector<std::string> &entries)
  {
    return parse_scene("<ParameterList name=\"scene\"></ParameterList>", schema, name, ".", entries);
  }

  std::vector<std::optional<std::string>> peek_texts(const std::filesystem::path &file, const std::vector<std::string> &paths,
                                                     const std::vector<std::string> &overrides)
  {
    const RawList                           root = raw_scene(read_input_text(file), file.string(), overrides);
    std::vector<std::optional<std::string>> texts;
    for (const std::string &path : paths)
      {
        const RawParameter *found = find_parameter(root, path);
        texts.push_back(found != nullptr ? std::optional<std::string>(found->text) : std::nullopt);
      }
    return texts;
  }

  std::optional<std::string> peek_text(const std::filesystem::path &file, const std::string &path,
                                       const std::vector<std::string> &overrides)
  {
    return peek_texts(file, {path}, overrides).front();
  }

  std::vector<std::string> lists_at(const std::filesystem::path &file, const std::string &path)
  {
    const RawList            root = raw_scene(read_input_text(file), file.string(), {});
    std::vector<std::string> names;
    if (const RawList *list = find_list_at(root, path))
      for (const RawList &inside : list->lists)
        names.push_back(inside.name);
    return names;
  }

  Node compose_scene(const Schema &schema, const std::vector<Setting> &settings, const std::string &name,
                     const std::filesystem::path &folder)
  {
    RawList root;
    for (const auto &[path, text] : settings)
      set_parameter(root, path, text, false);
    return build_root(root, schema, name, folder);
  }
} // namespace myolines::scene
