// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/escape.h>
#include <myolines/study/plot_page.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines::study
{
  namespace
  {
    /// Whether all curves stay where they begin.
    bool is_constant(const Picture &picture)
    {
      for (const Curve &curve : picture.curves)
        {
          double low = 0, high = 0, size = 0;
          bool   first = true;
          for (const auto &point : curve.points)
            if (std::isfinite(point.second))
              {
                low   = first ? point.second : std::min(low, point.second);
                high  = first ? point.second : std::max(high, point.second);
                size  = std::max(size, std::abs(point.second));
                first = false;
              }
          if (high - low > 1e-12 * size)
            return false;
        }
      return picture.panels.empty();
    }
  } // namespace

  std::vector<Constant> without_constants(std::vector<Picture> &pictures)
  {
    std::vector<Constant> constants;
    for (const Picture &picture : pictures)
      if (is_constant(picture))
        for (const Curve &curve : picture.curves)
          for (const auto &point : curve.points)
            if (std::isfinite(point.second))
              {
                constants.push_back({picture.title + ": " + curve.title, point.second});
                break;
              }
    pictures.erase(std::remove_if(pictures.begin(), pictures.end(), is_constant), pictures.end());
    return constants;
  }

  std::string index_page(const std::string &title, const std::vector<Picture> &pictures, const std::vector<Constant> &constants)
  {
    std::ostringstream page;
    page << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
            "content=\"width=device-width\">\n<title>"
         << escaped(title) << "</title>\n<style>body{font-family:sans-serif;max-width:70em;margin:1em auto;padding:0 1em}"
         << "img{max-width:100%;height:auto}figure{margin:2em 0}td{padding:0 1em 0 0}</style></head><body>\n<h1>" << escaped(title)
         << "</h1>\n";
    for (const Picture &picture : pictures)
      if (has_points(picture))
        {
          const std::string name = escaped(picture.name);
          page << "<figure><figcaption><b>" << escaped(picture.title) << "</b> " << escaped(picture.y_label) << " (<a href=\"" << name
               << ".png\">PNG</a>, <a href=\"" << name << ".svg\">SVG</a>, <a href=\"" << name
               << ".gp\">gnuplot</a>)</figcaption>\n<img src=\"" << name << ".svg\" alt=\"" << escaped(picture.title)
               << "\" loading=\"lazy\"></figure>\n";
        }
    if (!constants.empty())
      {
        page << "<h2>What stays constant</h2>\n<table>\n";
        for (const Constant &constant : constants)
          page << "<tr><td>" << escaped(constant.title) << "</td><td>" << constant.value << "</td></tr>\n";
        page << "</table>\n";
      }
    page << "</body></html>\n";
    return page.str();
  }
} // namespace myolines::study
