// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bars.h"

#include <myolines/measures/fields.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace myolines::picture
{
  namespace
  {
    constexpr double before_all = 1e9;

    std::string short_text(const double x)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", std::abs(x) < 1e-300 ? 0. : x);
      return text;
    }

    /// A unit with a prefix, and how many of it the original one is.
    std::pair<std::string, double> prefixed(const std::string &unit, const double largest)
    {
      if (unit != "Pa" && unit != "m" && unit != "m/s" && unit != "N" && unit != "J")
        return {unit, 1};
      for (const auto &[prefix, size] : {std::pair<const char *, double>{"M", 1e6}, {"k", 1e3}, {"", 1}, {"m", 1e-3}, {"\xC2\xB5", 1e-6}})
        if (largest >= size)
          return {prefix + unit, 1 / size};
      return {unit, 1};
    }

    Facet box(const double x, const double y, const double width, const double height)
    {
      Facet facet;
      facet.corners = {
          {{x, y, before_all}}, {{x + width, y, before_all}}, {{x + width, y + height, before_all}}, {{x, y + height, before_all}}};
      return facet;
    }
  } // namespace

  ColourMap map_for(const std::string &field, const std::pair<double, double> &range)
  {
    if (field == "tissue")
      return ColourMap::tissues;
    return range.first < 0 && range.second > 0 && std::min(-range.first, range.second) > 0.1 * std::max(-range.first, range.second)
               ? ColourMap::diverging
               : ColourMap::viridis;
  }

  std::pair<double, double> drawn_range(const std::string &field, const std::pair<double, double> &range)
  {
    if (field == "tissue")
      return {0.5, most_tissues + 0.5};
    if (map_for(field, range) == ColourMap::diverging)
      {
        const double most = std::max(-range.first, range.second);
        return {-most, most};
      }
    const double size = std::max(std::abs(range.first), std::abs(range.second));
    if (range.second - range.first > 1e-6 * size) // files have floats
      return range;
    return size == 0 ? std::pair<double, double>{0, 1} : std::pair<double, double>{range.first - 0.01 * size, range.second + 0.01 * size};
  }

  double round_length(const double x)
  {
    const double power = std::pow(10, std::floor(std::log10(x) + 1e-9));
    return x >= 5 * power ? 5 * power : x >= 2 * power ? 2 * power : power;
  }

  std::string length_text(const double length)
  {
    const auto [unit, factor] = prefixed("m", length);
    return short_text(length * factor) + " " + unit;
  }

  void add_tissue_key(const std::map<int, std::string> &tissues, const double x, double y, const double width, Sheet &sheet)
  {
    for (const auto &[number, name] : tissues)
      {
        Facet each = box(x, y, width, 20);
        each.values.assign(4, (number - 0.5) / most_tissues);
        sheet.boxes.push_back(each);
        sheet.words.push_back({x + width + 8, y + 15, name, 14, Words::Anchor::left});
        y += 30;
      }
  }

  void add_colour_bar(const std::string &field, const std::pair<double, double> &range, const double x, const double y, const double width,
                      const double height, Sheet &sheet)
  {
    const auto component =
        field.size() > 2 && field[field.size() - 2] == ' ' && field_unit(field).empty() ? field.size() - 2 : field.size();
    const auto [unit, factor] = prefixed(field_unit(field.substr(0, component)), std::max(std::abs(range.first), std::abs(range.second)));
    sheet.words.push_back({x, y - 14, field + (unit.empty() ? "" : " [" + unit + "]"), 15, Words::Anchor::left});
    constexpr int parts = 64;
    for (int i = 0; i < parts; ++i)
      {
        Facet part = box(x, y + height * (parts - 1 - i) / parts, width, height / parts + 0.3);
        part.values.assign(4, (i + 0.5) / parts);
        for (Spot &corner : part.corners)
          corner[2] += i;
        sheet.boxes.push_back(part);
      }
    const double low = range.first * factor, high = range.second * factor, step = round_length((high - low) / 4);
    for (double tick = std::ceil(low / step - 1e-9) * step; tick <= high + 1e-9 * step; tick += step)
      {
        const double at = y + height * (high - tick) / (high - low);
        Stroke       mark{{{x + width, at, 0}}, {{x + width + 5, at, 0}}};
        mark.plain = {{0.12, 0.12, 0.12}};
        sheet.lines.push_back(mark);
        sheet.words.push_back({x + width + 9, at + 5, short_text(std::abs(tick) < 1e-9 * step ? 0 : tick), 14, Words::Anchor::left});
      }
  }
} // namespace myolines::picture
