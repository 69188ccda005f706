// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/places.h>
#include <myolines/scene/numbers.h>

#include <algorithm>

namespace myolines
{
  void add_strain_places(scene::Schema &series, const std::string &where)
  {
    series.optional_text("strain places",
                         "strain.csv: (u(x) - u(0))/x and (v(x) - v(0))/x, strain and strain rate of the part up to x, at " + where +
                             "; parts of the length, \"0.25 0.5 0.9 1\".");
  }

  std::vector<double> read_strain_places(const scene::Node &series)
  {
    if (!series.has("strain places"))
      return {};
    const std::string   what   = "numbers above 0, up to 1";
    std::vector<double> places = series.numbers("strain places", what);
    if (std::any_of(places.begin(), places.end(), [](const double p) { return p <= 0 || p > 1; }))
      series.refuse("strain places", "a place is not on the body or at its beginning", what);
    return places;
  }

  std::vector<std::string> strain_columns(const std::vector<double> &places)
  {
    std::vector<std::string> columns{"Time [s]"};
    for (const auto &[quantity, unit] : {std::pair<std::string, std::string>{"strain", "[-]"}, {"strain rate", "[1/s]"}})
      for (const double place : places)
        columns.push_back(quantity + "(" + scene::format_number(place) + " L) " + unit);
    return columns;
  }

  std::vector<double> strain_row(const double t, const std::vector<double> &places, const double length, const std::vector<double> &u,
                                 const std::vector<double> &v)
  {
    std::vector<double> row{t};
    for (const std::vector<double> *x : {&u, &v})
      for (std::size_t i = 0; i < places.size(); ++i)
        row.push_back((x->at(i + 1) - x->at(0)) / (places[i] * length));
    return row;
  }
} // namespace myolines
