// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/checksum.h>
#include <myolines/base/files.h>

#include <algorithm>
#include <cstdio>
#include <zlib.h>

namespace myolines
{
  void Checksum::add(const void *data, std::size_t bytes)
  {
    const auto *next = static_cast<const Bytef *>(data);
    while (bytes > 0)
      {
        const auto part = static_cast<uInt>(std::min<std::size_t>(bytes, 1u << 30)); // what the library counts with
        value_          = static_cast<std::uint32_t>(crc32(value_, next, part));
        next += part;
        bytes -= part;
      }
  }

  void Checksum::add_part(const std::uint32_t value, const std::size_t bytes)
  {
    value_ = static_cast<std::uint32_t>(crc32_combine(value_, value, static_cast<z_off_t>(bytes)));
  }

  std::string Checksum::text() const
  {
    char digits[9];
    std::snprintf(digits, sizeof digits, "%08x", static_cast<unsigned int>(value_));
    return digits;
  }

  std::string checksum_of_file(const std::filesystem::path &file)
  {
    Checksum checksum;
    checksum.add(read_file(file));
    return checksum.text();
  }
} // namespace myolines
