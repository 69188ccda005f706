// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/scene/markdown.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines::scene
{
  namespace
  {
    std::string admitted(const Entry &entry)
    {
      switch (entry.kind)
        {
        case Kind::number:
          return markdown_text(entry.range.text());
        case Kind::integer:
          return entry.range.text() == Range::any().text() ? "integer" : "integer " + markdown_text(entry.range.text());
        case Kind::boolean:
          return "`true`, `false`";
        case Kind::choice:
          {
            std::vector<std::string> codes;
            for (const std::string &choice : entry.choices)
              codes.push_back(markdown_code(choice));
            return join(codes);
          }
        case Kind::file:
          return "path of a file, relative to the scene";
        case Kind::text:
          break;
        }
      return "text";
    }

    /// One is the first number that people try; where it is not admitted, one between the limits or beside the only one.
    double number_within(const Range &range)
    {
      if (range.contains(1))
        return 1;
      if (!std::isfinite(range.high))
        return 2 * range.low + (range.low == 0);
      return std::isfinite(range.low) ? (range.low + range.high) / 2 : range.high - std::abs(range.high) - 1;
    }

    /// The last words in quotes of the sentence of a declaration, which are an example there.
    std::string quoted_in(const std::string &doc)
    {
      const std::size_t end = doc.rfind('"'), begin = end == std::string::npos || end == 0 ? end : doc.rfind('"', end - 1);
      return begin == std::string::npos || begin == end ? "" : doc.substr(begin + 1, end - begin - 1);
    }

    std::string example_value(const Entry &entry)
    {
      if (const std::string quoted = quoted_in(entry.doc); entry.kind == Kind::text && !quoted.empty())
        return quoted;
      if (entry.fallback && !entry.fallback->empty())
        return *entry.fallback;
      switch (entry.kind)
        {
        case Kind::number:
          return format_number(number_within(entry.range));
        case Kind::integer:
          return format_number(std::ceil(number_within(entry.range)));
        case Kind::choice:
          return entry.choices.front();
        case Kind::file:
          return "data/file.csv";
        default:
          return "";
        }
    }

    class Tables
    {
    public:
      explicit Tables(const Elsewhere &elsewhere)
        : elsewhere_(elsewhere)
      {}

      void schema(const Schema &schema, const std::string &path)
      {
        entries(schema);
        if (schema.variant())
          for (const auto &[name, alternative] : schema.variant()->alternatives)
            list(markdown_code(path + schema.variant()->selector + " = " + name), *alternative, path);
        for (const Schema::Section &section : schema.sections())
          list(markdown_code(path + section.name + "/") + (section.optional ? " (optional list)" : ""), *section.schema,
               path + section.name + "/");
        if (schema.named() != nullptr)
          list(markdown_code(path + "NAME/") + " (lists with names of your choice)", *schema.named(), path + "NAME/");
      }

      std::string text() const { return out_.str(); }

    private:
      void entries(const Schema &schema)
      {
        if (schema.entries().empty())
          return;
        out_ << "| parameter | meaning | unit | values | default | example |\n|---|---|---|---|---|---|\n";
        for (const Entry &entry : schema.entries())
          {
            const std::string none = entry.optional ? "none" : "required", value = example_value(entry);
            out_ << "| " << markdown_code(entry.name) << " | " << markdown_text(entry.doc) << " | "
                 << (entry.unit.empty() ? "" : markdown_text(entry.unit)) << " | " << admitted(entry) << " | "
                 << (entry.fallback ? entry.fallback->empty() ? "empty" : markdown_code(*entry.fallback) : none) << " | "
                 << (value.empty() ? "" : markdown_code(value)) << " |\n";
          }
        out_ << "\n";
      }

      void list(const std::string &title, const Schema &contents, const std::string &path)
      {
        const std::string other = elsewhere_(contents);
        out_ << "**" << title << "** " << markdown_text(contents.doc()) << (other.empty() ? "" : " " + other) << "\n\n";
        if (other.empty())
          schema(contents, path);
      }

      const Elsewhere   &elsewhere_;
      std::ostringstream out_;
    };
  } // namespace

  std::string markdown_text(const std::string &text)
  {
    const bool  has_code = std::count(text.begin(), text.end(), '`') % 2 == 0;
    bool        in_code  = false; // a bar ends a cell there too; nothing else is markup
    std::string escaped;
    for (const char c : text)
      {
        in_code ^= has_code && c == '`';
        const bool markup = std::string(in_code ? "|" : "\\*_$|[]~").find(c) != std::string::npos || (c == '`' && !has_code);
        escaped += markup ? std::string("\\") + c : !in_code && c == '<' ? "&lt;" : !in_code && c == '>' ? "&gt;" : std::string(1, c);
      }
    return escaped;
  }

  std::string markdown_code(const std::string &text)
  {
    std::string code;
    for (const char c : text)
      code += c == '|' ? "\\|" : std::string(1, c);
    return "`" + code + "`";
  }

  std::string markdown(const Schema &schema, const std::string &path, const Elsewhere &elsewhere)
  {
    Tables tables(elsewhere);
    tables.schema(schema, path);
    return tables.text();
  }
} // namespace myolines::scene
