// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: what is nearer hides what is behind it, whatever the order; a PNG holds the pixels; texts of others are no markup.

#include "bodies.h"
#include "decoded_png.h"

#include <myolines/base/error.h>
#include <myolines/picture/figure.h>

#include <gtest/gtest.h>

#include <cmath>

namespace myolines::picture
{

  namespace
  {
    Facet square(const double from, const double to, const double depth, const Colour &colour)
    {
      Facet facet;
      facet.corners = {{{from, from, depth}}, {{to, from, depth}}, {{to, to, depth}}, {{from, to, depth}}};
      facet.plain   = colour;
      return facet;
    }

    Sheet empty_sheet(const unsigned int size)
    {
      Sheet sheet;
      sheet.width = sheet.height = size;
      sheet.map                  = ColourMap::viridis;
      sheet.layers.resize(1);
      return sheet;
    }

    std::array<int, 3> pixel(const Pixels &pixels, const std::size_t x, const std::size_t y)
    {
      const std::uint8_t *p = pixels.rgb.data() + 3 * (y * pixels.width + x);
      return {{p[0], p[1], p[2]}};
    }

    std::size_t count(const std::string &text, const std::string &what)
    {
      std::size_t n = 0;
      for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++n;
      return n;
    }
  } // namespace

  TEST(Drawing, WhatIsNearerHidesWhatIsBehind)
  {
    const Facet far = square(10, 90, 0, {{1, 0, 0}}), near = square(40, 60, 5, {{0, 0, 1}});
    for (const bool swapped : {false, true})
      {
        Sheet sheet            = empty_sheet(100);
        sheet.layers[0].facets = swapped ? std::vector<Facet>{near, far} : std::vector<Facet>{far, near};
        const Pixels pixels    = pixels_of(sheet);
        EXPECT_EQ(pixel(pixels, 50, 50), (std::array<int, 3>{{0, 0, 255}}));
        EXPECT_EQ(pixel(pixels, 20, 20), (std::array<int, 3>{{255, 0, 0}}));
        EXPECT_EQ(pixel(pixels, 5, 5), (std::array<int, 3>{{255, 255, 255}}));
        const std::string svg = svg_of(sheet);
        EXPECT_LT(svg.find("#ff0000"), svg.find("#0000ff")) << "painted from behind";
      }
    Sheet hidden            = empty_sheet(100);
    hidden.layers[0].facets = {square(10, 90, 5, {{1, 0, 0}}), square(40, 60, -5, {{0, 0, 1}})};
    EXPECT_EQ(svg_of(hidden).find("#0000ff"), std::string::npos) << "left out, as nobody sees it";
  }

  TEST(Drawing, LinesBehindAreHidden)
  {
    Sheet sheet            = empty_sheet(100);
    sheet.layers[0].facets = {square(0, 50, 0, {{1, 1, 0}})};
    Stroke behind{{{10, 25, -20}}, {{90, 25, -20}}};
    behind.width            = 4;
    sheet.layers[0].strokes = {behind};
    const Pixels pixels     = pixels_of(sheet);
    EXPECT_EQ(pixel(pixels, 30, 25), (std::array<int, 3>{{255, 255, 0}}));
    EXPECT_EQ(pixel(pixels, 70, 25), (std::array<int, 3>{{0, 0, 0}}));
  }

  TEST(Drawing, AVeilLetsThrough)
  {
    Sheet sheet = empty_sheet(100);
    sheet.layers.resize(2);
    sheet.layers[0].facets  = {square(10, 90, 0, {{0, 0, 0}})};
    sheet.layers[1].facets  = {square(30, 70, 9, {{1, 1, 1}}), square(35, 65, 5, {{1, 0, 0}})};
    sheet.layers[1].opacity = 0.5;
    EXPECT_NEAR(pixel(pixels_of(sheet), 50, 50)[1], 128, 1) << "the nearest piece of the veil, once";
  }

  TEST(Drawing, ThePngHoldsThePixels)
  {
    Pixels pixels{37, 21, {}};
    for (std::size_t i = 0; i < 3 * 37 * 21; ++i)
      pixels.rgb.push_back(static_cast<std::uint8_t>(i * i / 7 + 13 * i));
    const Pixels back = test::decoded(png_of(pixels));
    EXPECT_EQ(back.width, 37u);
    EXPECT_EQ(back.rgb, pixels.rgb);
    const std::string animated = animated_png_of({pixels, pixels, pixels}, 0.1);
    EXPECT_EQ(test::decoded(animated).rgb, pixels.rgb) << "programs without animations show the first";
    EXPECT_EQ(count(animated, "fcTL"), 3u);
    EXPECT_EQ(count(animated, "fdAT"), 2u);
  }

  TEST(Drawing, ColoursRunFromDarkToLight)
  {
    double before = -1;
    for (int i = 0; i <= 100; ++i)
      {
        const Colour c     = colour_of(ColourMap::viridis, i / 100.);
        const double light = 0.2126 * std::pow(c[0], 2.2) + 0.7152 * std::pow(c[1], 2.2) + 0.0722 * std::pow(c[2], 2.2);
        EXPECT_GT(light, before);
        before = light;
      }
    EXPECT_EQ(hexadecimal(colour_of(ColourMap::viridis, 0)), "#440154");
    EXPECT_EQ(hexadecimal(colour_of(ColourMap::viridis, 7)), "#fde725") << "beyond the ends: the ends";
  }

  TEST(Figure, TextsAreNoMarkup)
  {
    Body body = test::block(2, 1, 1, test::same);
    test::add_field(body, "<script>\"&'", [](const Vec &x) { return x[0]; });
    Style style;
    style.field                     = "<script>\"&'";
    const std::vector<Panel> panels = {{"</text><script>alert(1)</script>", std::make_shared<const Body>(body), {}}};
    const std::string        svg    = svg_of(sheet_of(panels, style, frame_of(panels, style)));
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    EXPECT_NE(svg.find("&lt;script&gt;&quot;&amp;&#39;"), std::string::npos);
  }

  TEST(Figure, ShowsTheValuesOfTheField)
  {
    Body body = test::block(6, 4, 2, test::same);
    test::add_field(body, "x", [](const Vec &x) { return x[0]; });
    Style style;
    style.field                     = "x";
    style.azimuth                   = 0;
    style.elevation                 = 0;
    const std::vector<Panel> panels = {{"", std::make_shared<const Body>(body), {}}};
    const Sheet              sheet  = sheet_of(panels, style, frame_of(panels, style));
    const Pixels             pixels = pixels_of(sheet);
    // Seen from -y the block lies across: dark at the left, light at the right.
    const std::size_t middle = pixels.height / 2;
    EXPECT_LT(pixel(pixels, 60, middle)[1], 100);
    EXPECT_GT(pixel(pixels, 950, middle)[1], 120);
    EXPECT_EQ(pixel(pixels, 5, middle), (std::array<int, 3>{{255, 255, 255}})) << "nothing beside it";
    EXPECT_THROW(frame_of(panels, Style{"no such field", {}, {}, 0, 0, 800}), InputError);
  }

  TEST(Figure, FieldsThatAreNotDefinedAreGrey)
  {
    Body body = test::block(2, 1, 1, test::same);
    test::add_field(body, "angle", [](const Vec &x) { return x[0] > 2 ? NAN : x[1]; });
    Style style;
    style.field                     = "angle";
    const std::vector<Panel> panels = {{"", std::make_shared<const Body>(body), {}}};
    const Sheet              sheet  = sheet_of(panels, style, frame_of(panels, style));
    std::size_t              plain  = 0;
    for (const Facet &facet : sheet.layers[0].facets)
      plain += facet.values.empty() ? 1 : 0;
    EXPECT_GT(plain, 0u);
    EXPECT_LT(plain, sheet.layers[0].facets.size());
  }
} // namespace myolines::picture
