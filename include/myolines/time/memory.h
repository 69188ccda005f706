// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/archive.h>

#include <string>

namespace myolines
{
  /// What a method remembers, told once for both ways: into an archive, and back from it.
  class Memory
  {
  public:
    static Memory into(Archive &archive) { return {&archive, nullptr}; }         ///< a memory that saves
    static Memory out_of(const Archive &archive) { return {nullptr, &archive}; } ///< a memory that loads

    ///@{
    /// Puts the value into the archive, or gives it the one that is there. @throws std::out_of_range if there is none.
    void keep(const std::string &name, double &number)
    {
      if (to_ != nullptr)
        to_->put(name, number);
      else
        number = from_->number(name);
    }

    void keep(const std::string &name, bool &flag)
    {
      double number = flag ? 1 : 0;
      keep(name, number);
      flag = number != 0;
    }

    void keep(const std::string &name, unsigned int &count)
    {
      double number = count;
      keep(name, number);
      count = static_cast<unsigned int>(number);
    }
    ///@}

    /// A vector that has its layout.
    void keep(const std::string &name, Vector &vector)
    {
      if (to_ != nullptr)
        to_->put(name, vector);
      else
        from_->read(name, vector);
    }

  private:
    Memory(Archive *to, const Archive *from)
      : to_(to)
      , from_(from)
    {}

    Archive       *to_;
    const Archive *from_; ///< one of them is there
  };
} // namespace myolines
