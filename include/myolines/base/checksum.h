// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace myolines
{
  /// CRC-32 (ISO 3309, as gzip and PNG have it) of bytes that come piece by piece.
  class Checksum
  {
  public:
    void add(const void *data, std::size_t bytes);                       ///< Goes on with @p bytes bytes at @p data.
    void add(const std::string &text) { add(text.data(), text.size()); } ///< Goes on with the bytes of @p text.

    /// Goes on with @p bytes bytes whose own checksum is @p value.
    void add_part(std::uint32_t value, std::size_t bytes);

    std::uint32_t value() const { return value_; } ///< Of all that was added so far.
    std::string   text() const;                    ///< eight hexadecimal digits

  private:
    std::uint32_t value_ = 0;
  };

  /// Of a whole file, as Checksum::text(). @throws SystemError if it cannot be read.
  std::string checksum_of_file(const std::filesystem::path &file);
} // namespace myolines
