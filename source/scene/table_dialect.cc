// SPDX-License-Identifier: LGPL-2.1-or-later
#include "table_dialect.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace myolines::scene
{
  namespace
  {
    bool is_comment(const std::string &line)
    {
      const std::size_t first = line.find_first_not_of(" \t");
      return first != std::string::npos && (line[first] == '#' || line[first] == '%');
    }

    /// What may stand before the names: nothing, a comment, or "sep=;", which spreadsheets understand.
    bool is_skipped(const std::string &line)
    {
      const std::string text = trimmed(line);
      return text.empty() || is_comment(text) || (text.rfind("sep=", 0) == 0 && text.size() <= 5);
    }

    std::vector<std::string> fields_of(const std::string &line, const char separator)
    {
      std::vector<std::string> fields{""};
      bool                     quoted = false;
      for (const char c : line)
        {
          quoted = quoted != (c == '"');
          if (!quoted && c == separator)
            fields.emplace_back();
          else
            fields.back() += c;
        }
      return fields;
    }

    /// Whether @p values are as many as @p names, each of them a number or without another one of the separators @p present.
    bool fits(const std::vector<std::string> &names, const std::vector<std::string> &values, const std::string &present)
    {
      return names.size() == values.size() && std::all_of(values.begin(), values.end(), [&](const std::string &value) {
               return value.find_first_of(present) == std::string::npos || value.find('"') != std::string::npos ||
                      with_decimal_point(value);
             });
    }

    std::string words_with_tabs(const std::string &line)
    {
      std::istringstream       stream(line);
      std::vector<std::string> words;
      for (std::string word; stream >> word;)
        words.push_back(word);
      return join(words, "\t");
    }

    /// Comments become empty lines.
    std::string join_lines(const std::vector<std::string> &lines, const std::size_t begin)
    {
      std::string text;
      for (std::size_t i = begin; i < lines.size(); ++i)
        text += (is_comment(lines[i]) ? "" : lines[i]) + "\n";
      return text;
    }

    /// What a line of @p header says after one of @p names: "nRows=12", or, in older files, "datarows 12".
    std::optional<int> announced(const std::vector<std::string> &header, const std::vector<std::string> &names,
                                 const std::filesystem::path &file)
    {
      for (std::size_t i = 0; i < header.size(); ++i)
        {
          const std::size_t end = header[i].find_first_of("= \t");
          if (end == std::string::npos || std::find(names.begin(), names.end(), header[i].substr(0, end)) == names.end())
            continue;
          const std::size_t begin = header[i].find_first_not_of("= \t", end);
          const std::string text  = begin == std::string::npos ? "" : trimmed(header[i].substr(begin));
          const auto        count = parse_integer(text);
          if (!count || *count < 0)
            throw InputError(InputProblem{file.string() + ", line " + std::to_string(i + 1),
                                          "\"" + text + "\" after \"" + header[i].substr(0, end) + "\"", "how many there are", ""});
          return count;
        }
      return std::nullopt;
    }

    char separator_of(const std::string &names, const std::string &values, const std::string &where)
    {
      std::string present, fitting;
      for (const char separator : {',', ';', '\t'})
        if (fields_of(names, separator).size() > 1)
          present += separator;
      for (const char separator : present)
        if (fits(fields_of(names, separator), fields_of(values, separator), present))
          fitting += separator;
      if (present.size() > 1 && fitting.size() != 1)
        throw InputError(InputProblem{where, "the names may be separated by commas, semicolons or tabs: several of them occur",
                                      "one separator, which makes as many values as names", "put names that hold another one in quotes"});
      return present.empty() ? ',' : present.size() == 1 ? present[0] : fitting[0];
    }
  } // namespace

  std::optional<std::string> with_decimal_point(std::string cell)
  {
    const auto comma = cell.find(',');
    if (comma == std::string::npos || cell.find('.') != std::string::npos)
      return std::nullopt;
    cell[comma] = '.';
    return parse_number(cell) ? std::optional<std::string>(cell) : std::nullopt;
  }

  TableText find_table(const std::string &text, const std::filesystem::path &file)
  {
    std::vector<std::string> lines   = lines_of(text);
    std::size_t              begin   = 0;
    bool                     opensim = false;
    for (std::size_t i = 0; i < lines.size() && !opensim; ++i)
      if (trimmed(lines[i]) == "endheader")
        {
          begin   = i + 1;
          opensim = true;
        }
    while (begin < lines.size() && is_skipped(lines[begin]))
      ++begin;
    if (begin == lines.size())
      throw InputError(InputProblem{file.string(), "there is no table in it", "values in columns, with names in the first line", ""});
    const unsigned int number = static_cast<unsigned int>(begin + 1);
    if (opensim && lines[begin].find('\t') == std::string::npos)
      for (std::size_t i = begin; i < lines.size(); ++i)
        lines[i] = words_with_tabs(lines[i]);
    if (opensim)
      {
        const std::vector<std::string> header(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(begin));
        return {join_lines(lines, begin), number, '\t', announced(header, {"nRows", "datarows"}, file),
                announced(header, {"nColumns", "datacolumns"}, file)};
      }
    std::size_t values = begin + 1;
    while (values < lines.size() && (trimmed(lines[values]).empty() || is_comment(lines[values])))
      ++values;
    return {join_lines(lines, begin), number,
            separator_of(lines[begin], values < lines.size() ? lines[values] : "", file.string() + ", line " + std::to_string(number)),
            std::nullopt, std::nullopt};
  }
} // namespace myolines::scene
