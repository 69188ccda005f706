// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/columns.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cctype>
#include <functional>

namespace myolines::scene
{
  namespace
  {
    struct Unit
    {
      const char *name;
      char        dimension;
      double      size;
    };

    const Unit *find_unit(const std::string &name)
    {
      static const Unit units[] = {
          {"s", 't', 1},       {"sec", 't', 1},        {"seconds", 't', 1},    {"ms", 't', 1e-3},
          {"us", 't', 1e-6},   {"\u00b5s", 't', 1e-6}, {"min", 't', 60},       {"m", 'l', 1},
          {"cm", 'l', 1e-2},   {"mm", 'l', 1e-3},      {"um", 'l', 1e-6},      {"\u00b5m", 'l', 1e-6},
          {"N", 'f', 1},       {"kN", 'f', 1e3},       {"mN", 'f', 1e-3},      {"-", '1', 1},
          {"1", '1', 1},       {"%", '1', 1e-2},       {"%MVC", '1', 1e-2},    {"% MVC", '1', 1e-2},
          {"Pa", 'p', 1},      {"kPa", 'p', 1e3},      {"MPa", 'p', 1e6},      {"V", 'v', 1},
          {"mV", 'v', 1e-3},   {"uV", 'v', 1e-6},      {"\u00b5V", 'v', 1e-6}, {"degree", 'a', 1},
          {"degrees", 'a', 1}, {"deg", 'a', 1},        {"\u00b0", 'a', 1},     {"rad", 'a', 180 / 3.14159265358979323846},
          {"m/s", 'w', 1},     {"cm/s", 'w', 1e-2},    {"mm/s", 'w', 1e-3}};
      const auto found = std::find_if(std::begin(units), std::end(units), [&](const Unit &unit) { return name == unit.name; });
      return found == std::end(units) ? nullptr : found;
    }
  } // namespace

  std::string lower_case(std::string text)
  {
    for (char &c : text)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  }

  ColumnName split_column_name(const std::string &name)
  {
    const std::string text = trimmed(name);
    for (const char *brackets : {"[]", "()"})
      if (const auto open = text.rfind(brackets[0]); open != std::string::npos && text.back() == brackets[1])
        return {trimmed(text.substr(0, open)), trimmed(text.substr(open + 1, text.size() - open - 2))};
    return {text, ""};
  }

  std::vector<std::size_t> matching_columns(const std::string &name, const std::vector<std::string> &header)
  {
    const std::function<std::string(const std::string &)> keys[] = {
        [](const std::string &text) { return text; }, [](const std::string &text) { return split_column_name(text).quantity; },
        [](const std::string &text) { return lower_case(split_column_name(text).quantity); }};
    std::vector<std::size_t> found;
    for (const auto &key : keys)
      {
        for (std::size_t i = 0; i < header.size(); ++i)
          if (key(header[i]) == key(name))
            found.push_back(i);
        if (!found.empty())
          break;
      }
    return found;
  }

  bool is_unit(const std::string &name) { return find_unit(name) != nullptr; }

  std::optional<double> unit_factor(const std::string &from, const std::string &to)
  {
    if (from == to)
      return 1;
    const Unit *const a = find_unit(from), *const b = find_unit(to);
    if (a == nullptr || b == nullptr || a->dimension != b->dimension)
      return std::nullopt;
    return a->size / b->size;
  }
} // namespace myolines::scene
