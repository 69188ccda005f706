// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/sheet.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines::picture
{
  /// How near what is seen at each pixel is. Coordinates are those of the sheet times a scale.
  class DepthBuffer
  {
  public:
    DepthBuffer(const Sheet &sheet, const double scale)
      : width(static_cast<std::size_t>(sheet.width * scale))
      , height(static_cast<std::size_t>(sheet.height * scale))
      , scale_(scale)
      , nearest_(width * height, -std::numeric_limits<float>::infinity())
    {}

    const std::size_t width, height;

    /// Calls @p draw(pixel, value) where the facet, which is convex, is nearer than what was there.
    template <typename Draw>
    void cover(const Facet &facet, const Draw &draw)
    {
      for (std::size_t v = 2; v < facet.corners.size(); ++v)
        cover_triangle(facet, {{0, v - 1, v}}, draw);
    }

    /// Whether something before lies clearly before a spot so near. Lines on a surface are seen.
    bool hides(const std::size_t pixel, const double near) const { return nearest_[pixel] > near + slack; }

    /// The pixel of a spot; `width * height` outside.
    std::size_t pixel_of(const Spot &spot) const
    {
      const double x = spot[0] * scale_, y = spot[1] * scale_;
      return x >= 0 && y >= 0 && x < static_cast<double>(width) && y < static_cast<double>(height)
                 ? static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)
                 : width * height;
    }

  private:
    static constexpr double slack = 2; // pixels of the sheet

    template <typename Draw>
    void cover_triangle(const Facet &facet, const std::array<std::size_t, 3> &corners, const Draw &draw)
    {
      std::array<double, 3> x, y, value{};
      for (int v = 0; v < 3; ++v)
        {
          x[v] = facet.corners[corners[v]][0] * scale_;
          y[v] = facet.corners[corners[v]][1] * scale_;
          if (!facet.values.empty())
            value[v] = facet.values[corners[v]];
        }
      const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
      if (area == 0 || !std::isfinite(area))
        return;
      const auto first = [](const std::array<double, 3> &at) { return std::max(0., std::floor(*std::min_element(at.begin(), at.end()))); };
      const auto last  = [](const std::array<double, 3> &at, const std::size_t n) {
        return std::min(static_cast<double>(n) - 1, *std::max_element(at.begin(), at.end()));
      };
      constexpr double centre = 0.5001; // edges seldom run through it
      for (double row = first(y); row <= last(y, height); ++row)
        for (double column = first(x); column <= last(x, width); ++column)
          {
            const double px = column + centre, py = row + centre;
            const double b = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / area;
            const double c = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / area, a = 1 - b - c;
            if (a < 0 || b < 0 || c < 0)
              continue;
            const auto   pixel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
            const double near  = a * facet.corners[corners[0]][2] + b * facet.corners[corners[1]][2] + c * facet.corners[corners[2]][2];
            if (near <= nearest_[pixel])
              continue;
            nearest_[pixel] = static_cast<float>(near);
            draw(pixel, a * value[0] + b * value[1] + c * value[2]);
          }
    }

    double             scale_;
    std::vector<float> nearest_;
  };
} // namespace myolines::picture
