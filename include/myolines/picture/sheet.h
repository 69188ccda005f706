// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/colours.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace myolines::picture
{
  /// A place on a sheet: pixels to the right and down from its upper left corner, and nearness to the viewer in pixels.
  using Spot = std::array<double, 3>;

  /// A flat piece: one colour, or a place of the colour map at each corner; darkened by @p light.
  struct Facet
  {
    std::vector<Spot>   corners;
    std::vector<double> values; ///< in [0, 1]; empty: in @p plain
    Colour              plain{};
    double              light = 1; ///< (0, 1]
  };

  /// A straight line, as a facet.
  struct Stroke
  {
    Spot                  a, b;
    std::array<double, 2> values{}; ///< in [0, 1]
    bool                  mapped = false;
    Colour                plain{};
    double                width = 1; ///< [px]
  };

  /// What hides what is behind it. Layers cover each other in their order.
  struct Layer
  {
    std::vector<Facet>  facets;
    std::vector<Stroke> strokes;
    double              opacity = 1; ///< of the facets, of which only the nearest are seen
  };

  struct Words
  {
    enum class Anchor
    {
      left,
      middle,
      right
    };
    double      x, y;        ///< of the base line [px]
    std::string text;        ///< UTF-8
    double      size   = 14; ///< [px]
    Anchor      anchor = Anchor::left;
  };

  /// A drawing: what is seen of bodies, then flat boxes and words over it.
  struct Sheet
  {
    unsigned int        width = 0, height = 0; ///< [px]
    ColourMap           map;
    std::vector<Layer>  layers;
    std::vector<Facet>  boxes; ///< nearer than all layers, none over another
    std::vector<Stroke> lines;
    std::vector<Words>  words;
    std::string         title; ///< for those who cannot see it
  };

  /// Rows of pixels, red, green and blue.
  struct Pixels
  {
    unsigned int              width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
  };

  /// By a z-buffer, with four samples of each pixel.
  Pixels pixels_of(const Sheet &sheet);

  /// The bytes of a PNG.
  std::string png_of(const Pixels &pixels);

  /// An animated PNG of frames of one size, each shown for @p seconds, without end.
  std::string animated_png_of(const std::vector<Pixels> &frames, double seconds);

  /// The same as a drawing of lines: pieces that others hide are left out, the rest stands in the order of depth. Texts are escaped.
  std::string svg_of(const Sheet &sheet);
} // namespace myolines::picture
