// SPDX-License-Identifier: LGPL-2.1-or-later
#include "table_dialect.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cctype>
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

    /// The last line of the header of a file of OpenSim, in any case of letters.
    bool is_end_of_header(const std::string &line)
    {
      std::string text = trimmed(line);
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return text == "endheader";
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

    /// The header of a file of OpenSim: lines "nRows=12" or, in older files, "datarows 12".
    class Header
    {
    public:
      Header(std::vector<std::string> lines, const std::filesystem::path &file)
        : lines_(std::move(lines))
        , file_(file)
      {}

      /// The number behind one of @p names.
      std::optional<int> count(const std::vector<std::string> &names) const
      {
        const auto found = find(names);
        const auto n     = found ? parse_integer(found->text) : std::nullopt;
        if (found && (!n || *n < 0))
          refuse(*found, "how many there are");
        return n;
      }

      std::optional<bool> in_degrees() const
      {
        const auto found = find({"inDegrees"});
        if (!found)
          return std::nullopt;
        if (found->text != "yes" && found->text != "no")
          refuse(*found, "yes or no");
        return found->text == "yes";
      }

    private:
      struct Found
      {
        std::size_t line;
        std::string name, text;
      };

      std::optional<Found> find(const std::vector<std::string> &names) const
      {
        for (std::size_t i = 0; i < lines_.size(); ++i)
          {
            const std::size_t end  = std::min(lines_[i].find_first_of("= \t\r"), lines_[i].size());
            const std::string name = lines_[i].substr(0, end);
            if (std::find(names.begin(), names.end(), name) == names.end() || end == lines_[i].size())
              continue;
            const std::size_t begin = lines_[i].find_first_not_of("= \t", end);
            return Found{i + 1, name, begin == std::string::npos ? "" : trimmed(lines_[i].substr(begin))};
          }
        return std::nullopt;
      }

      [[noreturn]] void refuse(const Found &found, const std::string &expected) const
      {
        throw InputError(InputProblem{file_.string() + ", line " + std::to_string(found.line),
                                      "\"" + found.text + "\" after \"" + found.name + "\"", expected, ""});
      }

      std::vector<std::string>     lines_;
      const std::filesystem::path &file_;
    };

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
      if (is_end_of_header(lines[i]))
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
        const Header header({lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(begin)}, file);
        return {join_lines(lines, begin), number, '\t', header.count({"nRows", "datarows"}), header.count({"nColumns", "datacolumns"}),
                header.in_degrees()};
      }
    std::size_t values = begin + 1;
    while (values < lines.size() && (trimmed(lines[values]).empty() || is_comment(lines[values])))
      ++values;
    return {join_lines(lines, begin),
            number,
            separator_of(lines[begin], values < lines.size() ? lines[values] : "", file.string() + ", line " + std::to_string(number)),
            {},
            {},
            {}};
  }
} // namespace myolines::scene
