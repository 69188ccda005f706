// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/cli/prm_file.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::trimmed;

    class PrmReader
    {
    public:
      explicit PrmReader(std::string file)
        : file_(std::move(file))
      {}

      void take(const std::string &text, const unsigned int line)
      {
        const std::string statement = trimmed(text.substr(0, text.find('#')));
        const auto        blank     = statement.find_first_of(" \t");
        const std::string word      = statement.substr(0, blank);
        const std::string rest      = blank == std::string::npos ? "" : trimmed(statement.substr(blank));
        if (statement.empty())
          return;
        if ((word == "subsection" || word == "SUBSECTION") && !rest.empty())
          sections_.push_back(rest);
        else if ((word == "end" || word == "END") && rest.empty() && !sections_.empty())
          sections_.pop_back();
        else if ((word == "set" || word == "SET") && rest.find('=') != std::string::npos)
          set(rest, line);
        else if (word == "include" || word == "INCLUDE")
          problem(line, "\"" + statement + "\": other files are not read", "the lines of that file in its place");
        else
          problem(line, "\"" + statement + "\" is not understood", "subsection NAME, set NAME = VALUE, end, or a comment");
      }

      std::vector<PrmEntry> finish(const unsigned int line)
      {
        if (!sections_.empty())
          problem(line, "the subsection \"" + sections_.back() + "\" is not closed", "end");
        if (!problems_.empty() && entries_.empty())
          throw InputError(InputProblem{file_, "this is no parameter file: nothing is set in it", "lines \"set NAME = VALUE\"",
                                        "line " + std::to_string(first_problem_) + " is not understood"});
        if (!problems_.empty())
          throw InputError(problems_);
        return entries_;
      }

    private:
      void set(const std::string &assignment, const unsigned int line)
      {
        const auto     equals = assignment.find('=');
        const PrmEntry entry{join(sections_, "/"), trimmed(assignment.substr(0, equals)), trimmed(assignment.substr(equals + 1)), line};
        const auto     same = std::find_if(entries_.begin(), entries_.end(),
                                           [&entry](const PrmEntry &e) { return e.section == entry.section && e.name == entry.name; });
        if (same != entries_.end())
          problem(line, "\"" + entry.name + "\" is set again, after line " + std::to_string(same->line), "every entry once");
        entries_.push_back(entry);
      }

      void problem(const unsigned int line, const std::string &what, const std::string &expected)
      {
        if (problems_.empty())
          first_problem_ = line;
        problems_.push_back({file_ + ", line " + std::to_string(line), what, expected, ""});
      }

      std::string               file_;
      std::vector<std::string>  sections_;
      std::vector<PrmEntry>     entries_;
      std::vector<InputProblem> problems_;
      unsigned int              first_problem_ = 0; ///< its line
    };
  } // namespace

  std::vector<PrmEntry> read_prm(const std::filesystem::path &file)
  {
    std::istringstream stream(scene::read_input_text(file));
    PrmReader          reader(file.string());
    unsigned int       line = 0;
    std::string        statement;
    for (std::string text; std::getline(stream, text);)
      {
        ++line;
        text = trimmed(text);
        if (!text.empty() && text.back() == '\\')
          {
            statement += text.substr(0, text.size() - 1) + " ";
            continue;
          }
        reader.take(statement + text, line);
        statement.clear();
      }
    reader.take(statement, line); // the last line may say that it goes on
    return reader.finish(line);
  }

  namespace
  {
    /// Lines of @p file as words, after @p cut has taken what counts of them.
    template <typename Cut>
    std::vector<PrmRow> rows_of(const std::filesystem::path &file, const Cut &cut)
    {
      std::istringstream  stream(scene::read_input_text(file));
      std::vector<PrmRow> rows;
      unsigned int        number = 0;
      for (std::string line; std::getline(stream, line);)
        {
          PrmRow             row{{}, ++number};
          std::istringstream words(cut(line));
          for (std::string word; words >> word;)
            row.words.push_back(word);
          if (!row.words.empty())
            rows.push_back(row);
        }
      return rows;
    }
  } // namespace

  std::vector<PrmRow> read_rows(const std::filesystem::path &file)
  {
    return rows_of(file, [](const std::string &line) { return line.substr(0, line.find('#')); });
  }

  std::vector<PrmRow> read_comments(const std::filesystem::path &file)
  {
    return rows_of(file, [](const std::string &line) { return trimmed(line).substr(0, 1) == "#" ? line : ""; });
  }

  void refuse_odd_row(const std::filesystem::path &file, const PrmRow &row, const std::size_t n_names, const std::size_t n_words,
                      const std::string &expected)
  {
    bool good = row.words.size() == n_words;
    for (std::size_t i = n_names; i < row.words.size(); ++i)
      good = good && scene::parse_number(row.words[i]);
    if (good)
      return;
    const std::string text = join(row.words, " ");
    const std::string hint = text.find_first_of(",;") != std::string::npos ? "numbers are separated by blanks or tabs, decimals by points"
                             : text.find('%') == 0                         ? "comments begin with #"
                                                                           : "";
    throw InputError(
        InputProblem{file.string() + ", line " + std::to_string(row.line), "\"" + text + "\" is not understood", expected, hint});
  }
} // namespace myolines
