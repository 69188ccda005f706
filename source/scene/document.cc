// SPDX-License-Identifier: LGPL-2.1-or-later
#include "xml_check.h"

#include <myolines/base/files.h>
#include <myolines/scene/document.h>
#include <myolines/scene/numbers.h>

#include <Teuchos_StringInputSource.hpp>
#include <Teuchos_XMLObject.hpp>

#include <algorithm>
#include <sstream>

namespace myolines::scene
{
  namespace
  {
    const std::string list_tag      = "ParameterList";
    const std::string parameter_tag = "Parameter";

    /// The last line of what Teuchos says: the lines before it tell of its own source files.
    std::string last_line(const std::string &message)
    {
      const std::string text = trimmed(message);
      return text.substr(text.find_last_of('\n') + 1);
    }

    class Reader
    {
    public:
      Reader(const std::string &file, std::vector<InputProblem> &problems)
        : file_(file)
        , problems_(problems)
      {}

      RawList list(const Teuchos::XMLObject &element, const std::string &name, const std::string &path)
      {
        RawList result;
        result.name = name;
        check_attributes(element, {"name"}, path);
        check_content(element, path);
        for (int i = 0; i < element.numChildren(); ++i)
          child(element.getChild(i), result, path);
        return result;
      }

    private:
      void problem(const std::string &path, const std::string &what, const std::string &expected, const std::string &hint = "")
      {
        problems_.push_back({file_ + ": " + (path.empty() ? "root" : path), what, expected, hint});
      }

      void child(const Teuchos::XMLObject &element, RawList &parent, const std::string &path)
      {
        const std::string tag = element.getTag();
        if (tag != list_tag && tag != parameter_tag)
          return problem(path, "unknown element <" + tag + ">", "<ParameterList> or <Parameter>");
        const std::string name = attribute(element, "name", path);
        if (name.empty())
          return;
        const std::string below = path.empty() ? name : path + "/" + name;
        if (tag == list_tag)
          parent.lists.push_back(list(element, name, below));
        else
          parameter(element, parent, name, below);
      }

      void parameter(const Teuchos::XMLObject &element, RawList &parent, const std::string &name, const std::string &path)
      {
        check_attributes(element, {"name", "type", "value"}, path);
        check_content(element, path);
        for (int i = 0; i < element.numChildren(); ++i)
          problem(path, "<Parameter> with an element <" + element.getChild(i).getTag() + "> inside", "no content");
        const std::string type = attribute(element, "type", path);
        if (!element.hasAttribute("value"))
          return problem(path, "<Parameter> without attribute \"value\"", "name=\"...\" type=\"...\" value=\"...\"");
        if (!type.empty())
          parent.parameters.push_back({name, type, element.getAttribute("value"), false, ""});
      }

      /// A needed attribute; "" and a problem if it is missing or empty.
      std::string attribute(const Teuchos::XMLObject &element, const std::string &name, const std::string &path)
      {
        const std::string value = element.hasAttribute(name) ? element.getAttribute(name) : "";
        if (value.empty())
          problem(path, "<" + element.getTag() + "> without attribute \"" + name + "\"",
                  element.getTag() == list_tag ? "name=\"...\"" : "name=\"...\" type=\"...\" value=\"...\"");
        return value;
      }

      /// Teuchos does not list attributes, but the start tag it prints is longer if there are others than the known.
      void check_attributes(const Teuchos::XMLObject &element, const std::vector<std::string> &known, const std::string &path)
      {
        std::size_t length = element.getTag().size() + 2;
        for (const std::string &name : known)
          if (element.hasAttribute(name))
            length += name.size() + element.getAttribute(name).size() + 4;
        if (element.header().size() != length)
          problem(path, "unknown attribute in " + element.header(),
                  "no attributes but " + std::string(known.size() == 1 ? "name" : "name, type, value"));
      }

      void check_content(const Teuchos::XMLObject &element, const std::string &path)
      {
        for (int i = 0; i < element.numContentLines(); ++i)
          if (const std::string text = trimmed(element.getContentLine(i)); !text.empty())
            return problem(path, "stray text \"" + text + "\"", "only elements <ParameterList>, <Parameter> and comments");
      }

      const std::string         &file_;
      std::vector<InputProblem> &problems_;
    };

    template <typename Items>
    auto find_named(Items &items, const std::string &name) -> decltype(&*items.begin())
    {
      const auto found = std::find_if(items.begin(), items.end(), [&name](const auto &item) { return item.name == name; });
      return found == items.end() ? nullptr : &*found;
    }

    std::vector<std::string> split_path(const std::string &path)
    {
      std::vector<std::string> names;
      std::istringstream       parts(path);
      for (std::string name; std::getline(parts, name, '/');)
        names.push_back(trimmed(name));
      return names;
    }
  } // namespace

  RawList parse_document(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems, const std::string &root_name)
  {
    const std::string  expected = "<ParameterList name=\"" + root_name + "\">";
    Teuchos::XMLObject root;
    const auto         plain = plain_xml(xml, file, problems);
    if (!plain)
      return {};
    try
      {
        root = Teuchos::StringInputSource(*plain).getObject();
      }
    catch (const std::exception &error)
      {
        problems.push_back(
            {file, "malformed XML: " + last_line(error.what()), "an XML document " + expected + " ... </ParameterList>", ""});
        return {};
      }
    if (root.getTag() != list_tag || !root.hasAttribute("name") || root.getAttribute("name") != root_name)
      {
        problems.push_back({file, "the document is " + root.header(), expected, ""});
        return {};
      }
    return Reader(file, problems).list(root, "", "");
  }

  namespace
  {
    /// The list in @p parent, made where there is none.
    RawList &list_in(RawList &parent, const std::string &name, const bool from_override)
    {
      if (RawList *present = find_named(parent.lists, name))
        return *present;
      parent.lists.push_back({name, {}, {}, from_override});
      return parent.lists.back();
    }
  } // namespace

  void add_list(RawList &root, const std::string &path)
  {
    RawList *list = &root;
    for (const std::string &name : split_path(path))
      list = &list_in(*list, name, false);
  }

  void set_parameter(RawList &root, const std::string &path, const std::string &text, const bool from_override)
  {
    std::vector<std::string> names = split_path(path);
    const std::string        last  = names.empty() ? "" : names.back();
    RawList                 *list  = &root;
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
      list = &list_in(*list, names[i], from_override);
    RawParameter value{last, "", text, from_override, ""};
    if (RawParameter *present = find_named(list->parameters, last))
      {
        value.replaced = present->from_override ? present->replaced : present->text;
        *present       = value;
      }
    else
      list->parameters.push_back(value);
  }

  bool remove_entry(RawList &root, const std::string &path)
  {
    const std::vector<std::string> names = split_path(path);
    RawList                       *list  = &root;
    for (std::size_t i = 0; i + 1 < names.size() && list != nullptr; ++i)
      list = find_named(list->lists, names[i]);
    if (list == nullptr || names.empty())
      return false;
    const auto remove = [&](auto &items) {
      const auto first = std::remove_if(items.begin(), items.end(), [&](const auto &item) { return item.name == names.back(); });
      const bool found = first != items.end();
      items.erase(first, items.end());
      return found;
    };
    const bool parameter = remove(list->parameters), whole_list = remove(list->lists);
    return parameter || whole_list;
  }

  void apply_overrides(RawList &root, const std::vector<std::string> &overrides, std::vector<InputProblem> &problems)
  {
    for (const std::string &override_text : overrides)
      {
        if (!override_text.empty() && override_text.front() == '~')
          {
            const std::string path = trimmed(override_text.substr(1));
            if (!remove_entry(root, path))
              problems.push_back({"override: unset \"" + path + "\"", "the scene does not write it",
                                  "a parameter or a list that the scene writes",
                                  "what is not written has its default: `myolines check` prints all values in force"});
            continue;
          }
        const auto        equals = override_text.find('=');
        const std::string path   = trimmed(override_text.substr(0, equals));
        if (equals == std::string::npos || path.empty())
          problems.push_back({"override \"" + override_text + "\"", "no path and value", "path=value", "for example \"time/step=1e-3\""});
        else if (first_not_utf8(override_text) != std::string::npos)
          problems.push_back({"override \"" + path + "\"", "it is not text in UTF-8", "UTF-8, as scenes are", ""});
        else if (std::any_of(override_text.begin(), override_text.end(), is_control))
          problems.push_back({"override \"" + path + "\"", "there is a control character in it", "text, as in scenes", ""});
        else
          set_parameter(root, path, override_text.substr(equals + 1), true);
      }
  }

  const RawList *find_list_at(const RawList &root, const std::string &path)
  {
    const RawList *list = &root;
    for (const std::string &name : split_path(path))
      list = list == nullptr ? nullptr : find_named(list->lists, name);
    return list;
  }

  const RawParameter *find_parameter(const RawList &root, const std::string &path)
  {
    const std::vector<std::string> names = split_path(path);
    const RawList                 *list  = &root;
    for (std::size_t i = 0; i + 1 < names.size() && list != nullptr; ++i)
      list = find_named(list->lists, names[i]);
    return list == nullptr || names.empty() ? nullptr : find_named(list->parameters, names.back());
  }
} // namespace myolines::scene
