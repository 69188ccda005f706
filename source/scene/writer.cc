// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/scene_writer.h>

#include <algorithm>

namespace myolines::scene
{
  namespace
  {
    std::string escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        switch (c)
          {
          case '&':
            result += "&amp;";
            break;
          case '<':
            result += "&lt;";
            break;
          case '>':
            result += "&gt;";
            break;
          case '"':
            result += "&quot;";
            break;
          case '\n': // a raw one would come back as a space from other XML readers
            result += "&#10;";
            break;
          default:
            result += c;
          }
      return result;
    }

    std::string type_attribute(const Kind kind)
    {
      switch (kind)
        {
        case Kind::number:
          return "double";
        case Kind::integer:
          return "int";
        case Kind::boolean:
          return "bool";
        default:
          return "string";
        }
    }
  } // namespace

  std::string SceneWriter::document(const Node &root, const Schema *schema, const std::string &name)
  {
    out_.str("");
    line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", 0);
    line("<ParameterList name=\"" + escaped(name) + "\">", 0);
    contents(root, schema, 1);
    line("</ParameterList>", 0);
    return out_.str();
  }

  void SceneWriter::list(const Node &node, const Schema *schema, const int depth)
  {
    if (!wanted(node))
      return;
    line("<ParameterList name=\"" + escaped(node.name()) + "\">", depth);
    contents(node, schema, depth + 1);
    line("</ParameterList>", depth);
  }

  void SceneWriter::contents(const Node &node, const Schema *schema, const int depth)
  {
    if (schema != nullptr)
      commented_contents(node, *schema, depth);
    else
      plain_contents(node, depth);
  }

  void SceneWriter::plain_contents(const Node &node, const int depth)
  {
    for (const auto &[name, value] : node.values_)
      if (values_ == Values::all || value.written)
        parameter(name, value, depth);
    for (const Node &section : node.sections_)
      list(section, nullptr, depth);
    for (const Node &named : node.named_)
      list(named, nullptr, depth);
  }

  void SceneWriter::commented_contents(const Node &node, const Schema &schema, const int depth)
  {
    if (!schema.doc().empty())
      comment(schema.doc(), depth);
    const auto chain = schema.chain([&node](const Entry &selector) { return node.text(selector.name); });
    for (const Schema *link : chain)
      {
        if (link != &schema && !link->doc().empty())
          comment(link->doc(), depth);
        for (const Entry &entry : link->entries())
          {
            comment(entry.declaration() + ". " + entry.doc, depth);
            const auto found =
                std::find_if(node.values_.begin(), node.values_.end(), [&entry](const auto &value) { return value.first == entry.name; });
            if (found != node.values_.end())
              parameter(entry.name, found->second, depth);
            else
              comment("<Parameter name=\"" + escaped(entry.name) + "\" type=\"" + type_attribute(entry.kind) + "\" value=\"...\"/>", depth);
          }
        for (const Schema::Section &section : link->sections())
          if (node.has(section.name))
            list(node.section(section.name), section.schema.get(), depth);
          else
            comment("optional list \"" + section.name + "\": " + section.schema->doc(), depth);
        if (link->named() != nullptr)
          for (const Node &named : node.named())
            list(named, link->named().get(), depth);
      }
  }

  void SceneWriter::parameter(const std::string &name, const Node::Value &value, const int depth)
  {
    line("<Parameter name=\"" + escaped(name) + "\" type=\"" + type_attribute(value.kind) + "\" value=\"" + escaped(value.text) + "\"/>",
         depth);
  }

  void SceneWriter::comment(const std::string &text, const int depth)
  {
    // two hyphens would end the comment
    std::string safe = text;
    for (auto at = safe.find("--"); at != std::string::npos; at = safe.find("--"))
      safe.replace(at, 2, "- -");
    line("<!-- " + safe + " -->", depth);
  }

  bool SceneWriter::wanted(const Node &node) const { return values_ == Values::all || node.written_; }

  void SceneWriter::line(const std::string &text, const int depth) { out_ << std::string(2 * depth, ' ') << text << '\n'; }

  std::string resolved_xml(const Node &root, const std::string &name)
  {
    return SceneWriter(SceneWriter::Values::all).document(root, nullptr, name);
  }

  std::string written_xml(const Node &root) { return SceneWriter(SceneWriter::Values::written).document(root); }

  std::string template_xml(const Schema &schema, const std::vector<Setting> &settings)
  {
    return SceneWriter(SceneWriter::Values::all).document(compose_scene(schema, settings, "template"), &schema);
  }
} // namespace myolines::scene
