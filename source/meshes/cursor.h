// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace myolines
{
  /// A place in the bytes of a file, which goes on as they are read. Complaints name the file, and the line or, among numbers in binary,
  /// the byte.
  class Cursor
  {
  public:
    Cursor(const std::filesystem::path &file, std::string_view bytes)
      : file_(file)
      , bytes_(bytes)
    {}

    bool binary  = false; ///< whether numbers are bytes
    bool swapped = false; ///< whether their bytes come in the other order

    std::string_view bytes() const { return bytes_; }
    std::size_t      at() const { return at_; }
    std::size_t      left() const { return bytes_.size() - at_; }
    void             go_to(const std::size_t at) { at_ = std::min(at, bytes_.size()); }

    std::string_view word();      ///< up to the next white space; "" at the end
    std::string_view line();      ///< up to the end of the line, without it and without a carriage return; passes it
    std::string_view peek_word(); ///< word(), which is read again

    // The next number, as text or as bytes. @p what for complaints: "a coordinate".
    double       number(const std::string &what);        ///< finite
    std::int64_t integer(const std::string &what);       ///< in binary of 4 bytes
    std::int64_t large_integer(const std::string &what); ///< in binary of 8 bytes

    /// A number of things that take @p bytes each, at least. @throws if the rest of the file cannot hold them: nothing larger is ever
    /// asked of the memory.
    std::size_t count(std::int64_t announced, std::size_t bytes, const std::string &things) const;

    template <typename T>
    T raw(const std::string &what)
    {
      char bytes[sizeof(T)];
      if (left() < sizeof(T))
        refuse("the file ends within " + what, "the whole file");
      std::memcpy(bytes, bytes_.data() + at_, sizeof(T));
      if (swapped)
        std::reverse(bytes, bytes + sizeof(T));
      at_ += sizeof(T);
      T value;
      std::memcpy(&value, bytes, sizeof(T));
      return value;
    }

    [[noreturn]] void refuse(const std::string &what, const std::string &expected, const std::string &hint = "") const;

  private:
    std::int64_t text_integer(const std::string &what);

    const std::filesystem::path &file_;
    std::string_view             bytes_;
    std::size_t                  at_ = 0;
  };

  /// The number that a whole word spells, its exponent behind e, E, d or D; not a number if it spells none.
  double number_of(std::string_view word);
} // namespace myolines
