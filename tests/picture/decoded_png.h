// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/sheet.h>

#include <gtest/gtest.h>

#include <string>
#include <zlib.h>

namespace myolines::test
{
  inline std::uint32_t big_endian(const std::string &bytes, const std::size_t at)
  {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
      number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
  }

  /// Reads the PNG of a picture of 8 bits, red, green and blue, as the standard says; checks every chunk.
  inline picture::Pixels decoded(const std::string &png)
  {
    picture::Pixels pixels;
    std::string     packed;
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    for (std::size_t at = 8; at < png.size();)
      {
        const std::size_t length = big_endian(png, at);
        const std::string name = png.substr(at + 4, 4), data = png.substr(at + 8, length);
        EXPECT_EQ(big_endian(png, at + 8 + length),
                  crc32(0, reinterpret_cast<const Bytef *>(png.data() + at + 4), static_cast<uInt>(length + 4)));
        if (name == "IHDR")
          {
            pixels.width  = big_endian(data, 0);
            pixels.height = big_endian(data, 4);
            EXPECT_EQ(data.substr(8), std::string("\x08\x02\0\0\0", 5));
          }
        if (name == "IDAT")
          packed += data;
        at += length + 12;
      }
    const std::size_t row  = 3 * pixels.width;
    uLongf            size = (row + 1) * pixels.height;
    std::string       rows(size, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(rows.data()), &size, reinterpret_cast<const Bytef *>(packed.data()), packed.size()),
              Z_OK);
    pixels.rgb.resize(row * pixels.height);
    for (std::size_t y = 0; y < pixels.height; ++y)
      for (std::size_t x = 0; x < row; ++x)
        {
          const char         filter = rows[y * (row + 1)];
          const std::uint8_t left = x < 3 ? 0 : pixels.rgb[y * row + x - 3], above = y == 0 ? 0 : pixels.rgb[(y - 1) * row + x];
          pixels.rgb[y * row + x] = static_cast<std::uint8_t>(rows[y * (row + 1) + 1 + x] + (filter == 1 ? left : filter == 2 ? above : 0));
        }
    return pixels;
  }
} // namespace myolines::test
