// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/body/entries.h>
#include <myolines/muscle3d/activation.h>
#include <myolines/muscle3d/parameters.h>
#include <myolines/scene/node_builder.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    Schema tissues_schema()
    {
      Schema tissues("Materials of the body.");
      tissues
          .choice("volumetric energy", volume_form_names[0], {std::begin(volume_form_names), std::end(volume_form_names)},
                  "Psi_vol of the dilatation D, of all tissues: thesis kappa/4 (D^2 - 2 ln D - 1), quadratic kappa/2 (D - 1)^2, "
                  "logarithmic kappa/2 (ln D)^2, which is not convex where D > e.")
          .optional_section("curves", curves_schema());
      for (const TissueKind &kind : tissue_kinds())
        if (kind.id == muscle_id)
          tissues.section(kind.name, tissue_schema(kind));
        else
          tissues.optional_section(kind.name, tissue_schema(kind));
      tissues.optional_section("own", Schema("Tissues of your own, each a list with a name of your choice, under which it is reported.")
                                          .named_sections(own_tissue_schema()));
      return tissues;
    }

    Schema fibres_schema()
    {
      Schema angle("a0 = (cos, 0, sin) of the angle, in the x-z plane.");
      angle.optional_number(
          "angle", "degree", Range::closed(-90, 90),
          "Pennation angle at rest, from x towards z; default: that of the geometry, 0 for a block; of a mesh: along the line of action.");
      Schema direction("a0 along a given vector, normalised.");
      direction.number("x", 1, "-", Range::any(), "x component.")
          .number("y", 0, "-", Range::any(), "y component.")
          .number("z", 0, "-", Range::any(), "z component.");
      Schema formula("a0 along a vector that varies in space, normalised point by point.");
      add_formulas(formula, "", "Direction", "volume (the number of the group of the cell in a mesh)");
      Schema laplace(
          "a0 along the gradient of the solution of Laplace's equation between two faces: fibres run from face to face and along "
          "all others, Choi and Blemker (2013).");
      laplace.text("from", std::nullopt, "Face where fibres begin, by a name of the geometry, for example \"x-\".")
          .text("to", std::nullopt, "Face where they end, for example \"x+\".");
      return Schema("Fibre direction at rest, of the muscle.")
          .variant("type", "pennation angle",
                   {{"pennation angle", angle}, {"direction", direction}, {"formula", formula}, {"laplace", laplace}},
                   "How the direction is given.");
    }

    FibresBetweenFaces read_laplace(const Node &fibres, const Geometry &geometry)
    {
      const FibresBetweenFaces between{read_face(fibres, "from", geometry), read_face(fibres, "to", geometry)};
      if (between.from == between.to)
        fibres.refuse("to", "is the face where fibres begin, too", "another face");
      return between;
    }

    /// Direction of the muscle fibres where nothing in the body says otherwise.
    std::array<double, 3> read_fibre_direction(const Node &fibres, const Muscle3dParameters &p, const LineChoice &line)
    {
      const std::string type = fibres.text("type");
      if (type == "direction")
        return unit_vector({{fibres.number("x"), fibres.number("y"), fibres.number("z")}}, fibres, "type");
      if (type == "pennation angle" && fibres.has("angle"))
        {
          const double angle = fibres.number("angle") * dealii::numbers::PI / 180;
          return {{std::cos(angle), 0, std::sin(angle)}};
        }
      if (p.geometry.gastrocnemius)
        return p.geometry.gastrocnemius->fibre_direction();
      const bool elsewhere = type != "pennation angle" || (p.fields.table && p.fields.table->has_directions());
      if (!p.geometry.mesh || (elsewhere && !line.line))
        return {{1, 0, 0}};
      if (!line.line) // a mesh may lie in any direction; so may its fibres
        fibres.refuse(
            "type", "the fibres of the mesh have no direction, and there is no line of action that they could follow",
            "\"direction\", \"formula\" or \"laplace\", a table in \"system/fields\" with directions, or an \"angle\" from x towards z");
      return {{line.line->direction[0], line.line->direction[1], line.line->direction[2]}};
    }

    /// Those of the scene's own.
    void read_own_tissues(const Node &lists, const std::vector<std::string> &of_body, const std::array<double, 3> &along,
                          Muscle3dParameters &p)
    {
      for (const Node &list : lists.named())
        {
          const bool needed = std::find(of_body.begin(), of_body.end(), list.name()) != of_body.end();
          if (!needed && p.fields.tissue.empty())
            lists.refuse(list.name(), "the body has no cells of " + list.name(), "no such list for this geometry",
                         "a block takes the tissue that \"geometry/tissue\" names, a mesh those of its groups of cells");
          TissueParameters &tissue = p.tissues[tissue_id(p.tissue_names, list.name())] = read_own_tissue(list);
          tissue.fibre.follows_body                                                    = !list.has("direction");
          tissue.fibre.direction = list.has("direction") ? read_direction(list, "direction") : along;
        }
    }

    /// Laws that would do nothing.
    void refuse_rates_at_rest(const Node &lists, const Muscle3dParameters &p)
    {
      for (const auto &[id, tissue] : p.tissues)
        for (const TissuePart &part : tissue.laws)
          if (!p.dynamic && part.law->kind.rates == Rates::all)
            {
              const Node &list = id > tissue_kinds().size() ? lists.section("own") : lists;
              list.refuse(p.tissue_names[id - 1] + "/laws/" + part.name,
                          "is a law of strain rates alone (" + part.law->kind.name + "), which a quasi-static system leaves out",
                          "system/inertia = dynamic, or no such law");
            }
    }

    /// Whether @p list says nothing but defaults, as in a scene that is written out whole.
    bool says_nothing(const Node &list, const Schema &schema)
    {
      std::vector<InputProblem> problems;
      const Node                usual = scene::NodeBuilder("", "", problems).build(nullptr, schema, list.name(), list.path());
      return scene::resolved_xml(list, list.name()) == scene::resolved_xml(usual, list.name());
    }

    /// The tissues that the body has cells of, with their directions.
    void read_tissues(const Node &system, const LineChoice &line, Muscle3dParameters &p)
    {
      const Node              &lists   = system.section("tissues");
      std::vector<std::string> of_body = tissues_of(p.geometry);
      if (p.fields.table)
        for (const unsigned int id : p.fields.table->tissues())
          {
            if (id > p.tissue_names.size())
              system.section("fields").refuse("table", "names tissue " + std::to_string(id),
                                              "1 to " + std::to_string(p.tissue_names.size()));
            of_body.push_back(p.tissue_names[id - 1]);
          }
      p.tissues.clear();
      const auto form = std::find(std::begin(volume_form_names), std::end(volume_form_names), lists.text("volumetric energy"));
      p.volume_form   = static_cast<VolumeForm>(form - std::begin(volume_form_names));
      if (lists.has("curves"))
        p.curves = read_curves(lists.section("curves"));
      const Node                 &fibres = system.section("fibres");
      const std::array<double, 3> along  = read_fibre_direction(fibres, p, line);
      if (fibres.text("type") == "pennation angle" && fibres.has("angle"))
        p.pennation_angle = fibres.number("angle");
      for (const TissueKind &kind : tissue_kinds())
        {
          const bool needed = std::find(of_body.begin(), of_body.end(), kind.name) != of_body.end();
          const bool given  = kind.id == muscle_id ? needed || lists.written(kind.name) : lists.has(kind.name);
          const bool named  = given && !p.fields.tissue.empty(); // a formula may name any that has a list
          if (needed && !given)
            lists.refuse(kind.name, "the body has cells of " + kind.name + ", but this list is missing", "a list \"" + kind.name + "\"",
                         "an empty list takes all defaults");
          if (!needed && given && !named && !(kind.id == muscle_id && says_nothing(lists.section(kind.name), tissue_schema(kind))))
            lists.refuse(kind.name, "the body has no cells of " + kind.name, "no such list for this geometry", "remove it");
          if (kind.id == muscle_id)
            p.has_muscle = needed || named;
          else if (!needed && !named)
            continue;
          TissueParameters &tissue = p.tissues[kind.id] = read_tissue(kind, lists.section(kind.name));
          tissue.fibre.direction                        = along;
          if (kind.id == muscle_id)
            {
              if (p.fields.has_matrix() && !tissue.matrix)
                lists.section(kind.name).section("base").refuse("type", "system/fields gives fractions of extracellular matrix",
                                                                "\"matrix and cells\"");
              continue;
            }
          const Node &fibre = lists.section(kind.name).section("fibre");
          if (fibre.has("direction"))
            tissue.fibre.direction = read_direction(fibre, "direction");
          else if (p.geometry.gastrocnemius)
            tissue.fibre.direction = p.geometry.gastrocnemius->aponeurosis_direction();
        }
      if (lists.has("own"))
        read_own_tissues(lists.section("own"), of_body, along, p);
      refuse_rates_at_rest(lists, p);
    }
    /// Of the choice `tangent`. The thesis takes the change of the strain rate for that of the stretch over the step, (5.7.8), and tells of
    /// formulas before it, (5.7.14) and (5.7.15); Flexodeal was first published with five times that term.
    RateTangent rate_tangent(const std::string &name)
    {
      if (name == "thesis")
        return {1, 0, 0};
      if (name == "flexodeal")
        return {5, 0, 0};
      if (name == "ross")
        return {0, 0, -1};
      if (name == "tam")
        return {0, 0, 1};
      return {};
    }
  } // namespace

  TissueNames read_tissue_names(const Node &lists)
  {
    TissueNames names = printed_tissues();
    if (lists.has("own"))
      for (const Node &own : lists.section("own").named())
        {
          if (tissue_id(names, own.name()) != 0)
            lists.section("own").refuse(own.name(), "is the name of a printed tissue", "another name");
          if (names.size() + 1 == CellId::n_tissues)
            lists.section("own").refuse(own.name(), "is one tissue too many", "at most " + std::to_string(names.size()) + " in all");
          names.push_back(own.name());
        }
    return names;
  }

  double Muscle3dParameters::fibre_length() const
  {
    if (geometry.gastrocnemius)
      return geometry.gastrocnemius->fibre_length();
    double length = std::numeric_limits<double>::infinity();
    for (unsigned int c = 0; c < 3; ++c)
      if (muscle().fibre.direction[c] != 0)
        length = std::min(length, geometry.size[c] / std::abs(muscle().fibre.direction[c]));
    return length;
  }

  std::vector<LawPart> Muscle3dParameters::law_parts() const
  {
    std::vector<LawPart> parts;
    for (const auto &[id, tissue] : tissues)
      for (const TissuePart &part : tissue.laws)
        parts.push_back({id, &part, tissue_names[id - 1] + " " + part.name});
    return parts;
  }

  std::size_t Muscle3dParameters::first_law(const unsigned int material_id) const
  {
    std::size_t before = 0;
    for (const auto &[id, tissue] : tissues)
      if (id < material_id)
        before += tissue.laws.size();
    return before;
  }

  bool Muscle3dParameters::viscous() const
  {
    return dynamic && std::any_of(tissues.begin(), tissues.end(), [](const auto &tissue) { return tissue.second.viscous(); });
  }

  scene::Schema muscle3d_schema()
  {
    Schema force("Body force per reference volume.");
    add_formulas(force, "", "Force per reference volume [N/m^3]");

    Schema discretisation("Continuous displacements of degree k; pressure and dilatation of degree k - 1, eliminated cell by cell.");
    discretisation.integer("degree", 2, Range::closed(1, 3), "Degree k of the displacement.")
        .integer("quadrature points", 4, Range::closed(2, 6), "Gauss points per direction; dynamic runs of degree 2 want at least 4.");

    Schema system("Three-dimensional muscle, nearly incompressible and fibre-reinforced, thesis chapters 5 and 6.");
    system.choice("inertia", "dynamic", {"dynamic", "quasi-static"}, "Whether mass and strain rate take part.")
        .choice("tangent", "exact", {"exact", "symmetrised", "thesis", "flexodeal", "ross", "tam"},
                "Linearisation, which changes iterations and not solutions: exact (Newton's method converges quadratically), its symmetric "
                "part, or the force-velocity relation linearised by the strain rate as a function of the stretch alone: (5.7.8) of the "
                "thesis, that five times too large (errata 29), (5.7.14), (5.7.15).")
        .section("geometry", geometry_schema())
        .section("discretisation", discretisation)
        .section("tissues", tissues_schema())
        .section("fibres", fibres_schema())
        .optional_section("fields", fields_schema())
        .section("boundary", boundary_schema())
        .optional_section("line of action", line_of_action_schema())
        .optional_section("body force", force)
        .optional_section("initial motion", initial_motion_schema());
    add_activation(system);
    return system;
  }

  Muscle3dParameters read_muscle3d(const Node &system)
  {
    Muscle3dParameters p;
    p.dynamic       = system.text("inertia") == "dynamic";
    p.exact_tangent = system.text("tangent") != "symmetrised";
    p.rate_tangent  = rate_tangent(system.text("tangent"));
    p.degree        = system.section("discretisation").integer("degree");
    p.n_points      = system.section("discretisation").integer("quadrature points");

    if (p.n_points < p.degree + 1)
      system.section("discretisation")
          .refuse("quadrature points",
                  std::to_string(p.n_points) + " points per direction leave degree " + std::to_string(p.degree) + " without stiffness",
                  "at least " + std::to_string(p.degree + 1) + " (degree + 1)");

    p.tissue_names = read_tissue_names(system.section("tissues"));
    p.geometry     = read_geometry(system.section("geometry"), p.tissue_names);
    if (system.has("fields"))
      p.fields = read_fields(system.section("fields"));
    if (system.section("fibres").text("type") == "formula")
      p.fields.direction = read_formulas(system.section("fibres"), "", "volume");
    if (system.section("fibres").text("type") == "laplace")
      p.fields.laplace = read_laplace(system.section("fibres"), p.geometry);
    p.line     = read_line_of_action(system, p.geometry);
    p.boundary = read_boundary(system.section("boundary"), p.geometry, p.line, p.dynamic);

    const LineChoice line = find_line_of_action(p.line, p.geometry, facts_of(p.boundary));
    if (!line.line && system.has("line of action"))
      system.refuse("line of action", "there is no such line: " + line.why_none,
                    "two faces \"from\" and \"to\" that are apart, a \"direction\"", "`myolines check` lists the faces");
    read_tissues(system, line, p);

    read_activation(system, p);
    if (system.has("body force"))
      p.body_force = read_formulas(system.section("body force"), "");
    if (system.has("initial motion"))
      p.initial = read_initial_motion(system.section("initial motion"), p.dynamic);
    return p;
  }
} // namespace myolines
