// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_fields.h"

#include <myolines/base/error.h>
#include <myolines/body/cell_id.h>
#include <myolines/materials/tissue.h>
#include <myolines/meshes/field_grid.h>
#include <myolines/picture/body.h>
#include <myolines/picture/colours.h>
#include <myolines/scene/document.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>

namespace myolines::picture
{
  namespace
  {
    const char *const expected_list = "the list of fields that a run writes";

    /// The text between @p before and the next @p after in @p text from @p at on, which goes behind it; nothing if there is none.
    std::optional<std::string> between(const std::string &text, const std::string &before, const std::string &after, std::size_t &at)
    {
      const std::size_t begin = text.find(before, at);
      if (begin == std::string::npos)
        return std::nullopt;
      const std::size_t end = text.find(after, begin + before.size());
      if (end == std::string::npos)
        return std::nullopt;
      at = end + after.size();
      return text.substr(begin + before.size(), end - begin - before.size());
    }

    /// What stands before @p colon, up to a blank: "fields-0000.h5" of "fields-0000.h5:/stretch".
    std::string word_before(const std::string &text, const std::size_t colon)
    {
      const std::size_t begin = colon == std::string::npos ? colon : text.find_last_of(" \n\t>", colon);
      return begin == std::string::npos ? "" : text.substr(begin + 1, colon - begin - 1);
    }

    double time_in(const std::optional<std::string> &text, const std::filesystem::path &file)
    {
      const auto t = text ? scene::parse_number(*text) : std::nullopt;
      if (!t)
        throw InputError(InputProblem{file.string(), "an instant has no time", expected_list, "the file is damaged"});
      return *t;
    }

    /// A file beside the list, never elsewhere.
    std::filesystem::path beside(const std::filesystem::path &list, const std::string &name)
    {
      if (name.empty() || std::filesystem::path(name).filename() != name || name == "." || name == "..")
        throw InputError(InputProblem{list.string(), "it names the file \"" + name + "\"", "a file in its own folder", ""});
      return list.parent_path() / name;
    }

    std::vector<std::filesystem::path> pieces(const std::filesystem::path &record)
    {
      const std::string                  text = scene::read_input_bytes(record);
      std::vector<std::filesystem::path> files;
      std::size_t                        at = 0;
      while (const auto name = between(text, "<Piece Source=\"", "\"", at))
        files.push_back(beside(record, *name));
      if (files.empty())
        throw InputError(InputProblem{record.string(), "it names no pieces", "<Piece Source=...>", "the file is damaged"});
      return files;
    }

    std::string with_blanks(std::string name)
    {
      std::replace(name.begin(), name.end(), '_', ' ');
      return name;
    }

    /// Cuts cells of degree k into k^3.
    void append(const FieldGrid &grid, Body &body)
    {
      const std::size_t first = body.rest.size();
      for (const PlainMesh::Position &x : grid.points)
        body.rest.push_back(Vec({x[0], x[1], x[2]}));
      for (const auto &cell : grid.cells)
        {
          const auto n = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(cell.size()))));
          for (std::size_t k = 0; k + 1 < n; ++k)
            for (std::size_t j = 0; j + 1 < n; ++j)
              for (std::size_t i = 0; i + 1 < n; ++i)
                {
                  Body::Cell part;
                  for (std::size_t v = 0; v < 8; ++v)
                    part[v] = first + cell[(i + v % 2) + n * ((j + v / 2 % 2) + n * (k + v / 4))];
                  body.cells.push_back(part);
                }
        }
      for (const PlainMesh::Field &field : grid.fields)
        {
          if (field.n_components != 1 && field.n_components != 3)
            continue;
          const std::string name  = with_blanks(field.name);
          auto              there = std::find_if(body.fields.begin(), body.fields.end(), [&](const Field &f) { return f.name == name; });
          if (there == body.fields.end())
            {
              if (first > 0)
                continue; // not in all pieces
              body.fields.push_back({name, field.n_components, {}});
              there = body.fields.end() - 1;
            }
          there->values.insert(there->values.end(), field.values.begin(), field.values.end());
        }
    }

    void move(Body &body)
    {
      body.now = body.rest;
      if (const Field *u = body.find("displacement"); u != nullptr && u->n_components == 3)
        for (std::size_t p = 0; p < body.now.size(); ++p)
          for (unsigned int c = 0; c < 3; ++c)
            body.now[p][c] += u->values[3 * p + c];
      for (const Vec &x : body.now)
        if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
          throw InputError(InputProblem{"displacement", "a value is not finite", "numbers", ""});
    }

    /// Weights of the eight points of a cell.
    std::array<double, 8> weights(const Vec &xi)
    {
      std::array<double, 8> w;
      for (unsigned int v = 0; v < 8; ++v)
        w[v] = (v % 2 ? xi[0] : 1 - xi[0]) * (v / 2 % 2 ? xi[1] : 1 - xi[1]) * (v / 4 ? xi[2] : 1 - xi[2]);
      return w;
    }
  } // namespace

  double Field::norm(const std::size_t point) const
  {
    if (n_components == 1)
      return values[point];
    return std::sqrt(values[3 * point] * values[3 * point] + values[3 * point + 1] * values[3 * point + 1] +
                     values[3 * point + 2] * values[3 * point + 2]);
  }

  const Field *Body::find(const std::string &name) const
  {
    for (const Field &field : fields)
      if (field.name == name)
        return &field;
    return nullptr;
  }

  bool Body::is_on_the_mesh_of(const Body &other) const { return rest == other.rest && cells == other.cells; }

  static_assert(most_tissues == CellId::n_tissues - 1, "a colour for each");

  std::map<int, std::string> Body::tissues_present() const
  {
    std::map<int, std::string> present;
    if (const Field *field = find("tissue"))
      for (const double value : field->values)
        if (const long number = std::lround(value); std::isfinite(value) && number >= 1 && number <= most_tissues)
          present[static_cast<int>(number)] =
              static_cast<std::size_t>(number) <= tissues.size() ? tissues[number - 1] : "tissue " + std::to_string(number);
    return present;
  }

  bool RunFields::are_in(const std::filesystem::path &folder)
  {
    return std::filesystem::exists(folder / "fields.pvd") || std::filesystem::exists(folder / "fields.xdmf");
  }

  RunFields::RunFields(const std::filesystem::path &folder)
    : tissues_(printed_tissues())
  {
    if (!std::filesystem::is_directory(folder))
      throw InputError(InputProblem{folder.string(), "there is no such folder", "the output folder of a run", ""});
    if (!are_in(folder))
      throw InputError(InputProblem{folder.string(), "the run wrote no fields",
                                    "fields.pvd or fields.xdmf, which runs of three-dimensional muscles write",
                                    "run it with --set \"output/fields/what=displacement, stretch, fibre direction\""});
    if (const std::filesystem::path scene = folder / "scene.resolved.xml"; std::filesystem::exists(scene))
      for (const std::string &own : scene::lists_at(scene, "system/tissues/own"))
        tissues_.push_back(own);
    hdf5_                            = !std::filesystem::exists(folder / "fields.pvd");
    const std::filesystem::path list = folder / (hdf5_ ? "fields.xdmf" : "fields.pvd");
    const std::string           text = scene::read_input_bytes(list);
    std::size_t                 at   = 0;
    if (hdf5_)
      while (const auto grid = between(text, "<Grid Name=\"mesh\"", "</Grid>", at))
        {
          std::size_t inside = 0;
          const auto  t      = between(*grid, "<Time Value=\"", "\"", inside);
          instants_.push_back(
              {time_in(t, list),
               {beside(list, word_before(*grid, grid->find(":/cells"))), beside(list, word_before(*grid, grid->rfind(":/")))}});
        }
    else
      while (const auto set = between(text, "<DataSet ", "/>", at))
        {
          std::size_t first = 0, second = 0;
          const auto  t    = between(*set, "timestep=\"", "\"", first);
          const auto  name = between(*set, "file=\"", "\"", second);
          instants_.push_back({time_in(t, list), {beside(list, name.value_or(""))}});
        }
    if (instants_.empty())
      throw InputError(InputProblem{list.string(), "it lists no fields", expected_list, "the file is damaged"});
  }

  std::size_t RunFields::nearest(const double t) const
  {
    const auto closer = [t](const Instant &a, const Instant &b) { return std::abs(a.t - t) < std::abs(b.t - t); };
    return static_cast<std::size_t>(std::min_element(instants_.begin(), instants_.end(), closer) - instants_.begin());
  }

  Body RunFields::read(const std::size_t i) const
  {
    const Instant &instant = instants_.at(i);
    Body           body;
    body.t       = instant.t;
    body.tissues = tissues_;
    if (hdf5_)
      append(read_hdf5_fields(instant.files.at(0), instant.files.at(1)), body);
    else if (instant.files.front().extension() == ".pvtu")
      for (const std::filesystem::path &piece : pieces(instant.files.front()))
        append(read_field_grid(piece), body);
    else
      append(read_field_grid(instant.files.front()), body);
    if (body.cells.empty())
      throw InputError(InputProblem{instant.files.front().string(), "there are no cells", "hexahedra", ""});
    for (const Field &field : body.fields)
      if (field.values.size() != field.n_components * body.rest.size())
        throw InputError(InputProblem{
            instant.files.front().string(), "the field \"" + field.name + "\" has " + std::to_string(field.values.size()) + " numbers",
            std::to_string(field.n_components) + " for each of " + std::to_string(body.rest.size()) + " points", "the file is damaged"});
    move(body);
    return body;
  }

  Vec place(const std::vector<Vec> &places, const Body::Cell &cell, const Vec &xi)
  {
    const std::array<double, 8> w = weights(xi);
    Vec                         x;
    for (unsigned int v = 0; v < 8; ++v)
      x += w[v] * places[cell[v]];
    return x;
  }

  std::array<Vec, 3> derivatives(const std::vector<Vec> &places, const Body::Cell &cell, const Vec &xi)
  {
    std::array<Vec, 3> d;
    for (unsigned int c = 0; c < 3; ++c)
      {
        Vec low = xi, high = xi;
        low[c]  = 0;
        high[c] = 1;
        d[c]    = place(places, cell, high) - place(places, cell, low); // linear along each coordinate
      }
    return d;
  }

  double value(const Field &field, const unsigned int component, const Body::Cell &cell, const Vec &xi)
  {
    const std::array<double, 8> w = weights(xi);
    double                      x = 0;
    for (unsigned int v = 0; v < 8; ++v)
      x += w[v] * field.values[cell[v] * field.n_components + component];
    return x;
  }
} // namespace myolines::picture
