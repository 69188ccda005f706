// SPDX-License-Identifier: LGPL-2.1-or-later
#include "xml_check.h"

#include <cctype>

namespace myolines::scene
{
  namespace
  {
    constexpr int deepest = 64; ///< elements in one another

    /// Goes through the text once; knows comments, instructions, tags and the values in them.
    class Scanner
    {
    public:
      Scanner(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems)
        : xml_(xml)
        , file_(file)
        , problems_(problems)
      {}

      bool run()
      {
        const std::size_t before = problems_.size();
        while (at_ < xml_.size() && problems_.size() == before)
          if (begins_with("<!--"))
            skip_past("-->");
          else if (begins_with("<?"))
            skip_past("?>");
          else if (begins_with("<!"))
            skip_past(">");
          else if (xml_[at_] == '<')
            tag();
          else
            step();
        return problems_.size() == before;
      }

    private:
      bool begins_with(const char *text) const { return xml_.compare(at_, std::char_traits<char>::length(text), text) == 0; }

      void step() { line_ += xml_[at_++] == '\n' ? 1 : 0; }

      void skip_past(const char *end)
      {
        while (at_ < xml_.size() && !begins_with(end))
          step();
        at_ += std::char_traits<char>::length(end);
      }

      void tag()
      {
        const bool closes = begins_with("</");
        while (at_ < xml_.size() && xml_[at_] != '>')
          {
            const char c = xml_[at_];
            step();
            if (c == '"' || c == '\'')
              value(c);
          }
        const bool empty = at_ > 0 && at_ < xml_.size() && xml_[at_ - 1] == '/';
        depth_ += closes ? -1 : empty ? 0 : 1;
        if (depth_ > deepest)
          problem("more than " + std::to_string(deepest) + " elements stand in one another", "lists a few levels deep", "");
        if (at_ < xml_.size())
          step();
      }

      void value(const char quote)
      {
        const std::size_t before = problems_.size();
        while (at_ < xml_.size() && xml_[at_] != quote && problems_.size() == before)
          {
            if (xml_[at_] == '<')
              problem("there is a bare < in a value", "in XML, < is written &lt; and & is written &amp;",
                      "write &lt;, also in formulas: \"x &lt; 0.015\"; or a closing quote is missing before it");
            else if (xml_[at_] == '&' && !entity())
              problem("there is a bare & in a value", "in XML, & is written &amp; and < is written &lt;",
                      "write &amp;, also in formulas: \"x > 0 &amp;&amp; y > 0\"");
            step();
          }
        if (at_ < xml_.size())
          step();
      }

      /// Whether "&lt;", "&#65;" or the like stands here.
      bool entity() const
      {
        for (const char *name : {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"})
          if (begins_with(name))
            return true;
        std::size_t i = at_ + 1;
        if (i < xml_.size() && xml_[i] == '#')
          do
            ++i;
          while (i < xml_.size() && std::isalnum(static_cast<unsigned char>(xml_[i])));
        return i > at_ + 2 && i < xml_.size() && xml_[i] == ';';
      }

      void problem(const std::string &what, const std::string &expected, const std::string &hint)
      {
        problems_.push_back({file_ + ", line " + std::to_string(line_), what, expected, hint});
      }

      const std::string         &xml_;
      const std::string         &file_;
      std::vector<InputProblem> &problems_;
      std::size_t                at_    = 0;
      unsigned int               line_  = 1;
      int                        depth_ = 0;
    };
  } // namespace

  bool check_xml(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems)
  {
    return Scanner(xml, file, problems).run();
  }
} // namespace myolines::scene
