// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/scene/scene.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace myolines::scene
{
  namespace
  {
    template <typename Items>
    auto find_section(const Items &sections, const std::string &name)
    {
      return std::find_if(sections.begin(), sections.end(), [&name](const Node &section) { return section.name() == name; });
    }
  } // namespace

  const Node::Value &Node::value(const std::string &name, const Kind kind) const
  {
    for (const auto &[known, value] : values_)
      if (known == name)
        {
          const bool text_of_choice = kind == Kind::text && value.kind == Kind::choice;
          if (value.kind != kind && !text_of_choice)
            throw std::logic_error("parameter \"" + path_ + "/" + name + "\" is asked for as another kind than its schema declares");
          return value;
        }
    throw std::logic_error("parameter \"" + path_ + "/" + name + "\" is asked for, but absent or not declared by its schema");
  }

  double Node::number(const std::string &name) const { return *parse_number(value(name, Kind::number).text); }

  int Node::integer(const std::string &name) const { return *parse_integer(value(name, Kind::integer).text); }

  bool Node::boolean(const std::string &name) const { return value(name, Kind::boolean).text == "true"; }

  std::string Node::text(const std::string &name) const { return value(name, Kind::text).text; }

  std::vector<double> Node::numbers(const std::string &name, const std::string &expected) const
  {
    std::vector<double> values;
    std::istringstream  words(text(name));
    for (std::string word; words >> word;)
      {
        const auto value = parse_number(word);
        if (!value)
          refuse(name, "\"" + word + "\" is not a finite number", expected);
        values.push_back(*value);
      }
    if (values.empty())
      refuse(name, "there is no number", expected);
    return values;
  }

  std::filesystem::path Node::file(const std::string &name) const { return value(name, Kind::file).text; }

  std::vector<std::filesystem::path> Node::files() const
  {
    std::vector<std::filesystem::path> all;
    for (const auto &[name, value] : values_)
      if (value.kind == Kind::file)
        all.push_back(value.text);
    for (const auto *lists : {&sections_, &named_})
      for (const Node &list : *lists)
        for (const std::filesystem::path &file : list.files())
          all.push_back(file);
    return all;
  }

  bool Node::has(const std::string &name) const
  {
    if (std::find(declared_.begin(), declared_.end(), name) == declared_.end())
      throw std::logic_error("\"" + path_ + "/" + name + "\" is asked about, but not declared by its schema");
    const bool valued = std::any_of(values_.begin(), values_.end(), [&name](const auto &entry) { return entry.first == name; });
    return valued || find_section(sections_, name) != sections_.end();
  }

  bool Node::written(const std::string &name) const
  {
    if (!has(name))
      return false;
    for (const auto &[known, value] : values_)
      if (known == name)
        return value.written;
    return section(name).written_;
  }

  const Node &Node::section(const std::string &name) const
  {
    const auto found = find_section(sections_, name);
    if (found == sections_.end())
      throw std::logic_error("list \"" + path_ + "/" + name + "\" is asked for, but absent or not declared by its schema");
    return *found;
  }

  const std::vector<Node> &Node::named() const { return named_; }

  std::string Node::where(const std::string &name) const
  {
    return scene_file_.string() + ": " + (path_.empty() || name.empty() ? path_ + name : path_ + "/" + name);
  }

  void Node::refuse(const std::string &name, const std::string &what, const std::string &expected, const std::string &hint) const
  {
    throw InputError(InputProblem{where(name), what, expected, hint});
  }
} // namespace myolines::scene
