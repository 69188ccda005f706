// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/marker_probe.h>
#include <myolines/observers/markers.h>
#include <myolines/scene/input_text.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    const std::string expected = "\"name x y z\" with coordinates in metres, for example \"middle 0.015 0.005 0.005\"";

    void add_marker(const std::string &text, const scene::Node &series, const std::string &parameter, std::vector<Marker> &markers)
    {
      std::istringstream words(text);
      Marker             marker;
      if (!(words >> marker.name))
        return; // blank piece: a trailing separator or an empty line
      std::string rest;
      if (!(words >> marker.position[0] >> marker.position[1] >> marker.position[2]) || (words >> rest))
        series.refuse(parameter, "\"" + text + "\" is not a marker", expected);
      const auto same_name = [&](const Marker &other) { return other.name == marker.name; };
      if (std::any_of(markers.begin(), markers.end(), same_name))
        series.refuse(parameter, "the marker \"" + marker.name + "\" is given twice", "a name of its own for every marker");
      markers.push_back(marker);
    }

    std::vector<Marker> parse(std::istream &input, const char separator, const scene::Node &series, const std::string &parameter)
    {
      std::vector<Marker> markers;
      for (std::string piece; std::getline(input, piece, separator);)
        add_marker(piece.substr(0, piece.find('#')), series, parameter, markers);
      if (markers.empty())
        series.refuse(parameter, "names no marker", expected, "leave it out if no displacements are wanted");
      return markers;
    }
  } // namespace

  void add_marker_parameters(scene::Schema &series)
  {
    series
        .optional_text("markers",
                       "Material points whose displacement is written to displacements-3d.csv: \"name x y z; name x y z\" [m, reference].")
        .optional_file("markers file", "The same from a file, one marker \"name x y z\" per line.");
  }

  std::vector<Marker> read_markers(const scene::Node &series)
  {
    if (series.has("markers") && series.has("markers file"))
      series.refuse("markers", "markers are given here and in \"markers file\"", "one of the two");
    if (series.has("markers"))
      {
        std::istringstream text(series.text("markers"));
        return parse(text, ';', series, "markers");
      }
    if (series.has("markers file"))
      {
        std::istringstream file(scene::read_input_text(series.file("markers file")));
        return parse(file, '\n', series, "markers file");
      }
    return {};
  }

  std::string markers_origin(const scene::Node &series) { return series.where(series.has("markers file") ? "markers file" : "markers"); }
} // namespace myolines
