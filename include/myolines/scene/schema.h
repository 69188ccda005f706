// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// What the text of a parameter must be.
  enum class Kind
  {
    number,  ///< double; "1e-3"
    integer, ///< "3"
    boolean, ///< "true" / "false"
    text,    ///< any string
    choice,  ///< one of a list of words
    file     ///< path of an existing file, relative to the scene
  };

  /// Interval of admissible numbers; an open end excludes its limit.
  struct Range
  {
    double low       = -std::numeric_limits<double>::infinity(); ///< lower end
    double high      = std::numeric_limits<double>::infinity();  ///< upper end
    bool   low_open  = false;                                    ///< the lower end is excluded
    bool   high_open = false;                                    ///< the upper end is excluded

    bool        contains(double value) const; ///< false for what is not a number
    std::string text() const;                 ///< "> 0", "in [0, 1]", "any finite number"

    static Range any() { return {}; }                                                                  ///< every finite number
    static Range positive() { return {0, std::numeric_limits<double>::infinity(), true, false}; }      ///< > 0
    static Range not_negative() { return {0, std::numeric_limits<double>::infinity(), false, false}; } ///< >= 0
    static Range closed(double low, double high) { return {low, high, false, false}; }                 ///< both ends included
  };

  /// Declaration of one parameter: everything help, validation and the manual need.
  struct Entry
  {
    std::string                name;                ///< as in a scene
    Kind                       kind = Kind::number; ///< what its text must be
    std::optional<std::string> fallback;            ///< text of the default; none: the parameter is required, or optional if so marked
    bool                       optional = false;    ///< may be absent without a default; the code asks Node::has()
    std::string                unit;                ///< "m", "Pa s", "-" for none
    Range                      range;               ///< of numbers and integers
    std::vector<std::string>   choices;             ///< words that a choice may be
    std::string                doc;                 ///< one sentence

    std::string expected() const;    ///< "a number [m] > 0", for messages
    std::string declaration() const; ///< expected() and the default, for help
  };

  /// Declaration of a list of parameters, beside the code that uses them. Adding returns *this, so declarations chain.
  ///
  /// Defaults: std::nullopt makes a parameter required. Declaring a name twice is a programming error (std::logic_error).
  class Schema
  {
  public:
    explicit Schema(std::string doc = ""); ///< @p doc: one sentence

    ///@{
    /// A parameter of the kind of its name, with @p fallback as default and @p doc as its sentence.
    Schema &number(const std::string &name, std::optional<double> fallback, const std::string &unit, Range range, const std::string &doc);
    Schema &integer(const std::string &name, std::optional<int> fallback, Range range, const std::string &doc);
    Schema &boolean(const std::string &name, bool fallback, const std::string &doc);
    Schema &text(const std::string &name, std::optional<std::string> fallback, const std::string &doc);
    Schema &choice(const std::string &name, std::optional<std::string> fallback, std::vector<std::string> choices, const std::string &doc);
    ///@}
    Schema &file(const std::string &name, const std::string &doc); ///< required

    ///@{
    /// As above, but absent when not written: no default, Node::has() tells.
    Schema &optional_number(const std::string &name, const std::string &unit, Range range, const std::string &doc);
    Schema &optional_text(const std::string &name, const std::string &doc);
    Schema &optional_file(const std::string &name, const std::string &doc);
    ///@}

    /// A list inside this list. Present with all its defaults even if the scene does not write it ...
    Schema &section(const std::string &name, Schema schema);
    /// ... or absent unless written (a scene pays nothing for it).
    Schema &optional_section(const std::string &name, Schema schema);

    /// Lists with names of the user's choice, all of one declaration (boundary conditions).
    Schema &named_sections(Schema each);

    /// A choice parameter @p name (usually "type") each of whose values brings further parameters of its own.
    /// A schema has at most one variant; an alternative may have one in turn.
    Schema &variant(const std::string &name, std::optional<std::string> fallback, std::vector<std::pair<std::string, Schema>> alternatives,
                    const std::string &doc);

    const std::string &doc() const { return doc_; } ///< the sentence

    /// This schema, then the alternative its variant selects, then the alternative that one selects, and so on.
    /// @p selected gives the text of a selector ("" if it has none); an unknown selection ends the chain.
    std::vector<const Schema *> chain(const std::function<std::string(const Entry &)> &selected) const;

    // What was declared, in order of declaration; for validation, help and manual.
    /// A list in the list.
    struct Section
    {
      std::string             name;             ///< as in a scene
      std::shared_ptr<Schema> schema;           ///< what it may hold
      bool                    optional = false; ///< absent unless written
    };
    /// A choice that decides which further parameters there are.
    struct Variant
    {
      std::string                                                  selector;     ///< name of the choice Entry
      std::vector<std::pair<std::string, std::shared_ptr<Schema>>> alternatives; ///< the words of the choice, with what each brings
    };
    const std::vector<Entry>      &entries() const { return entries_; }   ///< parameters
    const std::vector<Section>    &sections() const { return sections_; } ///< lists
    const std::shared_ptr<Schema> &named() const { return named_; }       ///< of lists with free names, or nullptr
    const std::optional<Variant>  &variant() const { return variant_; }   ///< or none

  private:
    Schema &add(Entry entry);
    Schema &add_section(const std::string &name, Schema schema, bool optional);
    void    refuse_known(const std::string &name) const;

    std::string             doc_;
    std::vector<Entry>      entries_;
    std::vector<Section>    sections_;
    std::shared_ptr<Schema> named_;
    std::optional<Variant>  variant_;
  };
} // namespace myolines::scene
