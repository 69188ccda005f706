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
    std::vector<Spot>   corners;   ///< going round
    std::vector<double> values;    ///< in [0, 1]; empty: in @p plain
    Colour              plain{};   ///< the colour if there are no values
    double              light = 1; ///< (0, 1]
  };

  /// A straight line, as a facet.
  struct Stroke
  {
    Spot                  a;              ///< one end
    Spot                  b;              ///< the other
    std::array<double, 2> values{};       ///< in [0, 1]
    bool                  mapped = false; ///< whether values are drawn, else @p plain
    Colour                plain{};        ///< the colour if it is not mapped
    double                width = 1;      ///< [px]
  };

  /// What hides what is behind it. Layers cover each other in their order.
  struct Layer
  {
    std::vector<Facet>  facets;      ///< with nothing between them and the viewer but nearer ones
    std::vector<Stroke> strokes;     ///< seen where no facet hides them
    double              opacity = 1; ///< of the facets, of which only the nearest are seen
  };

  /// A text.
  struct Words
  {
    /// Which part of the text is at x.
    enum class Anchor
    {
      left,   ///< its beginning
      middle, ///< its middle
      right   ///< its end
    };
    double      x;                     ///< where the anchor is [px]
    double      y;                     ///< of the base line [px]
    std::string text;                  ///< UTF-8
    double      size   = 14;           ///< [px]
    Anchor      anchor = Anchor::left; ///< of x
  };

  /// A drawing: what is seen of bodies, then flat boxes and words over it.
  struct Sheet
  {
    unsigned int        width  = 0; ///< [px]
    unsigned int        height = 0; ///< [px]
    ColourMap           map;        ///< of all values
    std::vector<Layer>  layers;     ///< from back to front
    std::vector<Facet>  boxes;      ///< nearer than all layers, none over another
    std::vector<Stroke> lines;      ///< over the boxes
    std::vector<Words>  words;      ///< over all
    std::string         title;      ///< for those who cannot see it
  };

  /// Rows of pixels, red, green and blue.
  struct Pixels
  {
    unsigned int              width  = 0; ///< of a row
    unsigned int              height = 0; ///< number of rows
    std::vector<std::uint8_t> rgb;        ///< [height][width][3]
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
