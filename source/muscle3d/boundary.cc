#include <myolines/base/names.h>
#include <myolines/muscle3d/boundary.h>
#include <myolines/muscle3d/entries.h>
#include <myolines/muscle3d/formula.h>

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

    /// Part of a face that a load acts on.
    void add_box(Schema &schema)
    {
      for (const char *axis : axes)
        for (const char *end : {" from", " to"})
          schema.optional_number(axis + std::string(end), "m", Range::any(),
                                 "The load acts only on this part of the face, decided point by point; default: all of it.");
    }

    void read_box(const Node &node, BoundaryCondition &condition)
    {
      for (unsigned int c = 0; c < 3; ++c)
        {
          const std::string from = axes[c] + std::string(" from"), to = axes[c] + std::string(" to");
          condition.low[c]  = node.has(from) ? node.number(from) : -BoundaryCondition::infinity;
          condition.high[c] = node.has(to) ? node.number(to) : BoundaryCondition::infinity;
          if (!(condition.low[c] < condition.high[c]))
            node.refuse(to, "the loaded part is empty", "more than \"" + from + "\"");
        }
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

    BoundaryCondition read_condition(const Node &node, const Geometry &geometry, const bool dynamic)
    {
      BoundaryCondition condition;
      condition.name         = node.name();
      condition.scene_path   = node.where("face");
      condition.face         = read_face(node, "face", face_names(geometry));
      const std::string type = node.text("type");
      if (type == "traction" || type == "pressure")
        {
          condition.components = {{false, false, false}};
          read_box(node, condition);
        }
      else
        condition.components = read_components(node);
      if (type == "strain")
        {
          condition.type             = BoundaryCondition::Type::strain;
          condition.direction        = read_direction(node, "direction");
          condition.reference_length = node.has("reference length") ? node.number("reference length") : geometry.size[0];
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
          condition.type     = BoundaryCondition::Type::traction;
          condition.traction = read_formulas(node, "traction ");
        }
      else if (type == "pressure")
        {
          condition.type     = BoundaryCondition::Type::pressure;
          condition.pressure = node.number("pressure");
          if (node.has("profile"))
            condition.profile = make_drive(node.section("profile"));
        }
      return condition;
    }

    void refuse_overlaps(const Node &node, const std::vector<BoundaryCondition> &conditions, const std::vector<std::string> &faces)
    {
      for (std::size_t i = 0; i < conditions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          for (unsigned int c = 0; c < 3; ++c)
            if (conditions[i].face == conditions[j].face && conditions[i].components[c] && conditions[j].components[c])
              node.refuse(conditions[i].name,
                          std::string("prescribes component ") + axes[c] + " of face " + faces[conditions[i].face] + ", as \"" +
                              conditions[j].name + "\" does already",
                          "one condition for each component of a face");
    }

  } // namespace

  Schema boundary_schema()
  {
    const std::string components = "Which components are prescribed, any of x y z; the others are free.";
    Schema            fixed("The face does not move.");
    fixed.text("components", "x y z", components);

    Schema strain("The face moves by reference length * strain(t) along a direction; prescribed components across it stay zero.");
    strain.text("components", "x y z", components)
        .text("direction", "1 0 0", "Direction of the motion; normalised.")
        .optional_number("reference length", "m", Range::positive(),
                         "Length that the strain refers to; default: length of the body along x.")
        .section("strain", drive_schema("boundary strain", "-"));

    Schema formula("The face moves by a displacement u(X, t) given by formulas, together with its time derivatives.");
    formula.text("components", "x y z", components);
    add_formulas(formula, "displacement ", "Displacement [m]");
    add_formulas(formula, "velocity ", "Its first time derivative [m/s]");
    add_formulas(formula, "acceleration ", "Its second time derivative [m/s^2]");

    Schema traction("A dead load per reference area.");
    add_formulas(traction, "traction ", "Traction [Pa]");
    add_box(traction);

    Schema pressure("A dead load along the inward normal of the face at rest, per reference area.");
    pressure.number("pressure", std::nullopt, "Pa", Range::any(), "Force per reference area.")
        .optional_section("profile", drive_schema("factor of the pressure", "-"));
    add_box(pressure);

    Schema each("A named condition on one face.");
    each.text("face", std::nullopt, "Face of the body, by a name of its geometry.");
    each.variant("type", std::nullopt,
                 {{"fixed", fixed}, {"strain", strain}, {"formula", formula}, {"traction", traction}, {"pressure", pressure}},
                 "Kind of condition.");
    return Schema("Boundary conditions, each a list with a name of your choice; faces without one are free of traction. Where two faces "
                  "meet, the later condition holds on the common edge.")
        .named_sections(each);
  }

  std::vector<BoundaryCondition> read_boundary(const Node &node, const Geometry &geometry, const bool dynamic)
  {
    std::vector<BoundaryCondition> conditions;
    for (const Node &condition : node.named())
      conditions.push_back(read_condition(condition, geometry, dynamic));
    refuse_overlaps(node, conditions, face_names(geometry));
    return conditions;
  }
} // namespace myolines
