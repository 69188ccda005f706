// SPDX-License-Identifier: LGPL-2.1-or-later
#include "xml_check.h"

#include <cctype>
#include <charconv>

namespace myolines::scene
{
  namespace
  {
    constexpr int deepest = 64; ///< elements in one another

    std::string utf8_of(const unsigned long code)
    {
      const auto tail = [code](const int shift) { return static_cast<char>(0x80 | (code >> shift & 0x3F)); };
      if (code < 0x800)
        return {static_cast<char>(0xC0 | code >> 6), tail(0)};
      if (code < 0x10000)
        return {static_cast<char>(0xE0 | code >> 12), tail(6), tail(0)};
      return {static_cast<char>(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
    }

    /// Goes through the text once; knows comments, instructions, tags and the values in them.
    class Scanner
    {
    public:
      Scanner(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems)
        : xml_(xml)
        , file_(file)
        , problems_(problems)
        , before_(problems.size())
      {
        plain_.reserve(xml.size());
      }

      std::optional<std::string> run()
      {
        while (at_ < xml_.size() && good())
          if (begins_with("<!--"))
            leave_out("-->", "a comment");
          else if (begins_with("<?"))
            leave_out("?>", "an instruction");
          else if (begins_with("<![CDATA["))
            problem("there is a CDATA section", "elements <ParameterList>, <Parameter> and comments", "");
          else if (begins_with("<!"))
            leave_out_document_type();
          else if (xml_[at_] == '<')
            tag();
          else
            keep();
        return good() ? std::optional<std::string>(plain_) : std::nullopt;
      }

    private:
      bool good() const { return problems_.size() == before_; }

      bool begins_with(const char *text) const { return xml_.compare(at_, std::char_traits<char>::length(text), text) == 0; }

      void keep()
      {
        const char c = xml_[at_];
        if (is_control(c))
          return problem("there is a control character, number " + std::to_string(static_cast<int>(c)), "text", "remove it");
        plain_ += c;
        line_ += c == '\n' ? 1 : 0;
        ++at_;
      }

      /// Passes @p n bytes; lines stay.
      void blank(const std::size_t n)
      {
        for (const std::size_t end = at_ + n; at_ < end; ++at_)
          {
            plain_ += xml_[at_] == '\n' ? '\n' : ' ';
            line_ += xml_[at_] == '\n' ? 1 : 0;
          }
      }

      void leave_out(const std::string &end, const std::string &what)
      {
        const std::size_t found = xml_.find(end, at_ + 2);
        if (found == std::string::npos)
          return problem(what + " begins there that has no end", end, "");
        blank(found + end.size() - at_);
      }

      /// With what stands in brackets: declarations of entities, which are not read.
      void leave_out_document_type()
      {
        int         brackets = 0;
        std::size_t end      = at_;
        while (end < xml_.size() && (xml_[end] != '>' || brackets > 0))
          {
            brackets += xml_[end] == '[' ? 1 : xml_[end] == ']' ? -1 : 0;
            ++end;
          }
        if (end == xml_.size())
          return problem("a declaration begins there that has no end", ">", "");
        blank(end + 1 - at_);
      }

      void tag()
      {
        const bool closes = begins_with("</");
        while (at_ < xml_.size() && xml_[at_] != '>' && good())
          {
            const char c = xml_[at_];
            keep();
            if (c == '"' || c == '\'')
              value(c);
          }
        const bool empty = at_ > 0 && at_ < xml_.size() && xml_[at_ - 1] == '/';
        depth_ += closes ? -1 : empty ? 0 : 1;
        if (depth_ > deepest)
          problem("more than " + std::to_string(deepest) + " elements stand in one another", "lists a few levels deep", "");
        if (at_ < xml_.size() && good())
          keep();
      }

      void value(const char quote)
      {
        while (at_ < xml_.size() && xml_[at_] != quote && good())
          if (xml_[at_] == '<')
            problem("there is a bare < in a value", "in XML, < is written &lt; and & is written &amp;",
                    "write &lt;, also in formulas: \"x &lt; 0.015\"; or a closing quote is missing before it");
          else if (xml_[at_] == '&')
            entity();
          else
            keep();
        if (at_ < xml_.size() && good())
          keep();
      }

      /// "&lt;", "&#228;" or the like.
      void entity()
      {
        for (const char *name : {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"})
          if (begins_with(name))
            return keep();
        std::size_t end = at_ + 1;
        while (end < xml_.size() && (xml_[end] == '#' || std::isalnum(static_cast<unsigned char>(xml_[end]))))
          ++end;
        if (end == at_ + 1 || end == xml_.size() || xml_[end] != ';')
          return problem("there is a bare & in a value", "in XML, & is written &amp; and < is written &lt;",
                         "write &amp;, also in formulas: \"x > 0 &amp;&amp; y > 0\"");
        const std::string name = xml_.substr(at_ + 1, end - at_ - 1);
        const auto        code = character(name);
        if (!code)
          return problem("\"&" + name + ";\" stands for no character that is known",
                         "&lt; &gt; &amp; &quot; &apos; or the number of a character, such as &#228;",
                         "write the character itself, in UTF-8");
        if (*code < 0x80)
          return keep();
        plain_ += utf8_of(*code);
        at_ = end + 1;
      }

      /// "#228" or "#xE4"; nothing for what is no character of XML.
      static std::optional<unsigned long> character(const std::string &name)
      {
        if (name[0] != '#')
          return std::nullopt;
        const bool        hexadecimal = name.size() > 1 && name[1] == 'x';
        const char *const begin = name.data() + (hexadecimal ? 2 : 1), *const end = name.data() + name.size();
        unsigned long code   = 0;
        const auto    result = std::from_chars(begin, end, code, hexadecimal ? 16 : 10);
        const bool    whole  = result.ec == std::errc() && result.ptr == end;
        const bool valid = !(code < 0x80 && is_control(static_cast<char>(code))) && !(code >= 0xD800 && code < 0xE000) && code < 0x110000;
        return whole && valid ? std::optional<unsigned long>(code) : std::nullopt;
      }

      void problem(const std::string &what, const std::string &expected, const std::string &hint)
      {
        problems_.push_back({file_ + ", line " + std::to_string(line_), what, expected, hint});
      }

      const std::string         &xml_;
      const std::string         &file_;
      std::vector<InputProblem> &problems_;
      std::size_t                before_;
      std::string                plain_;
      std::size_t                at_    = 0;
      unsigned int               line_  = 1;
      int                        depth_ = 0;
    };
  } // namespace

  std::optional<std::string> plain_xml(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems)
  {
    return Scanner(xml, file, problems).run();
  }
} // namespace myolines::scene
