// SPDX-License-Identifier: LGPL-2.1-or-later
#include "body_data.h"
#include "reports.h"

#include <myolines/measures/fields.h>
#include <myolines/picture/fibre_lines.h>
#include <myolines/picture/figure.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace myolines::report
{
  namespace
  {
    using picture::Body;
    using picture::Vec;

    constexpr unsigned int n_lines = 60, points_of_a_line = 13;
    constexpr std::size_t  most_fields = 8, most_times = 48;

    /// Numbers in [low, high] as integers of two bytes, lower byte first; 65535 for what is not finite.
    class Bytes
    {
    public:
      void add(const double x, const double low, const double high)
      {
        const double part  = high > low ? (x - low) / (high - low) : 0;
        const auto   value = std::isfinite(part) ? static_cast<std::uint16_t>(std::lround(65534 * std::clamp(part, 0., 1.))) : 65535;
        bytes_ += static_cast<char>(value & 255);
        bytes_ += static_cast<char>(value >> 8);
      }
      std::string text() const { return base64(bytes_); }

    private:
      std::string bytes_;
    };

    /// The points of the surface, numbered anew, and its faces.
    struct Shell
    {
      std::vector<std::size_t>   points; ///< numbers in the body
      std::vector<std::uint32_t> quads;  ///< four of each face
      std::vector<std::uint32_t> edges;  ///< two of each edge of the cells
    };

    Shell shell_of(const picture::Surface &surface, const Body &body)
    {
      Shell                      shell;
      std::vector<std::uint32_t> name(body.rest.size(), std::numeric_limits<std::uint32_t>::max());
      const auto                 of = [&](const std::size_t p) {
        if (name[p] == std::numeric_limits<std::uint32_t>::max())
          {
            name[p] = static_cast<std::uint32_t>(shell.points.size());
            shell.points.push_back(p);
          }
        return name[p];
      };
      for (const picture::Quad &quad : surface.quads)
        for (const std::size_t p : quad)
          shell.quads.push_back(of(p));
      for (const picture::Surface::Edge &edge : surface.edges)
        shell.edges.insert(shell.edges.end(), {of(edge.a), of(edge.b)});
      return shell;
    }

    std::string integers(const std::vector<std::uint32_t> &all)
    {
      std::string bytes;
      for (const std::uint32_t i : all)
        for (int part = 0; part < 4; ++part)
          bytes += static_cast<char>(i >> 8 * part & 255);
      return base64(bytes);
    }

    /// Every so many-th point of a line, with both ends.
    std::vector<Vec> sparse(const std::vector<Vec> &line)
    {
      std::vector<Vec>  few;
      const std::size_t n = std::min<std::size_t>(points_of_a_line, line.size());
      for (std::size_t i = 0; i < n; ++i)
        few.push_back(line[i * (line.size() - 1) / (n - 1)]);
      return few;
    }

    /// What there is of a field, over all times.
    struct FieldRange
    {
      std::string name;
      double      low = std::numeric_limits<double>::infinity(), high = -low;
      Vec         at_low, at_high; ///< at rest [m]
      double      t_low = 0, t_high = 0;
      Json        points = Json::array(), lines = Json::array();

      void take(const Body &body, const std::vector<double> &values)
      {
        for (std::size_t p = 0; p < values.size(); ++p)
          {
            if (values[p] < low)
              {
                low    = values[p];
                at_low = body.rest[p];
                t_low  = body.t;
              }
            if (values[p] > high)
              {
                high    = values[p];
                at_high = body.rest[p];
                t_high  = body.t;
              }
          }
      }
    };

    /// Fields for the reader to choose from: vectors by their length, and no parts of the directions of fibres.
    std::vector<FieldRange> fields_of(const Body &body, std::vector<std::string> &notes)
    {
      std::vector<FieldRange> fields;
      const std::string       first = picture::first_field(body);
      const auto              add   = [&](const std::string &name) {
        FieldRange field;
        field.name = name;
        fields.push_back(field);
      };
      if (!first.empty())
        add(first);
      std::string left_out;
      for (const picture::Field &field : body.fields)
        {
          if (field.name == first || field.name.compare(0, 15, "fibre direction") == 0)
            continue;
          if (fields.size() < most_fields)
            add(field.name);
          else
            left_out += (left_out.empty() ? "" : ", ") + field.name;
        }
      if (!left_out.empty())
        notes.push_back("Fields of the run that are not in this report: " + left_out + ".");
      return fields;
    }

    std::vector<std::size_t> chosen_times(const picture::RunFields &run, const std::size_t n)
    {
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0; i < n; ++i)
        chosen.push_back(n == 1 ? run.size() - 1 : i * (run.size() - 1) / (n - 1));
      return chosen;
    }

    Json colours_of(const picture::ColourMap map)
    {
      Json colours = Json::array();
      for (int i = 0; i < 33; ++i)
        colours.push_back(picture::hexadecimal(picture::colour_of(map, i / 32.)));
      return colours;
    }

    std::string map_name(const FieldRange &field)
    {
      return field.name == "tissue" ? "tissues" : field.low < 0 && field.high > 0 ? "diverging" : "viridis";
    }

    class Collector
    {
    public:
      Collector(const std::filesystem::path &folder, const std::size_t most_bytes)
        : run_(folder)
        , first_(run_.read(0))
        , surface_(surface_of(first_))
        , shell_(shell_of(surface_, first_))
        , fields_(fields_of(first_, data_.notes))
      {
        if (has_fibres(first_))
          for (const auto &line : fibre_lines(first_, n_lines))
            lines_.push_back(sparse(line));
        choose(most_bytes);
      }

      BodyData collect()
      {
        ranges();
        picture_of_ends();
        if (!times_.empty())
          write_json();
        return data_;
      }

    private:
      /// Numbers of a time: three coordinates and each field, of two bytes.
      void choose(const std::size_t most_bytes)
      {
        const std::size_t points = shell_.points.size() + lines_.size() * points_of_a_line;
        const std::size_t bytes = 2 * points * (3 + fields_.size()), fixed = 4 * (shell_.quads.size() + shell_.edges.size());
        const std::size_t room = most_bytes > fixed ? (most_bytes - fixed) / bytes : 0;
        if (room < 1)
          {
            data_.notes.push_back("The surface has " + std::to_string(shell_.points.size()) +
                                  " points, more than a report can hold: there is no body to turn.");
            return;
          }
        times_ = chosen_times(run_, std::min({run_.size(), room, most_times}));
        if (times_.size() < run_.size())
          data_.notes.push_back("The body that can be turned is shown at " + std::to_string(times_.size()) + " of the " +
                                std::to_string(run_.size()) + " times that the run wrote.");
      }

      void ranges()
      {
        const double infinity = std::numeric_limits<double>::infinity();
        for (unsigned int c = 0; c < 3; ++c)
          {
            low_[c]  = infinity;
            high_[c] = -infinity;
          }
        for (std::size_t i = 0; i < run_.size(); ++i)
          {
            const Body body = run_.read(i);
            for (FieldRange &field : fields_)
              if (const auto values = picture::values_of(body, field.name))
                field.take(body, *values);
            for (const auto *places : {&body.rest, &body.now})
              for (const Vec &x : *places)
                for (unsigned int c = 0; c < 3; ++c)
                  {
                    low_[c]  = std::min(low_[c], x[c]);
                    high_[c] = std::max(high_[c], x[c]);
                  }
          }
        for (const FieldRange &field : fields_)
          if (field.low <= field.high && field.name != "tissue")
            for (const bool least : {true, false})
              {
                const Vec &x = least ? field.at_low : field.at_high;
                data_.extremes.push_back({field.name + (least ? ", least" : ", greatest"), number_text(least ? field.low : field.high),
                                          field_unit(field.name), number_text(least ? field.t_low : field.t_high),
                                          number_text(1e3 * x[0]) + ", " + number_text(1e3 * x[1]) + ", " + number_text(1e3 * x[2])});
              }
      }

      void picture_of_ends()
      {
        std::vector<picture::Panel> panels;
        picture::Style              style;
        style.field = fields_.empty() ? "" : fields_.front().name;
        for (const std::size_t i : chosen_times(run_, std::min<std::size_t>(2, run_.size())))
          {
            const auto body = std::make_shared<const Body>(run_.read(i));
            panels.push_back({"t = " + number_text(body->t) + " s", body, lines_});
          }
        data_.png     = png_of(pixels_of(sheet_of(panels, style, frame_of(panels, style))));
        data_.caption = "The body at the first and at the last time, coloured by " + style.field +
                        (lines_.empty() ? "; " : ", with lines along its fibres; ") + "grey lines: at rest.";
      }

      Json coordinates(const std::vector<Vec> &places) const
      {
        Bytes bytes;
        for (const std::size_t p : shell_.points)
          for (unsigned int c = 0; c < 3; ++c)
            bytes.add(places[p][c], low_[c], high_[c]);
        return bytes.text();
      }

      void write_json()
      {
        Json times = Json::array(), now = Json::array(), lines_now = Json::array(), lengths = Json::array(), fields = Json::array();
        for (const std::size_t i : times_)
          {
            const Body body = run_.read(i);
            times.push_back(body.t);
            if (!body.is_on_the_mesh_of(first_))
              {
                data_.notes.push_back("The mesh of the files changes with the number of ranks: there is no body to turn.");
                return;
              }
            now.push_back(coordinates(body.now));
            Bytes of_lines;
            for (const auto &line : follow(lines_, body, std::vector<double>(body.rest.size(), 0)))
              {
                if (lengths.size() < lines_.size())
                  lengths.push_back(line.size());
                for (const auto &point : line)
                  for (unsigned int c = 0; c < 3; ++c)
                    of_lines.add(point.now[c], low_[c], high_[c]);
              }
            lines_now.push_back(of_lines.text());
            for (FieldRange &field : fields_)
              add_values(field, body);
          }
        for (FieldRange &field : fields_)
          if (field.low <= field.high)
            fields.push_back({{"name", field.name},
                              {"unit", field_unit(field.name)},
                              {"low", field.low},
                              {"high", field.high},
                              {"map", map_name(field)},
                              {"points", field.points},
                              {"lines", field.lines}});
        Json tissues = Json::array(); // name and colour
        for (const auto &[number, name] : first_.tissues_present())
          tissues.push_back(
              {{"number", number},
               {"name", name},
               {"colour", picture::hexadecimal(colour_of(picture::ColourMap::tissues, (number - 0.5) / picture::most_tissues))}});
        data_.json               = {{"low", {low_[0], low_[1], low_[2]}},
                                    {"high", {high_[0], high_[1], high_[2]}},
                                    {"quads", integers(shell_.quads)},
                                    {"edges", integers(shell_.edges)},
                                    {"rest", coordinates(first_.rest)},
                                    {"times", times},
                                    {"now", now},
                                    {"lengths", lengths},
                                    {"lines", lines_now},
                                    {"fields", fields},
                                    {"most tissues", picture::most_tissues},
                                    {"tissues", tissues},
                                    {"maps",
                                     {{"viridis", colours_of(picture::ColourMap::viridis)},
                                      {"diverging", colours_of(picture::ColourMap::diverging)},
                                      {"tissues", colours_of(picture::ColourMap::tissues)}}}};
        const picture::View view = picture::view_of(first_, 0, 0);
        data_.json["axes"]       = {{"right", {view.right[0], view.right[1], view.right[2]}}, {"up", {view.up[0], view.up[1], view.up[2]}}};
      }

      void add_values(FieldRange &field, const Body &body) const
      {
        const auto values = picture::values_of(body, field.name);
        Bytes      points, lines;
        if (values)
          {
            for (const std::size_t p : shell_.points)
              points.add((*values)[p], field.low, field.high);
            for (const auto &line : follow(lines_, body, *values))
              for (const auto &point : line)
                lines.add(point.value, field.low, field.high);
          }
        field.points.push_back(points.text());
        field.lines.push_back(lines.text());
      }

      BodyData                      data_;
      picture::RunFields            run_;
      Body                          first_;
      picture::Surface              surface_;
      Shell                         shell_;
      std::vector<FieldRange>       fields_;
      std::vector<std::vector<Vec>> lines_;
      std::vector<std::size_t>      times_; ///< that the script shows
      Vec                           low_, high_;
    };
  } // namespace

  BodyData body_data(const std::filesystem::path &folder, const std::size_t most_bytes) { return Collector(folder, most_bytes).collect(); }
} // namespace myolines::report
