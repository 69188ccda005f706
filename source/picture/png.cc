// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/picture/sheet.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <zlib.h>

namespace myolines::picture
{
  namespace
  {
    // Portable Network Graphics, third edition, https://www.w3.org/TR/png-3/, which has animations too.

    void put(std::string &bytes, const std::uint32_t number, const int n)
    {
      for (int i = n - 1; i >= 0; --i)
        bytes += static_cast<char>(number >> 8 * i & 0xFF);
    }

    std::string chunk(const std::string &name, const std::string &data)
    {
      std::string bytes;
      put(bytes, static_cast<std::uint32_t>(data.size()), 4);
      Checksum checksum;
      checksum.add(name);
      checksum.add(data);
      bytes += name + data;
      put(bytes, checksum.value(), 4);
      return bytes;
    }

    /// Each row as differences to the row above (filter 2) or to the pixel before (1), whichever are smaller.
    std::string filtered(const Pixels &pixels)
    {
      const std::size_t row = 3 * static_cast<std::size_t>(pixels.width);
      std::string       bytes;
      bytes.reserve((row + 1) * pixels.height);
      for (std::size_t y = 0; y < pixels.height; ++y)
        {
          const std::uint8_t *now = pixels.rgb.data() + y * row, *above = y > 0 ? now - row : nullptr;
          std::string         left(1, '\1'), up(1, '\2');
          long                size_left = 0, size_up = 0;
          for (std::size_t x = 0; x < row; ++x)
            {
              const auto a = static_cast<signed char>(now[x] - (x < 3 ? 0 : now[x - 3]));
              const auto b = static_cast<signed char>(now[x] - (above == nullptr ? 0 : above[x]));
              size_left += std::abs(static_cast<int>(a));
              size_up += std::abs(static_cast<int>(b));
              left += static_cast<char>(a);
              up += static_cast<char>(b);
            }
          bytes += size_left < size_up ? left : up;
        }
      return bytes;
    }

    std::string compressed(const std::string &bytes)
    {
      uLongf      size = compressBound(bytes.size());
      std::string small(size, '\0');
      if (compress2(reinterpret_cast<Bytef *>(small.data()), &size, reinterpret_cast<const Bytef *>(bytes.data()), bytes.size(), 9) != Z_OK)
        throw SystemError("zlib cannot compress a picture");
      small.resize(size);
      return small;
    }

    const char *const signature = "\x89PNG\r\n\x1a\n";

    std::string head(const Pixels &pixels)
    {
      std::string data;
      put(data, pixels.width, 4);
      put(data, pixels.height, 4);
      put(data, 8, 1); // bits
      put(data, 2, 1); // red, green and blue
      put(data, 0, 3);
      return signature + chunk("IHDR", data);
    }
  } // namespace

  std::string png_of(const Pixels &pixels) { return head(pixels) + chunk("IDAT", compressed(filtered(pixels))) + chunk("IEND", ""); }

  std::string animated_png_of(const std::vector<Pixels> &frames, const double seconds)
  {
    std::string control;
    put(control, static_cast<std::uint32_t>(frames.size()), 4);
    put(control, 0, 4);
    std::string   bytes    = head(frames.front()) + chunk("acTL", control);
    std::uint32_t sequence = 0;
    for (const Pixels &frame : frames)
      {
        std::string data;
        put(data, sequence++, 4);
        put(data, frame.width, 4);
        put(data, frame.height, 4);
        put(data, 0, 4);
        put(data, 0, 4);
        put(data, static_cast<std::uint32_t>(std::lround(std::clamp(1000 * seconds, 1., 60000.))), 2);
        put(data, 1000, 2);
        put(data, 0, 2);
        bytes += chunk("fcTL", data);
        if (&frame == &frames.front())
          bytes += chunk("IDAT", compressed(filtered(frame)));
        else
          {
            std::string numbered;
            put(numbered, sequence++, 4);
            bytes += chunk("fdAT", numbered + compressed(filtered(frame)));
          }
      }
    return bytes + chunk("IEND", "");
  }
} // namespace myolines::picture
