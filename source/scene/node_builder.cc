// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/files.h>
#include <myolines/base/names.h>
#include <myolines/scene/node_builder.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <map>
#include <set>

namespace myolines::scene
{
  namespace
  {
    std::string quoted(const std::string &text) { return "\"" + text + "\""; }

    std::string nearest_or_all(const std::string &name, const std::vector<std::string> &known)
    {
      const std::string nearest = nearest_hint(name, known, "nearest valid name");
      return !nearest.empty() ? nearest : known.empty() ? "" : "valid names: " + join(known);
    }

    /// Values of the attribute "type" that go with a kind; the first is the one to recommend.
    std::vector<std::string> type_attributes(const Kind kind)
    {
      switch (kind)
        {
        case Kind::number:
          return {"double", "int", "float"};
        case Kind::integer:
          return {"int"};
        case Kind::boolean:
          return {"bool"};
        case Kind::text:
          return {"string", "double", "int", "float"}; // a number is a text, too
        default:
          return {"string"};
        }
    }

    const RawList *find_list(const RawList &raw, const std::string &name)
    {
      for (const RawList &list : raw.lists)
        if (list.name == name)
          return &list;
      return nullptr;
    }

    const RawParameter *find(const RawList &raw, const std::string &name)
    {
      for (const RawParameter &parameter : raw.parameters)
        if (parameter.name == name)
          return &parameter;
      return nullptr;
    }

    /// Names of parameters and lists that a schema and its alternatives declare.
    void collect_names(const Schema &schema, std::set<std::string> &names)
    {
      for (const Entry &entry : schema.entries())
        names.insert(entry.name);
      for (const Schema::Section &section : schema.sections())
        names.insert(section.name);
      if (schema.variant())
        for (const auto &[alternative, other] : schema.variant()->alternatives)
          collect_names(*other, names);
    }

    template <typename Item>
    bool contains(const std::vector<Item> &items, const Item &item)
    {
      return std::find(items.begin(), items.end(), item) != items.end();
    }
  } // namespace

  /// What the schemas in force know at one list.
  struct NodeBuilder::Names
  {
    std::vector<std::string>           parameters;
    std::vector<std::string>           lists;
    std::map<std::string, std::string> elsewhere;       ///< name -> alternative of a variant, not selected, that it belongs to
    bool                               complete = true; ///< false: a selector is wrong, so nobody knows what is allowed
    bool                               any_list = false;

    Names(const std::vector<const Schema *> &chain)
    {
      for (const Schema *schema : chain)
        {
          for (const Entry &entry : schema->entries())
            parameters.push_back(entry.name);
          for (const Schema::Section &section : schema->sections())
            lists.push_back(section.name);
          any_list = any_list || schema->named() != nullptr;
          if (schema->variant())
            for (const auto &[alternative, other] : schema->variant()->alternatives)
              if (!contains(chain, static_cast<const Schema *>(other.get())))
                add_elsewhere(*other, alternative);
        }
      complete = !chain.back()->variant();
    }

    void add_elsewhere(const Schema &schema, const std::string &alternative)
    {
      for (const Entry &entry : schema.entries())
        elsewhere.emplace(entry.name, alternative);
      for (const Schema::Section &section : schema.sections())
        elsewhere.emplace(section.name, alternative);
      if (schema.variant())
        for (const auto &[name, other] : schema.variant()->alternatives)
          add_elsewhere(*other, alternative);
    }
  };

  NodeBuilder::NodeBuilder(std::string name, std::filesystem::path folder, std::vector<InputProblem> &problems,
                           std::vector<std::string> notes)
    : name_(std::move(name))
    , folder_(std::move(folder))
    , problems_(problems)
    , notes_(std::move(notes))
  {}

  Node NodeBuilder::build(const RawList *written, const Schema &schema, const std::string &list_name, const std::string &path)
  {
    RawList raw = written != nullptr ? *written : RawList();

    Node node;
    node.name_       = list_name;
    node.path_       = path;
    node.written_    = written != nullptr;
    node.scene_file_ = name_;

    const auto  chain = schema.chain([&raw](const Entry &selector) {
      const RawParameter *given = find(raw, selector.name);
      return given != nullptr ? trimmed(given->text) : selector.fallback.value_or("");
    });
    const Names names(chain);
    node.declared_ = names.parameters;
    node.declared_.insert(node.declared_.end(), names.lists.begin(), names.lists.end());
    for (const auto &[name, alternative] : names.elsewhere)
      node.declared_.push_back(name);

    drop_former(raw, chain, names, path);
    refuse_duplicates(raw, node);
    for (const Schema *link : chain)
      {
        for (const Entry &entry : link->entries())
          read_entry(raw, entry, node);
        for (const Schema::Section &section : link->sections())
          read_section(raw, section, node);
        if (link->named() != nullptr)
          read_named(raw, *link->named(), names, node);
      }
    if (names.complete)
      refuse_unknown(raw, names, node);
    if (path.empty())
      node.notes_ = notes_;
    return node;
  }

  void NodeBuilder::read_entry(const RawList &raw, const Entry &entry, Node &node)
  {
    const RawParameter *given = find(raw, entry.name);
    if (given != nullptr)
      {
        if (const auto text = checked(*given, entry, where(node, entry.name, given->from_override)))
          node.values_.push_back({entry.name, {*text, entry.kind, true}});
      }
    else if (entry.fallback)
      node.values_.push_back({entry.name, {*entry.fallback, entry.kind, false}});
    else if (!entry.optional)
      problems_.push_back({node.where(entry.name), "missing parameter " + quoted(entry.name), entry.expected(), entry.doc});
  }

  void NodeBuilder::read_section(const RawList &raw, const Schema::Section &section, Node &node)
  {
    const RawList *list = find_list(raw, section.name);
    if (list != nullptr || !section.optional)
      node.sections_.push_back(
          build(list, *section.schema, section.name, node.path_.empty() ? section.name : node.path_ + "/" + section.name));
  }

  void NodeBuilder::read_named(const RawList &raw, const Schema &each, const Names &names, Node &node)
  {
    std::vector<std::string> written;
    for (const RawList &list : raw.lists)
      if (!list.from_override)
        written.push_back(list.name);
    for (const RawList &list : raw.lists)
      {
        if (contains(names.lists, list.name))
          continue;
        if (list.from_override)
          problems_.push_back({where(node, list.name, true), "the scene has no list " + quoted(list.name) + " here",
                               "a list that the scene writes", nearest_or_all(list.name, written)});
        else if (list.name.find('/') != std::string::npos)
          problems_.push_back({node.where(list.name), "the name " + quoted(list.name) + " contains a slash",
                               "a name without slashes, which separate lists in paths", ""});
        else
          node.named_.push_back(build(&list, each, list.name, node.path_.empty() ? list.name : node.path_ + "/" + list.name));
      }
  }

  void NodeBuilder::refuse_duplicates(const RawList &raw, const Node &node)
  {
    std::set<std::string> seen, of_overrides, reported;
    const auto            report = [&](const std::string &name) {
      if (reported.insert(name).second)
        problems_.push_back({node.where(name), "duplicate: " + quoted(name) + " is written more than once in this list", "every name once",
                             "remove all but one"});
    };
    for (const RawParameter &parameter : raw.parameters)
      {
        if (!seen.insert(parameter.name).second)
          report(parameter.name);
        if (parameter.from_override)
          of_overrides.insert(parameter.name);
      }
    // A parameter and a list of one name, one of them made by an override: told as what it is, by refuse_unknown().
    for (const RawList &list : raw.lists)
      if (!seen.insert(list.name).second && !list.from_override && of_overrides.count(list.name) == 0)
        report(list.name);
  }

  namespace
  {
    /// Of a choice that is not written.
    std::string fallback(const Schema &schema, const std::string &choice)
    {
      for (const Entry &entry : schema.entries())
        if (entry.name == choice)
          return entry.fallback.value_or("");
      return "";
    }

    /// Whether @p chain has a choice of this name, but not this value of it.
    bool is_other_choice(const RawParameter &parameter, const std::vector<const Schema *> &chain)
    {
      for (const Schema *link : chain)
        for (const Entry &entry : link->entries())
          if (entry.name == parameter.name && entry.kind == Kind::choice)
            return !contains(entry.choices, trimmed(parameter.text));
      return false;
    }

    bool is_other_choice(const RawList &, const std::vector<const Schema *> &) { return false; }

    bool has_overrides(const RawList &list)
    {
      const auto of_override = [](const RawParameter &parameter) { return parameter.from_override; };
      return list.from_override || std::any_of(list.parameters.begin(), list.parameters.end(), of_override) ||
             std::any_of(list.lists.begin(), list.lists.end(), has_overrides);
    }
  } // namespace

  /// An override that chooses another alternative takes with it what the file has for the former one, and choices of one name that the new
  /// one has not; what overrides say themselves stays, and is refused where it does not apply.
  void NodeBuilder::drop_former(RawList &raw, const std::vector<const Schema *> &chain, const Names &names, const std::string &path)
  {
    for (const Schema *link : chain)
      {
        if (!link->variant())
          continue;
        const RawParameter *selector = find(raw, link->variant()->selector);
        if (selector == nullptr || !selector->from_override)
          continue;
        const std::string name = selector->name, chosen = trimmed(selector->text);
        const std::string former = selector->replaced.empty() ? fallback(*link, name) : trimmed(selector->replaced);
        if (former == chosen)
          continue;
        std::set<std::string> of_former;
        for (const auto &[alternative, schema] : link->variant()->alternatives)
          if (alternative == former)
            collect_names(*schema, of_former);
        std::vector<std::string> dropped;
        const auto               drop = [&](auto &items, const auto &is_overridden) {
          const auto first = std::stable_partition(items.begin(), items.end(), [&](const auto &item) {
            return of_former.count(item.name) == 0 || is_overridden(item) ||
                   ((contains(names.parameters, item.name) || contains(names.lists, item.name) || names.any_list) &&
                    !is_other_choice(item, chain));
          });
          for (auto item = first; item != items.end(); ++item)
            dropped.push_back("\"" + item->name + "\"");
          items.erase(first, items.end());
        };
        drop(raw.parameters, [](const RawParameter &parameter) { return parameter.from_override; });
        drop(raw.lists, has_overrides);
        if (!dropped.empty())
          notes_.push_back((path.empty() ? "" : path + "/") + name + " is " + quoted(chosen) + " instead of " + quoted(former) +
                           ": left out of the scene is " + join(dropped));
      }
  }

  void NodeBuilder::refuse_unknown(const RawList &raw, const Names &names, const Node &node)
  {
    const auto refuse = [&](const std::string &name, const bool is_list, const bool from_override) {
      const std::vector<std::string> &same  = is_list ? names.lists : names.parameters;
      const std::vector<std::string> &other = is_list ? names.parameters : names.lists;
      if (contains(same, name) || (is_list && names.any_list))
        return;
      const std::string place = where(node, name, from_override);
      if (contains(other, name))
        problems_.push_back({place, quoted(name) + (is_list ? " is a parameter, not a list" : " is a list, not a parameter"),
                             is_list ? "a parameter" : "a list",
                             from_override && !is_list ? "name a parameter in it: " + quoted(name + "/NAME=VALUE") : ""});
      else if (names.elsewhere.count(name) != 0)
        problems_.push_back({place, quoted(name) + " does not apply here", "what belongs to the chosen alternative",
                             "it belongs to " + quoted(names.elsewhere.at(name))});
      else
        problems_.push_back({place, std::string("unknown ") + (is_list ? "list " : "parameter ") + quoted(name),
                             "a name that is declared here", nearest_or_all(name, same)});
    };
    for (const RawParameter &parameter : raw.parameters)
      refuse(parameter.name, false, parameter.from_override);
    for (const RawList &list : raw.lists)
      refuse(list.name, true, list.from_override);
  }

  std::optional<std::string> NodeBuilder::checked(const RawParameter &raw, const Entry &entry, const std::string &where)
  {
    const std::vector<std::string> types = type_attributes(entry.kind);
    if (!raw.type.empty() && !contains(types, raw.type))
      {
        problems_.push_back(
            {where, "type=" + quoted(raw.type) + " does not fit", "type=" + quoted(types.front()) + ", " + entry.expected(), ""});
        return std::nullopt;
      }
    const auto refuse = [&](const std::string &what, const std::string &hint = "") {
      problems_.push_back({where, what, entry.expected(), hint});
      return std::nullopt;
    };
    if (entry.kind == Kind::text)
      return raw.text;
    const std::string text = trimmed(raw.text);
    if (entry.kind == Kind::file)
      return checked_file(text, entry, where, raw.from_override);
    if (entry.kind == Kind::choice && !contains(entry.choices, text))
      return refuse(quoted(text) + " is not a valid choice", nearest_or_all(text, entry.choices));
    if (entry.kind == Kind::boolean && text != "true" && text != "false")
      return refuse(quoted(text) + " is not a truth value");
    if (entry.kind == Kind::number || entry.kind == Kind::integer)
      {
        if (raw.type == "int" && !parse_integer(text))
          return refuse(quoted(text) + " is not an integer, as type=\"int\" says");
        const std::optional<double> value = entry.kind == Kind::number ? parse_number(text) : std::optional<double>(parse_integer(text));
        if (!value)
          return refuse(quoted(text) + (entry.kind == Kind::number ? " is not a finite number" : " is not an integer"));
        if (!entry.range.contains(*value))
          return refuse(text + " is out of range");
      }
    return text;
  }

  std::optional<std::string> NodeBuilder::checked_file(const std::string &text, const Entry &entry, const std::string &where,
                                                       const bool from_override)
  {
    const auto refuse = [&](const std::string &what) {
      problems_.push_back({where, what, entry.expected(), ""});
      return std::nullopt;
    };
    if (text.empty())
      return refuse("there is no file \"\"");
    std::error_code             none; // what cannot be looked at is not there
    const bool                  of_caller = from_override && std::filesystem::is_regular_file(text, none);
    const std::filesystem::path folder    = of_caller ? std::filesystem::path() : folder_;
    const std::filesystem::path file      = std::filesystem::absolute(folder / text).lexically_normal();
    if (!std::filesystem::is_regular_file(file, none))
      return refuse("there is no file " + quoted(file.string()) +
                    (std::filesystem::exists(file, none) ? ": it is a folder, a device or a pipe" : ""));
    if (first_not_utf8(file.string()) != std::string::npos)
      return refuse("the name of the file " + quoted(file.string()) + " is not UTF-8");
    return file.string();
  }

  std::string NodeBuilder::where(const Node &node, const std::string &name, const bool from_override) const
  {
    return from_override ? node.where(name) + " (override)" : node.where(name);
  }
} // namespace myolines::scene
