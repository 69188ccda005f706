// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bars.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/picture/fibre_lines.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines::picture
{
  namespace
  {
    constexpr Colour grey{{0.78, 0.78, 0.78}}, pale{{0.96, 0.95, 0.94}}, of_rest{{0.55, 0.55, 0.55}}, dark{{0.15, 0.15, 0.15}};

    /// Where panels lie on the sheet.
    struct Layout
    {
      static constexpr double bar = 190, title = 34, margin = 14; // [px]

      unsigned int columns = 1, rows = 1;
      double       scale = 1;             ///< [px/m]
      double       width = 0, height = 0; ///< of a panel [px]
    };

    /// Rows of panels above that of @p panel.
    double row_of(const std::size_t panel, const Layout &layout)
    {
      const std::size_t row = panel / layout.columns;
      return static_cast<double>(row);
    }

    /// As many columns as make the bodies largest on a sheet that is not higher than four fifths of its width.
    Layout layout_of(const std::size_t n, const Frame &frame, const unsigned int width)
    {
      const Vec size = frame.high - frame.low;
      Layout    best;
      for (unsigned int columns = 1; columns <= n; ++columns)
        {
          Layout layout;
          layout.columns       = columns;
          layout.rows          = static_cast<unsigned int>((n + columns - 1) / columns);
          layout.width         = (width - Layout::bar) / columns;
          const double tallest = 0.8 * width / layout.rows - Layout::title - 2 * Layout::margin;
          layout.scale         = std::min((layout.width - 2 * Layout::margin) / size[0], std::max(tallest, 20.) / size[1]);
          layout.height        = size[1] * layout.scale + Layout::title + 2 * Layout::margin;
          if (columns == 1 || layout.scale > best.scale * 1.001)
            best = layout;
        }
      return best;
    }

    /// From a body to a place on the sheet.
    class Projector
    {
    public:
      Projector(const Frame &frame, const Layout &layout, const std::size_t panel)
        : frame_(frame)
        , scale_(layout.scale)
        , left_(layout.width * static_cast<double>(panel % layout.columns) +
                (layout.width - (frame.high - frame.low)[0] * layout.scale) / 2)
        , bottom_(layout.height * (row_of(panel, layout) + 1) - Layout::margin)
      {}

      Spot operator()(const Vec &x) const
      {
        const Vec seen = frame_.view.seen(x) - frame_.low;
        return {{left_ + scale_ * seen[0], bottom_ - scale_ * seen[1], scale_ * seen[2]}};
      }

      double left() const { return left_; }
      double bottom() const { return bottom_; }

    private:
      const Frame &frame_;
      double       scale_, left_, bottom_;
    };

    double light_on(const Vec &normal, const View &view)
    {
      const Vec from = (0.35 * view.right + 0.55 * view.up + 0.76 * view.towards) / 1.0013;
      return 0.6 + 0.4 * std::max(0., std::min(1., normal * from));
    }

    void add_edges(const std::vector<Segment> &segments, const Projector &project, const Colour &colour, const double width, Layer &layer)
    {
      for (const Segment &segment : segments)
        {
          Stroke stroke{project(segment[0]), project(segment[1])};
          stroke.plain = colour;
          stroke.width = width;
          layer.strokes.push_back(stroke);
        }
    }

    class BodyPainter
    {
    public:
      BodyPainter(const Style &style, const Frame &frame, const std::pair<double, double> &range)
        : style_(style)
        , frame_(frame)
        , range_(range)
      {}

      void paint(const Panel &panel, const Projector &project, Layer &solid, Layer &veil) const
      {
        const Body   &body    = *panel.body;
        const Surface surface = surface_of(body);
        const auto    values  = *values_of(body, style_.field);
        const bool    lines   = !panel.lines.empty();
        for (const Polygon &polygon : polygons(body, surface, values, style_.cut))
          {
            const bool front = polygon.normal * frame_.view.towards > 0;
            if (front || lines || style_.cut) // a cut shows the inside
              (front && lines ? veil : solid).facets.push_back(facet(polygon, project, !lines));
          }
        if (lines)
          add_lines(follow(panel.lines, body, values), project, solid);
        if (!style_.cut) // outlines are of the whole body
          {
            add_edges(outline(surface, body.rest, frame_.view.towards), project, of_rest, 1, solid);
            add_edges(outline(surface, body.now, frame_.view.towards), project, dark, 1.2, lines ? veil : solid);
          }
        else
          add_edges(outline(surface, body.rest, frame_.view.towards), project, of_rest, 1, solid);
      }

    private:
      double scaled(const double value) const { return (value - range_.first) / (range_.second - range_.first); }

      Facet facet(const Polygon &polygon, const Projector &project, const bool coloured) const
      {
        Facet facet;
        facet.plain = coloured ? grey : pale;
        facet.light =
            coloured ? light_on(polygon.normal, frame_.view) : 0.5 + 0.5 * light_on(polygon.normal, frame_.view); // a veil is pale
        bool defined = coloured;
        for (std::size_t v = 0; v < polygon.corners.size(); ++v)
          {
            facet.corners.push_back(project(polygon.corners[v]));
            defined = defined && std::isfinite(polygon.values[v]);
          }
        if (defined)
          for (const double value : polygon.values)
            facet.values.push_back(scaled(value));
        return facet;
      }

      void add_lines(const std::vector<std::vector<LinePoint>> &lines, const Projector &project, Layer &layer) const
      {
        for (const auto &line : lines)
          for (std::size_t i = 1; i < line.size(); ++i)
            {
              Stroke stroke{project(line[i - 1].now), project(line[i].now)};
              stroke.mapped = std::isfinite(line[i - 1].value) && std::isfinite(line[i].value);
              stroke.values = {{scaled(line[i - 1].value), scaled(line[i].value)}};
              stroke.plain  = grey;
              stroke.width  = 2.4;
              layer.strokes.push_back(stroke);
            }
      }

      const Style                     &style_;
      const Frame                     &frame_;
      const std::pair<double, double> &range_;
    };

    void add_length_bar(const Frame &frame, const Layout &layout, Sheet &sheet)
    {
      const double length = round_length((frame.high - frame.low)[0] / 4), right = sheet.width - 24.;
      const double y = sheet.height - 20.;
      Stroke       bar{{{right - length * layout.scale, y, 0}}, {{right, y, 0}}};
      bar.width = 2;
      bar.plain = dark;
      sheet.lines.push_back(bar);
      sheet.words.push_back({right, y - 8, length_text(length), 14, Words::Anchor::right});
    }
  } // namespace

  std::optional<std::vector<double>> values_of(const Body &body, const std::string &field)
  {
    std::vector<double> values;
    if (const Field *whole = body.find(field))
      {
        for (std::size_t p = 0; p < body.rest.size(); ++p)
          values.push_back(whole->norm(p));
        return values;
      }
    const std::size_t blank = field.size() < 3 ? 0 : field.size() - 2;
    const Field      *whole = body.find(field.substr(0, blank));
    if (whole == nullptr || whole->n_components != 3 || field[blank] != ' ' || field.back() < 'x' || field.back() > 'z')
      return std::nullopt;
    for (std::size_t p = 0; p < body.rest.size(); ++p)
      values.push_back(whole->values[3 * p + static_cast<std::size_t>(field.back() - 'x')]);
    return values;
  }

  std::vector<std::string> colourable_fields(const Body &body)
  {
    std::vector<std::string> names;
    for (const Field &field : body.fields)
      {
        names.push_back(field.name);
        if (field.n_components == 3)
          for (const char *component : {" x", " y", " z"})
            names.push_back(field.name + component);
      }
    return names;
  }

  std::string first_field(const Body &body)
  {
    for (const char *name : {"stretch", "strain rate", "active stress", "pressure", "displacement"})
      if (body.find(name) != nullptr)
        return name;
    return body.fields.empty() ? "" : body.fields.front().name;
  }

  Frame frame_of(const std::vector<Panel> &panels, const Style &style)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    Frame        frame{view_of(*panels.front().body, style.azimuth, style.elevation), {}, {}, {infinity, -infinity}};
    for (unsigned int c = 0; c < 3; ++c)
      {
        frame.low[c]  = infinity;
        frame.high[c] = -infinity;
      }
    for (const Panel &panel : panels)
      {
        const auto values = values_of(*panel.body, style.field);
        if (!values)
          throw InputError(InputProblem{"--field", "there is no field \"" + style.field + "\" at " + panel.title,
                                        "one of " + join(colourable_fields(*panel.body)),
                                        "run it again with the field in output/fields/what"});
        for (const double value : *values)
          if (std::isfinite(value))
            frame.range = {std::min(frame.range.first, value), std::max(frame.range.second, value)};
        for (const auto *places : {&panel.body->rest, &panel.body->now})
          for (const Vec &x : *places)
            {
              const Vec seen = frame.view.seen(x);
              for (unsigned int c = 0; c < 3; ++c)
                {
                  frame.low[c]  = std::min(frame.low[c], seen[c]);
                  frame.high[c] = std::max(frame.high[c], seen[c]);
                }
            }
      }
    if (!(frame.range.first <= frame.range.second))
      throw InputError(
          InputProblem{"--field", "the field \"" + style.field + "\" has no finite value at these times", "another field", ""});
    return frame;
  }

  void widen(Frame &frame, const Frame &other)
  {
    for (unsigned int c = 0; c < 3; ++c)
      {
        frame.low[c]  = std::min(frame.low[c], other.low[c]);
        frame.high[c] = std::max(frame.high[c], other.high[c]);
      }
    frame.range = {std::min(frame.range.first, other.range.first), std::max(frame.range.second, other.range.second)};
  }

  Sheet sheet_of(const std::vector<Panel> &panels, const Style &style, const Frame &frame)
  {
    const Layout                    layout = layout_of(panels.size(), frame, style.width);
    const std::pair<double, double> range  = style.range.value_or(drawn_range(style.field, frame.range));
    Sheet                           sheet;
    sheet.width  = style.width;
    sheet.height = static_cast<unsigned int>(std::max(layout.height * layout.rows, 260.));
    sheet.map    = map_for(style.field, range);
    sheet.layers.resize(2);
    sheet.layers[1].opacity = 0.3;
    const BodyPainter painter(style, frame, range);
    for (std::size_t p = 0; p < panels.size(); ++p)
      {
        const Projector project(frame, layout, p);
        painter.paint(panels[p], project, sheet.layers[0], sheet.layers[1]);
        sheet.words.push_back({layout.width * (static_cast<double>(p % layout.columns) + 0.5), layout.height * row_of(p, layout) + 24,
                               panels[p].title, 16, Words::Anchor::middle});
        sheet.title += (sheet.title.empty() ? "" : "; ") + panels[p].title;
      }
    sheet.title = "The body coloured by " + style.field + ": " + sheet.title;
    if (sheet.map == ColourMap::tissues)
      {
        std::map<int, std::string> present;
        for (const Panel &panel : panels)
          present.merge(panel.body->tissues_present());
        add_tissue_key(present, sheet.width - Layout::bar + 24, 64, 22, sheet);
      }
    else
      add_colour_bar(style.field, range, sheet.width - Layout::bar + 24, 64, 22, std::min(300., sheet.height - 150.), sheet);
    add_length_bar(frame, layout, sheet);
    return sheet;
  }
} // namespace myolines::picture
