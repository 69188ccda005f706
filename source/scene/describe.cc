// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/scene.h>

#include <sstream>

namespace myolines::scene
{
  namespace
  {
    class Description
    {
    public:
      void schema(const Schema &schema, const int indent)
      {
        for (const Entry &entry : schema.entries())
          {
            line(entry.name + "  (" + entry.declaration() + ")", indent);
            line(entry.doc, indent + 4);
            if (schema.variant() && schema.variant()->selector == entry.name)
              for (const auto &[name, alternative] : schema.variant()->alternatives)
                {
                  line(entry.name + " = " + name + ": " + alternative->doc(), indent + 2);
                  this->schema(*alternative, indent + 4);
                }
          }
        for (const Schema::Section &section : schema.sections())
          list(section.name + (section.optional ? "/  (optional)  " : "/  "), *section.schema, indent);
        if (schema.named() != nullptr)
          list("<name of your choice>/  ", *schema.named(), indent);
      }

      std::string text() const { return out_.str(); }

    private:
      void list(const std::string &title, const Schema &contents, const int indent)
      {
        line(title + contents.doc(), indent);
        schema(contents, indent + 2);
      }

      void line(const std::string &text, const int indent) { out_ << std::string(indent, ' ') << text << '\n'; }

      std::ostringstream out_;
    };
  } // namespace

  std::string describe(const Schema &schema, const int indent)
  {
    Description description;
    description.schema(schema, indent);
    return description.text();
  }
} // namespace myolines::scene
