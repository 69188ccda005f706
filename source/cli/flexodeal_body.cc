// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_body.h"

#include <myolines/base/names.h>
#include <myolines/body/body_fields.h>
#include <myolines/muscle3d/plausibility.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    constexpr double length_told = 1e-3; // of a direction, from 1: what is written with four digits is meant to be a unit vector

    using scene::format_number;

    void take_length(FlexodealTranslation &t, const std::string &name, const std::string &parameter, const double scale)
    {
      const double length = t.theirs.positive("Geometry", name);
      t.set("system/geometry/" + parameter, format_number(scale * length), t.theirs.where(t.theirs.needed("Geometry", name)));
    }

    void change_refinement(FlexodealTranslation &t, FlexodealBody &body, const int refinement, const std::string &why)
    {
      if (body.refinement != refinement)
        t.out << "changed: Geometry / Global refinement = " << body.refinement << " becomes " << refinement << " (" << why << ")\n";
      body.refinement = refinement;
    }

    void add_block(FlexodealTranslation &t, FlexodealBody &body, const double scale)
    {
      t.set("system/geometry/type", "block");
      take_length(t, "Length", "length", scale);
      take_length(t, "Width", "width", scale);
      take_length(t, "Height", "height", scale);
      change_refinement(t, body, std::max(1, body.refinement), "Flexodeal refines a block at least once");
    }

    void add_gastrocnemius(FlexodealTranslation &t, FlexodealBody &body, const double scale)
    {
      if (const PrmEntry *entry = t.theirs.optional("Geometry", "Fibre length"))
        t.theirs.refuse(*entry, "the idealised gastrocnemius, with Aponeurosis length and the Pennation angle to the line of action",
                        "the belly between parallel sheets is no body of this program: give its mesh with --mesh");
      body.geometry.gastrocnemius.emplace();
      t.set("system/geometry/type", "idealised gastrocnemius");
      take_length(t, "Muscle length", "muscle length", scale);
      take_length(t, "Aponeurosis length", "aponeurosis length", scale);
      take_length(t, "Aponeurosis height", "aponeurosis height", scale);
      take_length(t, "Muscle width", "width", scale);
      t.take("Geometry", "Pennation angle", "system/geometry/pennation angle");
    }

    void add_mesh(FlexodealTranslation &t, FlexodealBody &body, const double scale)
    {
      const std::string where = "command line: --mesh";
      const PrmEntry   &given = t.theirs.needed("Geometry", "Grid scale");
      const auto        mesh  = std::make_shared<const MeshBody>(t.options.mesh, scale, where);
      body.geometry.mesh      = mesh;
      for (unsigned int c = 0; c < 3; ++c)
        body.geometry.size[c] = mesh->high[c] - mesh->low[c];
      if (!implausible_size(body.geometry).empty())
        {
          const auto [least, most] = std::minmax_element(body.geometry.size.begin(), body.geometry.size.end());
          const double factor      = probable_scale(body.geometry);
          t.theirs.refuse(given, "the factor that makes metres of the coordinates of the mesh",
                          "the mesh would be " + format_number(*most) + " m long and " + format_number(*least) + " m thin" +
                              (factor == 0 ? "" : "; probably right: set Grid scale = " + format_number(factor * scale)));
        }
      t.set("system/geometry/type", "mesh");
      t.set("system/geometry/file", t.from_scene(t.options.mesh), t.options.mesh.string());
      t.set("system/geometry/scale", format_number(scale), t.theirs.where(given));
      change_refinement(t, body, 0, "Flexodeal does not refine meshes of files");
    }

    void add_table(FlexodealTranslation &t, FlexodealBody &body)
    {
      const PrmEntry *entry = t.theirs.optional("Materials", "QP list filename");
      if (t.options.points.empty())
        {
          if (entry != nullptr)
            t.out << "not carried over: Materials / QP list filename = " << entry->text << " (give the file with --qp-table)\n";
          return;
        }
      const PointProperties table(t.options.points);
      body.table_directions     = table.has_directions();
      body.table_fat            = table.has_fat();
      const std::size_t n_kinds = tissue_kinds().size();
      for (const unsigned int id : table.tissues())
        if (id > n_kinds)
          throw InputError(InputProblem{t.options.points.string() + ", column \"tissue_id\"",
                                        "there is no tissue " + std::to_string(id) + " in Flexodeal", "1 to " + std::to_string(n_kinds),
                                        ""});
        else
          body.tissues.push_back(tissue_kinds()[id - 1].name);
      t.set("system/fields/table", t.from_scene(t.options.points));
      t.set_origin("system/fields", "", t.options.points.string());
    }

    /// Fibres in a mesh have the directions of the body of the parameters, where no table says otherwise.
    void add_pennation(FlexodealTranslation &t, const FlexodealBody &body)
    {
      const double angle  = t.theirs.number("Geometry", "Pennation angle");
      const bool   sheets = t.theirs.optional("Geometry", "Fibre length") != nullptr; // along x, and fibres lean backwards
      t.set("system/fibres/angle", format_number(sheets ? -angle : angle), t.theirs.where(t.theirs.needed("Geometry", "Pennation angle")));
      if (body.has("tendon"))
        t.set("system/tissues/tendon/fibre/direction", "1 0 0");
      if (!body.has("aponeurosis"))
        return;
      std::array<double, 3> along{{1, 0, 0}};
      if (!sheets)
        {
          Gastrocnemius shape;
          shape.muscle_length      = t.theirs.positive("Geometry", "Muscle length");
          shape.aponeurosis_length = t.theirs.positive("Geometry", "Aponeurosis length");
          shape.pennation          = angle;
          if (!(shape.aponeurosis_length > shape.muscle_length * std::abs(std::sin(angle * dealii::numbers::PI / 180))))
            t.theirs.refuse(t.theirs.needed("Geometry", "Aponeurosis length"), "more than Muscle length times the sine of Pennation angle");
          along = shape.aponeurosis_direction();
        }
      t.set("system/tissues/aponeurosis/fibre/direction",
            format_number(along[0]) + " " + format_number(along[1]) + " " + format_number(along[2]));
    }
  } // namespace

  bool FlexodealBody::has(const std::string &tissue) const { return std::find(tissues.begin(), tissues.end(), tissue) != tissues.end(); }

  std::string FlexodealBody::face(const int boundary_id) const
  {
    const std::vector<std::string> &names = face_names(geometry);
    if (!geometry.mesh)
      return boundary_id < static_cast<int>(names.size()) ? names[boundary_id] : "";
    const std::string number = std::to_string(boundary_id);
    if (std::find(names.begin(), names.end(), number) != names.end() || geometry.mesh->further_names.count(number) != 0)
      return number;
    return boundary_id == 0 ? MeshBody::rest : ""; // deal.II writes no faces with the number 0
  }

  std::string FlexodealBody::faces() const { return join(face_names(geometry)); }

  FlexodealBody add_body(FlexodealTranslation &t)
  {
    FlexodealBody body;
    const double  scale = t.theirs.positive("Geometry", "Grid scale");
    body.refinement     = t.theirs.integer("Geometry", "Global refinement", 0, 8);
    if (!t.options.mesh.empty())
      add_mesh(t, body, scale);
    else if (t.theirs.has("Geometry", "Muscle length"))
      add_gastrocnemius(t, body, scale);
    else
      add_block(t, body, scale);
    t.set("system/geometry/refinement", std::to_string(body.refinement), t.theirs.where(t.theirs.needed("Geometry", "Global refinement")));
    body.tissues = tissues_of(body.geometry);
    add_table(t, body);
    return body;
  }

  void add_fibres(FlexodealTranslation &t, const FlexodealBody &body)
  {
    if (t.theirs.has("Geometry", "Pennation angle"))
      {
        t.set("system/fibres/type", "pennation angle");
        if (body.geometry.mesh)
          add_pennation(t, body);
        return;
      }
    std::array<double, 3> direction{{1, 0, 0}}; // Flexodeal's default
    std::string           first;                // where it gives a component
    for (unsigned int c = 0; c < 3; ++c)
      {
        const std::string axis(1, "xyz"[c]), entry = "Muscle " + axis + " component";
        if (!t.theirs.has("Materials", entry))
          continue;
        t.take("Materials", entry, "system/fibres/" + axis);
        direction[c] = t.theirs.number("Materials", entry);
        if (first.empty())
          first = t.theirs.where(t.theirs.needed("Materials", entry));
      }
    t.set("system/fibres/type", "direction", first);
    const double length = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    if (length > 0 && std::abs(length - 1) > length_told)
      t.out << "changed: " << first << " and the other components make a vector of length " << length << ", which becomes 1\n";
    if (first.empty() && !body.table_directions)
      t.out << "assumed: Materials / Muscle x component is not set; the fibres lie along x, as in Flexodeal by default\n";
  }
} // namespace myolines
