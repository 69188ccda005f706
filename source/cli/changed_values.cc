// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/catalogue.h>
#include <myolines/cli/changed_values.h>
#include <myolines/scene/numbers.h>

namespace myolines
{
  namespace
  {
    std::string text_of(const scene::Node &node, const scene::Entry &entry)
    {
      switch (entry.kind)
        {
        case scene::Kind::number:
          return scene::format_number(node.number(entry.name));
        case scene::Kind::integer:
          return std::to_string(node.integer(entry.name));
        case scene::Kind::boolean:
          return node.boolean(entry.name) ? "true" : "false";
        case scene::Kind::file:
          return node.file(entry.name).string();
        default:
          return node.text(entry.name);
        }
    }

    bool is_usual(const std::string &value, const scene::Entry &entry)
    {
      if (!entry.fallback || value == *entry.fallback)
        return entry.fallback.has_value();
      const auto a = scene::parse_number(value), b = scene::parse_number(*entry.fallback);
      return a && b && *a == *b;
    }

    void collect(const scene::Node &node, const scene::Schema &whole, const std::string &path, std::vector<report::ChangedValue> &changed)
    {
      for (const scene::Schema *schema :
           whole.chain([&](const scene::Entry &entry) { return node.has(entry.name) ? node.text(entry.name) : ""; }))
        {
          for (const scene::Entry &entry : schema->entries())
            if (node.has(entry.name))
              if (const std::string value = text_of(node, entry); !is_usual(value, entry))
                changed.push_back({path + entry.name, value + (entry.unit.empty() || entry.unit == "-" ? "" : " " + entry.unit),
                                   entry.fallback.value_or(""), entry.doc});
          for (const scene::Schema::Section &section : schema->sections())
            if (node.has(section.name))
              collect(node.section(section.name), *section.schema, path + section.name + "/", changed);
          if (schema->named())
            for (const scene::Node &each : node.named())
              collect(each, *schema->named(), path + each.name() + "/", changed);
        }
    }
  } // namespace

  std::vector<report::ChangedValue> changed_values(const std::filesystem::path &file)
  {
    const scene::Node                 scene = read_whole_scene(file, {});
    std::vector<report::ChangedValue> changed;
    collect(scene, root_schema(system_entry(scene.section("system").text("type"), scene.section("system").where("type"))), "", changed);
    return changed;
  }
} // namespace myolines
