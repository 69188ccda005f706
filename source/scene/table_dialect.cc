#include "table_dialect.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>

#include <sstream>
#include <vector>

namespace myolines::scene
{
  namespace
  {
    std::vector<std::string> lines_of(const std::string &text)
    {
      std::vector<std::string> lines;
      std::istringstream       stream(text);
      for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
      return lines;
    }

    bool is_skipped(const std::string &line)
    {
      const std::string text = trimmed(line);
      return text.empty() || text[0] == '#' || text[0] == '%';
    }

    std::size_t n_fields(const std::string &line, const char separator)
    {
      std::size_t n      = 1;
      bool        quoted = false;
      for (const char c : line)
        {
          quoted = quoted != (c == '"');
          n += !quoted && c == separator ? 1 : 0;
        }
      return n;
    }

    std::string words_with_tabs(const std::string &line)
    {
      std::istringstream       stream(line);
      std::vector<std::string> words;
      for (std::string word; stream >> word;)
        words.push_back(word);
      return join(words, "\t");
    }

    std::string join_lines(const std::vector<std::string> &lines, const std::size_t begin)
    {
      std::string text;
      for (std::size_t i = begin; i < lines.size(); ++i)
        text += lines[i] + "\n";
      return text;
    }

    char separator_of(const std::string &names, const std::string &values, const std::string &where)
    {
      std::string present, fitting;
      for (const char separator : {',', ';', '\t'})
        if (n_fields(names, separator) > 1)
          {
            present += separator;
            if (n_fields(names, separator) == n_fields(values, separator))
              fitting += separator;
          }
      if (present.size() > 1 && fitting.size() != 1)
        throw InputError(InputProblem{where, "the names may be separated by commas, semicolons or tabs: several of them occur",
                                      "one separator, which makes as many values as names", "put names that hold another one in quotes"});
      return present.empty() ? ',' : present.size() == 1 ? present[0] : fitting[0];
    }
  } // namespace

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
      return {join_lines(lines, begin), number, '\t'};
    std::size_t values = begin + 1;
    while (values < lines.size() && trimmed(lines[values]).empty())
      ++values;
    return {join_lines(lines, begin), number,
            separator_of(lines[begin], values < lines.size() ? lines[values] : "", file.string() + ", line " + std::to_string(number))};
  }
} // namespace myolines::scene
