// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/scene/contents.h>
#include <myolines/scene/numbers.h>

#include <sstream>

namespace myolines::scene
{
  namespace
  {
    /// The value of a parameter as scenes spell it; nothing where there is none.
    std::optional<std::string> text_of(const Node &node, const Entry &entry)
    {
      if (!node.has(entry.name))
        return std::nullopt;
      switch (entry.kind)
        {
        case Kind::number:
          return format_number(node.number(entry.name));
        case Kind::integer:
          return std::to_string(node.integer(entry.name));
        case Kind::boolean:
          return node.boolean(entry.name) ? "true" : "false";
        case Kind::file:
          return node.file(entry.name).string();
        default:
          return node.text(entry.name);
        }
    }

    /// The schemas in force at a list, which need not be there.
    std::vector<const Schema *> chain_at(const Node *node, const Schema &schema)
    {
      return schema.chain(
          [node](const Entry &selector) { return node != nullptr ? trimmed(node->text(selector.name)) : selector.fallback.value_or(""); });
    }

    struct Place
    {
      const Node   *node; ///< nullptr: not there
      const Schema *schema;
    };

    std::optional<Place> below(const Place &place, const std::string &name)
    {
      for (const Schema *link : chain_at(place.node, *place.schema))
        {
          for (const Schema::Section &section : link->sections())
            if (section.name == name)
              {
                const bool there = place.node != nullptr && place.node->has(name);
                return Place{there ? &place.node->section(name) : nullptr, section.schema.get()};
              }
          if (link->named() != nullptr && place.node != nullptr)
            for (const Node &named : place.node->named())
              if (named.name() == name)
                return Place{&named, link->named().get()};
        }
      return std::nullopt;
    }

    Contents contents_at(const Place &place)
    {
      Contents contents{place.schema->doc(), {}, false};
      for (const Schema *link : chain_at(place.node, *place.schema))
        {
          for (const Entry &entry : link->entries())
            {
              Item item;
              item.name    = entry.name;
              item.entry   = entry;
              item.text    = place.node != nullptr ? text_of(*place.node, entry) : entry.fallback;
              item.present = item.text.has_value();
              item.written = place.node != nullptr && place.node->written(entry.name);
              contents.items.push_back(item);
            }
          for (const Schema::Section &section : link->sections())
            {
              Item item;
              item.name    = section.name;
              item.is_list = true;
              item.present = place.node != nullptr ? place.node->has(section.name) : !section.optional;
              item.written = place.node != nullptr && place.node->written(section.name);
              item.doc     = section.schema->doc();
              contents.items.push_back(item);
            }
          contents.takes_more = contents.takes_more || link->named() != nullptr;
        }
      if (place.node != nullptr)
        for (const Node &named : place.node->named())
          {
            Item item;
            item.name    = named.name();
            item.is_list = item.named = item.present = item.written = true;
            contents.items.push_back(item);
          }
      return contents;
    }
  } // namespace

  Contents contents_of(const Node &root, const Schema &schema, const std::string &path)
  {
    Place              place{&root, &schema};
    std::istringstream parts(path);
    std::string        so_far;
    for (std::string name; std::getline(parts, name, '/');)
      {
        const auto next = below(place, name);
        if (!next)
          {
            std::vector<std::string> lists;
            for (const Item &item : contents_at(place).items)
              if (item.is_list)
                lists.push_back(item.name);
            const std::string nearest = nearest_hint(name, lists, "nearest valid name");
            throw InputError(InputProblem{root.where("") + so_far + name, "unknown list \"" + name + "\"", "a name that is declared here",
                                          nearest.empty() && !lists.empty() ? "valid names: " + join(lists) : nearest});
          }
        place = *next;
        so_far += name + "/";
      }
    return contents_at(place);
  }
} // namespace myolines::scene
