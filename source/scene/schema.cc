// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>
#include <myolines/scene/schema.h>

#include <algorithm>
#include <stdexcept>

namespace myolines::scene
{
  bool Range::contains(const double value) const
  {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }

  std::string Range::text() const
  {
    const bool below = high < std::numeric_limits<double>::infinity();
    const bool above = low > -std::numeric_limits<double>::infinity();
    if (above && below)
      return std::string("in ") + (low_open ? "(" : "[") + format_number(low) + ", " + format_number(high) + (high_open ? ")" : "]");
    if (above)
      return (low_open ? "> " : ">= ") + format_number(low);
    if (below)
      return (high_open ? "< " : "<= ") + format_number(high);
    return "any finite number";
  }

  std::string Entry::expected() const
  {
    const std::string with_unit = unit.empty() || unit == "-" ? "" : " [" + unit + "]";
    const bool        bounded   = range.text() != Range::any().text();
    switch (kind)
      {
      case Kind::number:
        return "a number" + with_unit + (bounded ? " " + range.text() : "");
      case Kind::integer:
        return "an integer" + (bounded ? " " + range.text() : "");
      case Kind::boolean:
        return "true or false";
      case Kind::choice:
        return "one of " + join(choices);
      case Kind::file:
        return "the path of a file, relative to the scene";
      case Kind::text:
        break;
      }
    return "a text";
  }

  std::string Entry::declaration() const
  {
    if (fallback)
      return expected() + "; default " + (kind == Kind::text ? "\"" + *fallback + "\"" : *fallback);
    return expected() + (optional ? "; optional" : "; required");
  }

  Schema::Schema(std::string doc)
    : doc_(std::move(doc))
  {}

  void Schema::refuse_known(const std::string &name) const
  {
    const auto same = [&name](const auto &declared) { return declared.name == name; };
    if (std::any_of(entries_.begin(), entries_.end(), same) || std::any_of(sections_.begin(), sections_.end(), same))
      throw std::logic_error("scene schema declares \"" + name + "\" twice");
  }

  Schema &Schema::add(Entry entry)
  {
    refuse_known(entry.name);
    entries_.push_back(std::move(entry));
    return *this;
  }

  Schema &Schema::add_section(const std::string &name, Schema schema, const bool optional)
  {
    refuse_known(name);
    sections_.push_back({name, std::make_shared<Schema>(std::move(schema)), optional});
    return *this;
  }

  Schema &Schema::number(const std::string &name, const std::optional<double> fallback, const std::string &unit, const Range range,
                         const std::string &doc)
  {
    if (fallback && !range.contains(*fallback))
      throw std::logic_error("the default of \"" + name + "\" is out of its range");
    return add(
        {name, Kind::number, fallback ? std::optional<std::string>(format_number(*fallback)) : std::nullopt, false, unit, range, {}, doc});
  }

  Schema &Schema::integer(const std::string &name, const std::optional<int> fallback, const Range range, const std::string &doc)
  {
    if (fallback && !range.contains(*fallback))
      throw std::logic_error("the default of \"" + name + "\" is out of its range");
    return add(
        {name, Kind::integer, fallback ? std::optional<std::string>(std::to_string(*fallback)) : std::nullopt, false, "", range, {}, doc});
  }

  Schema &Schema::boolean(const std::string &name, const bool fallback, const std::string &doc)
  {
    return add({name, Kind::boolean, fallback ? "true" : "false", false, "", {}, {}, doc});
  }

  Schema &Schema::text(const std::string &name, std::optional<std::string> fallback, const std::string &doc)
  {
    return add({name, Kind::text, std::move(fallback), false, "", {}, {}, doc});
  }

  Schema &Schema::choice(const std::string &name, std::optional<std::string> fallback, std::vector<std::string> choices,
                         const std::string &doc)
  {
    if (fallback && std::find(choices.begin(), choices.end(), *fallback) == choices.end())
      throw std::logic_error("the default of \"" + name + "\" is none of its choices");
    return add({name, Kind::choice, std::move(fallback), false, "", {}, std::move(choices), doc});
  }

  Schema &Schema::file(const std::string &name, const std::string &doc)
  {
    return add({name, Kind::file, std::nullopt, false, "", {}, {}, doc});
  }

  Schema &Schema::optional_number(const std::string &name, const std::string &unit, const Range range, const std::string &doc)
  {
    return add({name, Kind::number, std::nullopt, true, unit, range, {}, doc});
  }

  Schema &Schema::optional_text(const std::string &name, const std::string &doc)
  {
    return add({name, Kind::text, std::nullopt, true, "", {}, {}, doc});
  }

  Schema &Schema::optional_file(const std::string &name, const std::string &doc)
  {
    return add({name, Kind::file, std::nullopt, true, "", {}, {}, doc});
  }

  Schema &Schema::section(const std::string &name, Schema schema) { return add_section(name, std::move(schema), false); }

  Schema &Schema::optional_section(const std::string &name, Schema schema) { return add_section(name, std::move(schema), true); }

  Schema &Schema::named_sections(Schema each)
  {
    named_ = std::make_shared<Schema>(std::move(each));
    return *this;
  }

  Schema &Schema::variant(const std::string &name, std::optional<std::string> fallback,
                          std::vector<std::pair<std::string, Schema>> alternatives, const std::string &doc)
  {
    if (variant_)
      throw std::logic_error("scene schema with two variants, the second is \"" + name + "\"");
    std::vector<std::string> names;
    variant_ = Variant{name, {}};
    for (auto &[alternative, schema] : alternatives)
      {
        names.push_back(alternative);
        variant_->alternatives.emplace_back(alternative, std::make_shared<Schema>(std::move(schema)));
      }
    return choice(name, std::move(fallback), names, doc);
  }

  std::vector<const Schema *> Schema::chain(const std::function<std::string(const Entry &)> &selected) const
  {
    std::vector<const Schema *> links{this};
    for (const Schema *last = this; last != nullptr && last->variant_;)
      {
        const Variant &variant = *last->variant_;
        const auto     selector =
            std::find_if(last->entries_.begin(), last->entries_.end(), [&](const Entry &e) { return e.name == variant.selector; });
        const std::string choice = selected(*selector);
        last                     = nullptr;
        for (const auto &[name, schema] : variant.alternatives)
          if (name == choice)
            last = schema.get();
        if (last != nullptr)
          links.push_back(last);
      }
    return links;
  }
} // namespace myolines::scene
