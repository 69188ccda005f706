// SPDX-License-Identifier: LGPL-2.1-or-later
#include "depth.h"

#include <myolines/base/escape.h>

#include <cstdio>

namespace myolines::picture
{
  namespace
  {
    std::string number(const double x)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.1f", x);
      std::string short_text(text);
      if (short_text.size() > 2 && short_text.compare(short_text.size() - 2, 2, ".0") == 0)
        short_text.resize(short_text.size() - 2);
      return short_text == "-0" ? "0" : short_text;
    }

    Spot middle(const std::vector<Spot> &corners)
    {
      Spot centre{};
      for (const Spot &corner : corners)
        for (int c = 0; c < 3; ++c)
          centre[c] += corner[c] / static_cast<double>(corners.size());
      return centre;
    }

    /// A quadrilateral in n x n parts, each of which will have one colour.
    void add_parts(const Facet &facet, const int n, std::vector<Facet> &parts)
    {
      if (facet.corners.size() != 4 || facet.values.empty() || n < 2)
        {
          parts.push_back(facet);
          return;
        }
      const auto at = [&](const int i, const int j, const auto &of_corner) {
        const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
        return (1 - x) * (1 - y) * of_corner(0) + x * (1 - y) * of_corner(1) + x * y * of_corner(2) + (1 - x) * y * of_corner(3);
      };
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          {
            Facet part;
            part.light = facet.light;
            for (const auto &[a, b] : {std::pair<int, int>{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
              {
                Spot spot;
                for (int c = 0; c < 3; ++c)
                  spot[c] = at(a, b, [&](const int v) { return facet.corners[v][c]; });
                part.corners.push_back(spot);
                part.values.push_back(at(a, b, [&](const int v) { return facet.values[v]; }));
              }
            parts.push_back(part);
          }
    }

    class Drawing
    {
    public:
      explicit Drawing(const Sheet &sheet)
        : sheet_(sheet)
        , depth_(sheet, 1)
      {}

      void draw(const Layer &layer)
      {
        constexpr std::size_t enough = 6000;
        const int             n      = layer.facets.size() * 16 < enough ? 4 : layer.facets.size() * 4 < enough ? 2 : 1;
        std::vector<Facet>    parts;
        for (const Facet &facet : layer.facets)
          add_parts(facet, n, parts);
        DepthBuffer  own(sheet_, 1);
        DepthBuffer &depth = layer.opacity >= 1 ? depth_ : own;
        for (const Facet &part : parts)
          depth.cover(part, [](std::size_t, double) {});
        std::vector<std::pair<double, std::string>> pieces; // by nearness
        for (const Facet &part : parts)
          if (is_seen(part, depth))
            pieces.emplace_back(middle(part.corners)[2], polygon(part, layer.opacity));
        for (const Stroke &stroke : layer.strokes)
          add_visible(stroke, pieces);
        std::stable_sort(pieces.begin(), pieces.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
        for (const auto &piece : pieces)
          text += piece.second;
      }

      std::string polygon(const Facet &facet, const double opacity) const
      {
        double mean = 0;
        for (const double value : facet.values)
          mean += value / static_cast<double>(facet.values.size());
        Colour c = facet.values.empty() ? facet.plain : colour_of(sheet_.map, mean);
        for (double &x : c)
          x *= facet.light;
        std::string points;
        for (const Spot &corner : facet.corners)
          points += (points.empty() ? "" : " ") + number(corner[0]) + "," + number(corner[1]);
        const std::string colour = hexadecimal(c);
        return "<polygon points=\"" + points + "\" fill=\"" + colour + "\"" +
               (opacity < 1 ? " fill-opacity=\"" + number(opacity) + "\"" : " stroke=\"" + colour + "\" stroke-width=\".6\"") + "/>\n";
      }

      std::string line(const Stroke &stroke) const
      {
        const Colour c = stroke.mapped ? colour_of(sheet_.map, (stroke.values[0] + stroke.values[1]) / 2) : stroke.plain;
        return "<path d=\"M" + number(stroke.a[0]) + " " + number(stroke.a[1]) + "L" + number(stroke.b[0]) + " " + number(stroke.b[1]) +
               "\" stroke=\"" + hexadecimal(c) + "\" stroke-width=\"" + number(stroke.width) + "\" stroke-linecap=\"round\"/>\n";
      }

      std::string text;

    private:
      /// Whether a corner or the middle, drawn in a little, is not behind others.
      bool is_seen(const Facet &facet, const DepthBuffer &depth) const
      {
        const Spot centre = middle(facet.corners);
        const auto seen   = [&](const Spot &spot) {
          const std::size_t pixel = depth.pixel_of(spot);
          return pixel < depth.width * depth.height && !depth.hides(pixel, spot[2]);
        };
        if (seen(centre))
          return true;
        for (const Spot &corner : facet.corners)
          {
            Spot inner;
            for (int c = 0; c < 3; ++c)
              inner[c] = corner[c] + 0.2 * (centre[c] - corner[c]);
            if (seen(inner))
              return true;
          }
        return false;
      }

      /// The parts of a stroke that nothing hides, a dozen pixels each.
      void add_visible(const Stroke &stroke, std::vector<std::pair<double, std::string>> &pieces) const
      {
        const int  n  = std::max(1, static_cast<int>(std::hypot(stroke.b[0] - stroke.a[0], stroke.b[1] - stroke.a[1]) / 12));
        const auto at = [&](const double s) {
          Spot spot;
          for (int c = 0; c < 3; ++c)
            spot[c] = stroke.a[c] + s * (stroke.b[c] - stroke.a[c]);
          return spot;
        };
        for (int i = 0; i < n; ++i)
          {
            const double      from = static_cast<double>(i) / n, to = static_cast<double>(i + 1) / n;
            const Spot        half  = at((from + to) / 2);
            const std::size_t pixel = depth_.pixel_of(half);
            if (pixel == depth_.width * depth_.height || depth_.hides(pixel, half[2]))
              continue;
            Stroke part = stroke;
            part.a      = at(from);
            part.b      = at(to);
            part.values = {{stroke.values[0] + from * (stroke.values[1] - stroke.values[0]),
                            stroke.values[0] + to * (stroke.values[1] - stroke.values[0])}};
            pieces.emplace_back(half[2] + 1, line(part));
          }
      }

      const Sheet &sheet_;
      DepthBuffer  depth_;
    };
  } // namespace

  std::string svg_of(const Sheet &sheet)
  {
    Drawing drawing(sheet);
    for (const Layer &layer : sheet.layers)
      drawing.draw(layer);
    for (const Facet &box : sheet.boxes)
      drawing.text += drawing.polygon(box, 1);
    for (const Stroke &line : sheet.lines)
      drawing.text += drawing.line(line);
    for (const Words &words : sheet.words)
      drawing.text += "<text x=\"" + number(words.x) + "\" y=\"" + number(words.y) + "\" font-size=\"" + number(words.size) + "\"" +
                      (words.anchor == Words::Anchor::left     ? ""
                       : words.anchor == Words::Anchor::middle ? " text-anchor=\"middle\""
                                                               : " text-anchor=\"end\"") +
                      ">" + escaped(words.text) + "</text>\n";
    const std::string size = std::to_string(sheet.width) + "\" height=\"" + std::to_string(sheet.height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " + std::to_string(sheet.width) + " " +
           std::to_string(sheet.height) + "\" role=\"img\" font-family=\"sans-serif\" fill=\"#1f1f1f\">\n<title>" + escaped(sheet.title) +
           "</title>\n<rect width=\"" + size + "\" fill=\"#ffffff\"/>\n" + drawing.text + "</svg>\n";
  }
} // namespace myolines::picture
