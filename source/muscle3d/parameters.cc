#include <myolines/base/names.h>
#include <myolines/fem/distortion.h>
#include <myolines/muscle3d/formula.h>
#include <myolines/muscle3d/parameters.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    const std::array<const char *, 3> axes{{"x", "y", "z"}};

    Schema geometry_schema()
    {
      Schema block("Box with one corner at the origin; its faces are x-, x+, y-, y+, z-, z+.");
      block.number("length", 0.03, "m", Range::positive(), "Extent along x, the line of action.")
          .number("width", 0.01, "m", Range::positive(), "Extent along y.")
          .number("height", 0.01, "m", Range::positive(), "Extent along z.")
          .integer("cells x", 1, Range::closed(1, 1000), "Coarse cells along x.")
          .integer("cells y", 1, Range::closed(1, 1000), "Coarse cells along y.")
          .integer("cells z", 1, Range::closed(1, 1000), "Coarse cells along z.")
          .integer("refinement", 3, Range::closed(0, 8), "Each refinement halves the cells in all directions.")
          .number("distortion", 0, "-", Range::closed(0, largest_distortion),
                  "Shifts the vertices of the refined mesh at random, always the same way, by up to this part of a cell in each direction; "
                  "the box keeps its shape.");
      return Schema("Reference body and its mesh.").variant("type", "block", {{"block", block}}, "Shape of the body.");
    }

    Schema muscle_schema()
    {
      Schema fibre("Hill-type fibres, sigma = sigma0 (a sA(lam) sV(e) + sP(lam)), thesis (5.2.5) and appendix A.2.");
      fibre.number("maximum isometric stress", 2e5, "Pa", Range::not_negative(), "sigma0 of the fibres.")
          .number("maximum strain rate", 5, "1/s", Range::positive(), "Maximum unloaded strain rate e0.")
          .boolean("force-velocity", true, "Whether the active stress depends on the strain rate (quasi-static: never).");

      Schema base("Isotropic base material, Yeoh: Psi = factor * scale * sum c_k (I1 - 3)^k.");
      base.number("stress scale", 2e5, "Pa", Range::not_negative(), "sigma0 of the base material.")
          .number("factor", 1, "-", Range::not_negative(), "Multiplies the stress scale.")
          .number("c1", 0.1990559575103343, "-", Range::any(), "First Yeoh constant.")
          .number("c2", 0.3662334826469149, "-", Range::any(), "Second Yeoh constant.")
          .number("c3", 0, "-", Range::any(), "Third Yeoh constant.");

      Schema muscle("Muscle tissue: fibres in a nearly incompressible base material.");
      muscle.number("density", 1060, "kg/m^3", Range::positive(), "Mass per reference volume.")
          .number("bulk modulus", 1e7, "Pa", Range::positive(), "kappa of Psi_vol = kappa/4 (D^2 - 2 ln D - 1).")
          .section("fibre", fibre)
          .section("base", base);
      return Schema("Materials of the body.").section("muscle", muscle);
    }

    Schema fibres_schema()
    {
      Schema angle("a0 = (cos, 0, sin) of the angle, in the x-z plane.");
      angle.number("angle", 0, "degree", Range::closed(-90, 90), "Pennation angle at rest, from x towards z.");
      Schema direction("a0 along a given vector, normalised.");
      direction.number("x", 1, "-", Range::any(), "x component.")
          .number("y", 0, "-", Range::any(), "y component.")
          .number("z", 0, "-", Range::any(), "z component.");
      return Schema("Fibre direction at rest.")
          .variant("type", "pennation angle", {{"pennation angle", angle}, {"direction", direction}}, "How the direction is given.");
    }

    /// "x", "y", "z" formulas of position and time.
    void add_formulas(Schema &schema, const std::string &prefix, const std::string &what)
    {
      for (const char *axis : axes)
        schema.text(prefix + axis, "0", what + ", " + axis + " component: a formula of x, y, z [m] and t [s].");
    }

    Schema boundary_schema()
    {
      const std::string components = "Which components are prescribed, any of x y z; the others are free.";
      Schema            fixed("The face does not move.");
      fixed.text("components", "x y z", components);

      Schema strain("The face moves by reference length * strain(t) along a direction; prescribed components across it stay zero.");
      strain.text("components", "x y z", components)
          .text("direction", "1 0 0", "Direction of the motion; normalised.")
          .optional_number("reference length", "m", Range::positive(), "Length that the strain refers to; default: length of the block.")
          .section("strain", drive_schema("boundary strain", "-"));

      Schema formula("The face moves by a displacement u(X, t) given by formulas, together with its time derivatives.");
      formula.text("components", "x y z", components);
      add_formulas(formula, "displacement ", "Displacement [m]");
      add_formulas(formula, "velocity ", "Its first time derivative [m/s]");
      add_formulas(formula, "acceleration ", "Its second time derivative [m/s^2]");

      Schema traction("A dead load per reference area.");
      add_formulas(traction, "traction ", "Traction [Pa]");

      Schema each("A named condition on one face.");
      each.text("face", std::nullopt, "Face of the block: " + join(face_names()) + ".");
      each.variant("type", std::nullopt, {{"fixed", fixed}, {"strain", strain}, {"formula", formula}, {"traction", traction}},
                   "Kind of condition.");
      return Schema("Boundary conditions, each a list with a name of your choice; faces without one are free of traction. Where two faces "
                    "meet, the later condition holds on the common edge.")
          .named_sections(each);
    }

    unsigned int read_face(const Node &node)
    {
      const std::string name  = node.text("face");
      const auto        found = std::find(face_names().begin(), face_names().end(), name);
      if (found == face_names().end())
        node.refuse("face", "the block has no face \"" + name + "\"", "one of " + join(face_names()),
                    "nearest: \"" + nearest_name(name, face_names()) + "\"");
      return static_cast<unsigned int>(found - face_names().begin());
    }

    std::array<bool, 3> read_components(const Node &node)
    {
      std::array<bool, 3> chosen{{false, false, false}};
      std::istringstream  words(node.text("components"));
      for (std::string word; words >> word;)
        {
          const auto axis = std::find(axes.begin(), axes.end(), word);
          if (axis == axes.end())
            node.refuse("components", "unknown component \"" + word + "\"", "any of x y z, separated by spaces");
          chosen[axis - axes.begin()] = true;
        }
      if (!chosen[0] && !chosen[1] && !chosen[2])
        node.refuse("components", "no component is named", "any of x y z, separated by spaces");
      return chosen;
    }

    std::array<double, 3> normalised(const std::array<double, 3> &v, const Node &node, const std::string &parameter)
    {
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (!(length > 0) || !std::isfinite(length))
        node.refuse(parameter, "the direction has length " + std::to_string(length), "three finite numbers, not all zero");
      return {{v[0] / length, v[1] / length, v[2] / length}};
    }

    std::array<double, 3> read_direction(const Node &node)
    {
      std::istringstream    words(node.text("direction"));
      std::array<double, 3> v{};
      std::string           rest;
      if (!(words >> v[0] >> v[1] >> v[2]) || (words >> rest))
        node.refuse("direction", "\"" + node.text("direction") + "\" is not a vector", "three numbers separated by spaces");
      return normalised(v, node, "direction");
    }

    std::array<std::string, 3> read_formulas(const Node &node, const std::string &prefix)
    {
      std::array<std::string, 3> text;
      for (unsigned int c = 0; c < 3; ++c)
        try
          {
            text[c] = node.text(prefix + axes[c]);
            const VectorFormula formula(std::array<std::string, 3>{{text[c], "0", "0"}});
          }
        catch (const std::invalid_argument &error)
          {
            node.refuse(prefix + axes[c], error.what(), "one expression of x, y, z, t and pi, e.g. \"0.01*x*sin(2*pi*t)\"");
          }
      return text;
    }

    /// In a dynamic scene the three formulas of a motion must be derivatives of each other: compared with differences.
    void refuse_inconsistent_rates(const Node &node, const BoundaryCondition &condition)
    {
      const VectorFormula    u(condition.displacement), v(condition.velocity), a(condition.acceleration);
      const dealii::Point<3> x(0.0123, 0.0047, 0.0031);
      const double           h     = 1e-4;
      const auto             check = [&](const VectorFormula &f, const VectorFormula &rate, const std::string &name, const unsigned int c) {
        for (const double t : {0.0137, 0.0713, 0.139})
          {
            const double difference = (f(c, x, t + h) - f(c, x, t - h)) / (2 * h), given = rate(c, x, t);
            if (std::abs(difference - given) > 0.02 * std::max(std::abs(difference), std::abs(given)) + 1e-9)
              node.refuse(name + axes[c],
                                      "is " + std::to_string(given) + " at t = " + std::to_string(t) + " s, where its formula should give about " +
                                          std::to_string(difference),
                                      "the time derivative of the formula before it");
          }
      };
      for (unsigned int c = 0; c < 3; ++c)
        if (condition.components[c])
          {
            check(u, v, "velocity ", c);
            check(v, a, "acceleration ", c);
          }
    }

    /// The values a drive takes at its ends, at its kinks and at many instants of the first second must lie in @p range.
    void refuse_values_outside(const Node &node, const Drive &drive, const Range &range, const std::string &quantity)
    {
      std::vector<double> times = drive.kinks(-1e9, 1e9);
      times.insert(times.end(), {-1e9, 1e9});
      for (int i = 0; i <= 1000; ++i)
        times.push_back(1e-3 * i);
      for (const double t : times)
        if (const double value = drive.value(t, Side::right); !range.contains(value))
          node.refuse("type", "the " + quantity + " is " + std::to_string(value) + " at t = " + std::to_string(t) + " s",
                      quantity + " " + range.text());
    }

    BoundaryCondition read_condition(const Node &node, const double block_length, const bool dynamic)
    {
      BoundaryCondition condition;
      condition.name         = node.name();
      condition.scene_path   = node.where("face");
      condition.face         = read_face(node);
      const std::string type = node.text("type");
      if (type != "traction")
        condition.components = read_components(node);
      if (type == "strain")
        {
          condition.type             = BoundaryCondition::Type::strain;
          condition.direction        = read_direction(node);
          condition.reference_length = node.has("reference length") ? node.number("reference length") : block_length;
          condition.strain           = make_drive(node.section("strain"));
          refuse_values_outside(node.section("strain"), *condition.strain, Range{-1, 1e9, true, false}, "boundary strain");
          for (unsigned int c = 0; c < 3; ++c)
            if (condition.direction[c] != 0 && !condition.components[c])
              node.refuse("direction", std::string("the motion has a component ") + axes[c] + " that is not prescribed",
                          "a direction within the components", std::string("add ") + axes[c] + " to \"components\"");
        }
      else if (type == "formula")
        {
          condition.type         = BoundaryCondition::Type::formula;
          condition.displacement = read_formulas(node, "displacement ");
          condition.velocity     = read_formulas(node, "velocity ");
          condition.acceleration = read_formulas(node, "acceleration ");
          if (dynamic)
            refuse_inconsistent_rates(node, condition);
        }
      else if (type == "traction")
        {
          condition.type       = BoundaryCondition::Type::traction;
          condition.traction   = read_formulas(node, "traction ");
          condition.components = {{false, false, false}};
        }
      return condition;
    }

    void refuse_overlaps(const Node &node, const std::vector<BoundaryCondition> &conditions)
    {
      for (std::size_t i = 0; i < conditions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          for (unsigned int c = 0; c < 3; ++c)
            if (conditions[i].face == conditions[j].face && conditions[i].components[c] && conditions[j].components[c])
              node.refuse(conditions[i].name,
                          std::string("prescribes component ") + axes[c] + " of face " + face_names()[conditions[i].face] + ", as \"" +
                              conditions[j].name + "\" does already",
                          "one condition for each component of a face");
    }

    TissueParameters read_tissue(const Node &muscle)
    {
      const Node      &fibre = muscle.section("fibre");
      const Node      &base  = muscle.section("base");
      TissueParameters tissue;
      tissue.density                   = muscle.number("density");
      tissue.bulk_modulus              = muscle.number("bulk modulus");
      tissue.fibre.sigma0              = fibre.number("maximum isometric stress");
      tissue.fibre.maximum_strain_rate = fibre.number("maximum strain rate");
      tissue.fibre.force_velocity      = fibre.boolean("force-velocity");
      tissue.base.scale                = base.number("factor") * base.number("stress scale");
      for (int k = 0; k < 3; ++k)
        tissue.base.c[k] = base.number("c" + std::to_string(k + 1));
      return tissue;
    }

    std::array<double, 3> read_fibre_direction(const Node &fibres)
    {
      if (fibres.text("type") == "direction")
        return normalised({{fibres.number("x"), fibres.number("y"), fibres.number("z")}}, fibres, "type");
      const double angle = fibres.number("angle") * dealii::numbers::PI / 180;
      return {{std::cos(angle), 0, std::sin(angle)}};
    }
  } // namespace

  const std::vector<std::string> &face_names()
  {
    static const std::vector<std::string> names{"x-", "x+", "y-", "y+", "z-", "z+"};
    return names;
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
        .choice("tangent", "exact", {"exact", "symmetrised"},
                "Linearisation: exact (Newton converges quadratically) or its symmetric part.")
        .section("geometry", geometry_schema())
        .section("discretisation", discretisation)
        .section("tissues", muscle_schema())
        .section("fibres", fibres_schema())
        .section("boundary", boundary_schema())
        .optional_section("activation", drive_schema("activation", "-"))
        .optional_section("body force", force);
    return system;
  }

  Muscle3dParameters read_muscle3d(const Node &system)
  {
    Muscle3dParameters p;
    p.dynamic       = system.text("inertia") == "dynamic";
    p.exact_tangent = system.text("tangent") == "exact";
    p.degree        = system.section("discretisation").integer("degree");
    p.n_points      = system.section("discretisation").integer("quadrature points");

    if (p.n_points < p.degree + 1)
      system.section("discretisation")
          .refuse("quadrature points",
                  std::to_string(p.n_points) + " points per direction leave degree " + std::to_string(p.degree) + " without stiffness",
                  "at least " + std::to_string(p.degree + 1) + " (degree + 1)");

    const Node &geometry = system.section("geometry");
    p.geometry.size      = {{geometry.number("length"), geometry.number("width"), geometry.number("height")}};
    p.geometry.cells     = {{static_cast<unsigned int>(geometry.integer("cells x")), static_cast<unsigned int>(geometry.integer("cells y")),
                             static_cast<unsigned int>(geometry.integer("cells z"))}};
    p.geometry.refinement = geometry.integer("refinement");
    p.geometry.distortion = geometry.number("distortion");

    p.tissue          = read_tissue(system.section("tissues").section("muscle"));
    p.fibre_direction = read_fibre_direction(system.section("fibres"));
    for (const Node &condition : system.section("boundary").named())
      p.boundary.push_back(read_condition(condition, p.geometry.size[0], p.dynamic));
    refuse_overlaps(system.section("boundary"), p.boundary);

    if (system.has("activation"))
      {
        p.activation = make_drive(system.section("activation"));
        refuse_values_outside(system.section("activation"), *p.activation, Range::closed(0, 1), "activation");
      }
    if (p.activation && p.activation->identically_zero())
      p.activation = nullptr;
    if (system.has("body force"))
      p.body_force = read_formulas(system.section("body force"), "");
    return p;
  }
} // namespace myolines
