// SPDX-License-Identifier: LGPL-2.1-or-later
#include "charts.h"

#include <myolines/base/files.h>
#include <myolines/base/scratch_folder.h>

#include <algorithm>
#include <cmath>

namespace myolines::report
{
  namespace
  {
    constexpr std::size_t most_points = 800; // more than a screen shows

    bool is_finite(const std::pair<double, double> &point) { return std::isfinite(point.first) && std::isfinite(point.second); }

    Json words(const std::vector<std::pair<double, std::string>> &all)
    {
      Json json = Json::array();
      for (const auto &[at, word] : all)
        json.push_back({at, word});
      return json;
    }

    Json chart_of(const study::Picture &picture, const std::string &title)
    {
      Json curves = Json::array();
      for (const study::Curve &curve : picture.curves)
        {
          Json points = Json::array();
          for (const auto &point : curve.points)
            if (is_finite(point) && !(picture.log_x && point.first <= 0) && !(picture.log_y && point.second <= 0))
              points.push_back({point.first, point.second});
          curves.push_back({{"title", curve.title}, {"points", points}});
        }
      return {{"title", title},
              {"x", picture.x_label},
              {"y", picture.y_label},
              {"logX", picture.log_x},
              {"logY", picture.log_y},
              {"lines", picture.lines},
              {"marks", picture.marks},
              {"xWords", words(picture.x_words)},
              {"yWords", words(picture.y_words)},
              {"curves", curves}};
    }
  } // namespace

  study::Curve thinned(const study::Curve &curve, const std::size_t most)
  {
    study::Curve all{curve.title, {}}, few{curve.title, {}};
    std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(all.points), is_finite);
    if (all.points.size() <= most)
      return all;
    const std::size_t parts = std::max<std::size_t>(1, (most - 2) / 2), n = all.points.size();
    few.points.push_back(all.points.front());
    for (std::size_t part = 0; part < parts; ++part)
      {
        const auto begin = all.points.begin() + static_cast<std::ptrdiff_t>(part * n / parts),
                   end   = all.points.begin() + static_cast<std::ptrdiff_t>((part + 1) * n / parts);
        auto [low, high] = std::minmax_element(begin, end, [](const auto &a, const auto &b) { return a.second < b.second; });
        if (high < low)
          std::swap(low, high);
        few.points.push_back(*low);
        few.points.push_back(*high);
      }
    few.points.push_back(all.points.back());
    return few;
  }

  study::Picture thinned(study::Picture picture)
  {
    for (study::Curve &curve : picture.curves)
      if (picture.lines && !picture.log_x) // points of a map or of a study are all wanted
        curve = thinned(curve, most_points);
    for (study::Picture &panel : picture.panels)
      panel = thinned(panel);
    return picture;
  }

  std::vector<Json> charts_of(const study::Picture &picture)
  {
    if (picture.panels.empty())
      return {chart_of(picture, picture.title)};
    std::vector<Json> charts;
    for (const study::Picture &panel : picture.panels)
      charts.push_back(chart_of(panel, panel.title));
    return charts;
  }

  std::vector<std::pair<study::Picture, std::string>> drawn(std::vector<study::Picture> pictures)
  {
    std::vector<std::pair<study::Picture, std::string>> all;
    pictures.erase(std::remove_if(pictures.begin(), pictures.end(), [](const auto &picture) { return !has_points(picture); }),
                   pictures.end());
    if (pictures.empty())
      return all;
    for (std::size_t i = 0; i < pictures.size(); ++i)
      {
        pictures[i]      = thinned(pictures[i]);
        pictures[i].name = std::to_string(i);
      }
    const ScratchFolder scratch;
    draw(pictures, scratch.path());
    for (study::Picture &picture : pictures)
      all.emplace_back(picture, read_file(scratch.path() / (picture.name + ".svg")));
    return all;
  }
} // namespace myolines::report
