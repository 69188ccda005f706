// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <stdexcept>
#include <string>
#include <utility>

namespace myolines
{
  /// Things of one kind by their names: those that are built in, in a fixed order, then those that plug-ins add. References to entries stay
  /// valid. An Entry has a function `const std::string &name_of(const Entry &)` in its name space.
  template <typename Entry>
  class Registry
  {
  public:
    using value_type = Entry; ///< As containers of the standard library name it.

    /// @p kind is the word for one of them, for messages: "integrator".
    Registry(std::string kind, std::deque<Entry> built_in)
      : kind_(std::move(kind))
      , entries_(std::move(built_in))
    {}
    Registry(const Registry &)            = delete; ///< References to entries stay valid, so there are no copies.
    Registry &operator=(const Registry &) = delete;

    const std::string &kind() const { return kind_; } ///< The word for one of them.

    ///@{
    /// The entries, in their order.
    auto         begin() const { return entries_.begin(); }
    auto         end() const { return entries_.end(); }
    std::size_t  size() const { return entries_.size(); }
    const Entry &operator[](const std::size_t i) const { return entries_[i]; }
    ///@}

    /// nullptr: there is none of that name.
    const Entry *find(const std::string &name) const
    {
      for (const Entry &entry : entries_)
        if (name_of(entry) == name)
          return &entry;
      return nullptr;
    }

    /// @throws std::logic_error if the name is taken.
    void add(Entry entry)
    {
      if (find(name_of(entry)) != nullptr)
        throw std::logic_error("there is a second " + kind_ + " \"" + name_of(entry) + "\"");
      entries_.push_back(std::move(entry));
    }

  private:
    const std::string kind_;
    std::deque<Entry> entries_;
  };
} // namespace myolines
