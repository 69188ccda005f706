// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/escape.h>
#include <myolines/study/series_titles.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace myolines::study
{
  namespace
  {
    struct KnownTitle
    {
      const char *stem, *words;
    };
    constexpr KnownTitle known_titles[] = {
        {"reaction", "Forces with which the boundary conditions pull on the body"},
        {"conditions", "What the boundary conditions do: power, stored energy, elongation of tendons"},
        {"force_data-3d", "Force at the measured face, estimated from interior points, by part of the stress"},
        {"activation_muscle_length-3d", "Activation and length of the muscle"},
        {"mean_stretch_pennation_data-3d", "Stretch and pennation of the fibres, mean over the middle"},
        {"gearing_info-3d", "Lengths, velocities and strain rates behind the gearing"},
        {"gearing", "Gearing: velocity of the muscle over that of its fibres"},
        {"fascicles", "Fascicles: lengths, stretch, velocity, curvature, angle"},
        {"shape", "Shape of the belly: length, width, thickness, volume"},
        {"energy_balance", "Energies, works and the drift of their balance"},
        {"energy_data-3d", "Energy densities by part of the stress"},
        {"displacements-3d", "Displacements of the markers"},
        {"strain", "Strains"},
        {"momenta", "Centre of mass, momentum and angular momentum"},
        {"motion", "Motion at equal intervals"},
        {"trace", "Displacements and velocities at places of the rod"},
        {"energy", "Energies"},
        {"trajectory", "Motion of the mass"},
        {"muscle_tendon", "Muscle and tendon: lengths, velocities, forces"},
        {"stretches", "Stretches along the muscle"},
        {"equilibria", "Equilibria of the chain, by the branches that its elements are on"},
        {"nodal_states", "Displacements and velocities of the nodes"},
    };

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

  std::string series_title(const std::string &file)
  {
    std::string stem = std::filesystem::path(file).stem().string();
    for (const KnownTitle &title : known_titles)
      if (stem == title.stem)
        return title.words;
    std::replace(stem.begin(), stem.end(), '_', ' ');
    return stem;
  }

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
