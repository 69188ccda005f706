// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace myolines::scene
{
  namespace
  {
    template <typename Number>
    std::optional<Number> parse(const std::string &text)
    {
      std::string word = trimmed(text);
      // from_chars knows no plus sign, and "+-1" is no number
      if (word.size() > 1 && word[0] == '+' && word[1] != '-')
        word.erase(0, 1);
      Number     value{};
      const auto end    = word.data() + word.size();
      const auto result = std::from_chars(word.data(), end, value);
      if (word.empty() || result.ec != std::errc() || result.ptr != end)
        return std::nullopt;
      return value;
    }
  } // namespace

  std::vector<std::string> lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    return lines;
  }

  std::string trimmed(const std::string &text)
  {
    const char *const blanks = " \t\r\n";
    const auto        begin  = text.find_first_not_of(blanks);
    if (begin == std::string::npos)
      return "";
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
  }

  std::optional<double> parse_number(const std::string &text)
  {
    const std::optional<double> value = parse<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  std::optional<int> parse_integer(const std::string &text) { return parse<int>(text); }

  std::string format_number(const double value)
  {
    char text[40];
    // from 6 digits on, so that 200000 does not become 2e+05
    for (int digits = 6; digits <= 17; ++digits)
      {
        std::snprintf(text, sizeof(text), "%.*g", digits, value);
        if (parse_number(text) == value)
          break;
      }
    return text;
  }
} // namespace myolines::scene
