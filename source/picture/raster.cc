// SPDX-License-Identifier: LGPL-2.1-or-later
#include "depth.h"
#include "font.h"

#include <myolines/picture/sheet.h>

#include <algorithm>
#include <cmath>

namespace myolines::picture
{
  namespace
  {
    constexpr int samples = 2; // of a pixel along each side

    std::uint8_t byte(const double x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0., 1.))); }

    /// Pixels with depth. Coordinates are those of the sheet times @p scale.
    class Canvas
    {
    public:
      Canvas(const Sheet &sheet, const double scale)
        : sheet_(sheet)
        , scale_(scale)
        , depth_(sheet, scale)
        , rgb_(3 * depth_.width * depth_.height, 255)
      {}

      void draw(const Layer &layer)
      {
        if (layer.opacity >= 1)
          for (const Facet &facet : layer.facets)
            fill(facet, depth_);
        else
          draw_translucent(layer);
        for (const Stroke &stroke : layer.strokes)
          line(stroke, true);
      }

      void draw(const Facet &box) { fill(box, depth_); }
      void draw(const Stroke &stroke) { line(stroke, false); }

      /// Means of the samples.
      Pixels pixels() const
      {
        Pixels            pixels{sheet_.width, sheet_.height, {}};
        const std::size_t n = samples;
        for (std::size_t y = 0; y < sheet_.height; ++y)
          for (std::size_t x = 0; x < sheet_.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
              {
                unsigned int sum = 0;
                for (std::size_t s = 0; s < n * n; ++s)
                  sum += rgb_[3 * ((n * y + s / n) * depth_.width + n * x + s % n) + c];
                pixels.rgb.push_back(static_cast<std::uint8_t>(sum / (n * n)));
              }
        return pixels;
      }

    private:
      Colour colour(const Facet &facet, const double value) const
      {
        Colour c = facet.values.empty() ? facet.plain : colour_of(sheet_.map, value);
        for (double &x : c)
          x *= facet.light;
        return c;
      }

      void set(const std::size_t pixel, const Colour &c, const double opacity)
      {
        for (std::size_t i = 0; i < 3; ++i)
          rgb_[3 * pixel + i] = byte(c[i] * opacity + (1 - opacity) * rgb_[3 * pixel + i] / 255.);
      }

      void fill(const Facet &facet, DepthBuffer &depth)
      {
        depth.cover(facet, [&](const std::size_t pixel, const double value) { set(pixel, colour(facet, value), 1); });
      }

      /// The nearest pieces first hide each other, then cover what is there.
      void draw_translucent(const Layer &layer)
      {
        DepthBuffer                own(sheet_, scale_);
        std::vector<Colour>        colours(own.width * own.height);
        std::vector<unsigned char> covered(colours.size(), 0);
        for (const Facet &facet : layer.facets)
          own.cover(facet, [&](const std::size_t pixel, const double value) {
            colours[pixel] = colour(facet, value);
            covered[pixel] = 1;
          });
        for (std::size_t pixel = 0; pixel < covered.size(); ++pixel)
          if (covered[pixel])
            set(pixel, colours[pixel], layer.opacity);
      }

      void line(const Stroke &stroke, const bool hidden)
      {
        const double ax = stroke.a[0] * scale_, ay = stroke.a[1] * scale_, bx = stroke.b[0] * scale_, by = stroke.b[1] * scale_;
        const double half = std::max(0.5, stroke.width * scale_ / 2), length = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
        const auto   low = [&](const double a, const double b) {
          return static_cast<long>(std::floor(std::max(0., std::min(a, b) - half - 1)));
        };
        const auto high = [&](const double a, const double b, const std::size_t n) {
          return static_cast<long>(std::min(static_cast<double>(n) - 1, std::max(a, b) + half + 1));
        };
        for (long y = low(ay, by); y <= high(ay, by, depth_.height); ++y)
          for (long x = low(ax, bx); x <= high(ax, bx, depth_.width); ++x)
            {
              const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
              const double s     = length > 0 ? std::clamp(((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length, 0., 1.) : 0;
              const double cover = half + 0.5 - std::hypot(px - ax - s * (bx - ax), py - ay - s * (by - ay));
              const auto   pixel = static_cast<std::size_t>(y) * depth_.width + static_cast<std::size_t>(x);
              if (cover <= 0 || (hidden && depth_.hides(pixel, stroke.a[2] + s * (stroke.b[2] - stroke.a[2]))))
                continue;
              const Colour c =
                  stroke.mapped ? colour_of(sheet_.map, stroke.values[0] + s * (stroke.values[1] - stroke.values[0])) : stroke.plain;
              set(pixel, c, std::min(1., cover));
            }
      }

      const Sheet              &sheet_;
      double                    scale_;
      DepthBuffer               depth_;
      std::vector<std::uint8_t> rgb_;
    };

    /// Letters are drawn like lines, each pixel by how far it is from them.
    void write(const Words &words, Canvas &canvas)
    {
      const WrittenText text = written(words.text);
      const double      unit = words.size * 0.12; // six are the height of a capital
      const double shift = words.anchor == Words::Anchor::left ? 0 : words.anchor == Words::Anchor::middle ? text.width / 2 : text.width;
      for (const auto &line : text.lines)
        {
          Stroke stroke{{{words.x + unit * (line[0] - shift), words.y - unit * line[1], 0}},
                        {{words.x + unit * (line[2] - shift), words.y - unit * line[3], 0}}};
          stroke.plain = {{0.12, 0.12, 0.12}};
          stroke.width = words.size * (line[0] == line[2] && line[1] == line[3] ? 0.16 : 0.095); // a point is a dot
          canvas.draw(stroke);
        }
    }
  } // namespace

  Pixels pixels_of(const Sheet &sheet)
  {
    Canvas canvas(sheet, samples);
    for (const Layer &layer : sheet.layers)
      canvas.draw(layer);
    for (const Facet &box : sheet.boxes)
      canvas.draw(box);
    for (const Stroke &line : sheet.lines)
      canvas.draw(line);
    for (const Words &words : sheet.words)
      write(words, canvas);
    return canvas.pixels();
  }
} // namespace myolines::picture
