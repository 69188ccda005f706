// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/picture/colours.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace myolines::picture
{
  namespace
  {
    constexpr unsigned int viridis[] = {0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6dcd59, 0xb4de2c, 0xfde725};
    constexpr unsigned int diverging[] = {0x2a3f8f, 0x4f7bc0, 0x93b8dd, 0xf2f2f2, 0xe8a38c, 0xc9584f, 0x8c1a2b};
    // flesh, silver and straw for the printed tissues, and colours that tell the scene's own from them and from each other
    constexpr unsigned int tissues[most_tissues] = {0xb8473f, 0xdfe3e8, 0xf1d9a0, 0x4477aa, 0x228833, 0xaa3377, 0x66ccee, 0xccbb44,
                                                    0x332288, 0xee8866, 0x44aa99, 0xddaadd, 0x777777, 0x999933, 0x88aadd};

    Colour of_number(const unsigned int rgb) { return {{(rgb >> 16) / 255., (rgb >> 8 & 255) / 255., (rgb & 255) / 255.}}; }

    template <std::size_t n>
    Colour between(const unsigned int (&colours)[n], const double x)
    {
      const double at    = std::clamp(x, 0., 1.) * (n - 1);
      const auto   first = std::min<std::size_t>(static_cast<std::size_t>(at), n - 2);
      const Colour a = of_number(colours[first]), b = of_number(colours[first + 1]);
      Colour       c;
      for (int i = 0; i < 3; ++i)
        c[i] = a[i] + (at - static_cast<double>(first)) * (b[i] - a[i]);
      return c;
    }
  } // namespace

  std::string hexadecimal(const Colour &colour)
  {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned int>(std::lround(255 * std::clamp(colour[0], 0., 1.))),
                  static_cast<unsigned int>(std::lround(255 * std::clamp(colour[1], 0., 1.))),
                  static_cast<unsigned int>(std::lround(255 * std::clamp(colour[2], 0., 1.))));
    return text;
  }

  Colour colour_of(const ColourMap map, const double x)
  {
    if (map == ColourMap::viridis)
      return between(viridis, x);
    if (map == ColourMap::diverging)
      return between(diverging, x);
    return of_number(tissues[std::min(most_tissues - 1, static_cast<int>(most_tissues * std::clamp(x, 0., 1.)))]);
  }
} // namespace myolines::picture
