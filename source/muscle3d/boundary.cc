// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/muscle3d/boundary.h>
#include <myolines/muscle3d/entries.h>
#include <myolines/muscle3d/formula.h>
#include <myolines/muscle3d/line_of_action.h>
#include <myolines/system/file_drive.h>

#include <algorithm>
#include <cmath>
#include <map>
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
            if (!(std::abs(difference - given) <= 0.02 * std::max(std::abs(difference), std::abs(given)) + 1e-9))
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

    void add_direction(Schema &schema, const std::string &doc)
    {
      schema.optional_text("direction", doc + "; normalised. Default: x for a block and the idealised gastrocnemius; of a mesh the line of "
                                              "action, towards this face from the other end.");
    }

    /// Where the scene gives one.
    void read_own_direction(const Node &node, BoundaryCondition &condition)
    {
      if (node.has("direction"))
        condition.direction = read_direction(node, "direction");
    }

    bool has_direction(const BoundaryCondition &condition)
    {
      return condition.type == BoundaryCondition::Type::strain || condition.type == BoundaryCondition::Type::directed_traction ||
             condition.moves_as_one();
    }

    /// Of a condition of a mesh, whose axes mean nothing.
    std::array<double, 3> default_direction(const Node &node, const LineChoice &choice, const unsigned int face)
    {
      const bool at_end = choice.line && (face == choice.line->from || face == choice.line->to);
      if (!at_end)
        node.refuse("direction", "is missing, and the face is at no end of a line of action from which it could follow",
                    "three numbers separated by spaces", "from the other end of the muscle towards this one, as a rule");
      const double sense = face == choice.line->to ? 1 : -1;
      return {{sense * choice.line->direction[0], sense * choice.line->direction[1], sense * choice.line->direction[2]}};
    }

    /// Extent of the body at rest along a unit vector [m].
    double extent_along(const Geometry &geometry, const std::array<double, 3> &direction)
    {
      double low = BoundaryCondition::infinity, high = -BoundaryCondition::infinity;
      for (const dealii::Point<3> &x : corners(geometry))
        {
          const double s = x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2];
          low            = std::min(low, s);
          high           = std::max(high, s);
        }
      return high - low;
    }

    /// Loads with one number, springs and constraints.
    void read_other(const Node &node, const std::string &type, BoundaryCondition &condition)
    {
      using Type = BoundaryCondition::Type;
      const std::map<std::string, Type> types{{"pressure", Type::pressure},
                                              {"follower pressure", Type::follower_pressure},
                                              {"directed traction", Type::directed_traction},
                                              {"elastic foundation", Type::foundation},
                                              {"symmetry plane", Type::symmetry},
                                              {"isotonic", Type::isotonic},
                                              {"tendon spring", Type::tendon}};
      condition.type = types.at(type);
      if (condition.type == Type::pressure || condition.type == Type::follower_pressure)
        condition.load = node.number("pressure");
      if (condition.type == Type::directed_traction)
        condition.load = node.number("traction");
      if (condition.type == Type::isotonic)
        {
          condition.load = node.number("force");
          if (node.has("stop"))
            {
              if (condition.load < 0)
                node.refuse("force", "pulls the face away from its stop", "a number >= 0", "turn the \"direction\" instead");
              condition.spring        = make_stop_spring(node.section("stop").number("stiffness"));
              condition.stop_position = node.section("stop").number("position");
            }
        }
      if (condition.type == Type::directed_traction || condition.moves_as_one())
        read_own_direction(node, condition);
      if (condition.moves_as_one())
        condition.held_across = node.text("across") == "held";
      if (condition.type == Type::foundation)
        {
          condition.stiffness        = node.number("stiffness");
          condition.normal_stiffness = node.number("normal stiffness");
          if (condition.stiffness == 0 && condition.normal_stiffness == 0)
            node.refuse("stiffness", "the springs have no stiffness", "a \"stiffness\" or a \"normal stiffness\" above zero");
        }
      if (condition.type == Type::tendon)
        {
          condition.spring = read_tendon_spring(node.section("spring"));
          if (node.has("motion"))
            condition.profile = make_drive(node.section("motion"), Driven{"motion", "m"});
        }
      else if (condition.type != Type::foundation && condition.type != Type::symmetry && node.has("profile"))
        condition.profile = make_drive(node.section("profile"));
    }

    BoundaryCondition read_condition(const Node &node, const Geometry &geometry, const bool dynamic)
    {
      BoundaryCondition condition;
      condition.name         = node.name();
      condition.scene_path   = node.where("face");
      condition.face         = read_face(node, "face", geometry);
      const std::string type = node.text("type");
      if (type == "fixed" || type == "strain" || type == "formula")
        condition.components = read_components(node);
      else
        condition.components = {{false, false, false}};
      if (type == "traction" || type == "directed traction" || type == "pressure" || type == "follower pressure" ||
          type == "elastic foundation")
        read_box(node, condition);
      if (type == "strain")
        {
          condition.type = BoundaryCondition::Type::strain;
          read_own_direction(node, condition);
          condition.strain = make_drive(node.section("strain"));
          refuse_values_outside(node.section("strain"), *condition.strain, Range{-1, 1e9, true, false}, "boundary strain");
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
      else if (type != "fixed")
        read_other(node, type, condition);
      return condition;
    }

    /// What follows from the directions of all conditions.
    void finish(const Node &node, const Geometry &geometry, const LineChoice &line, BoundaryCondition &condition)
    {
      if (geometry.mesh && has_direction(condition) && !node.has("direction"))
        condition.direction = default_direction(node, line, condition.face);
      if (condition.type != BoundaryCondition::Type::strain)
        return;
      condition.reference_length =
          node.has("reference length") ? node.number("reference length") : extent_along(geometry, condition.direction);
      for (unsigned int c = 0; c < 3; ++c)
        if (condition.direction[c] != 0 && !condition.components[c])
          node.refuse("direction", std::string("the motion has a component ") + axes[c] + " that is not prescribed",
                      "a direction within the components", std::string("add ") + axes[c] + " to \"components\"");
    }

    void refuse_overlaps(const Node &node, const std::vector<BoundaryCondition> &conditions, const std::vector<std::string> &faces)
    {
      for (std::size_t i = 0; i < conditions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          {
            if (conditions[i].face != conditions[j].face)
              continue;
            for (unsigned int c = 0; c < 3; ++c)
              if (conditions[i].components[c] && conditions[j].components[c])
                node.refuse(conditions[i].name,
                            std::string("prescribes component ") + axes[c] + " of face " + faces[conditions[i].face] + ", as \"" +
                                conditions[j].name + "\" does already",
                            "one condition for each component of a face");
            const auto ties = [](const BoundaryCondition &c) { return c.constrains() && !c.prescribes_motion(); };
            if (ties(conditions[i]) && ties(conditions[j]))
              node.refuse(conditions[i].name,
                          "ties the unknowns of face " + faces[conditions[i].face] + ", as \"" + conditions[j].name + "\" does already",
                          "one symmetry plane, isotonic load or tendon spring for each face");
          }
    }

  } // namespace

  bool BoundaryCondition::loads(const dealii::Point<3> &x) const
  {
    for (unsigned int c = 0; c < 3; ++c)
      if (x[c] < low[c] || x[c] > high[c])
        return false;
    return true;
  }

  void BoundaryCondition::refuse_empty(const double area) const
  {
    if (!(area > 0))
      throw InputError(InputProblem{scene_path,
                                    "the load acts nowhere: none of the quadrature points of the face is between its \"from\" and \"to\"",
                                    "a part of the face as wide as the distance of its quadrature points",
                                    "lengths are in metres; refine the mesh, or widen the part"});
  }

  bool BoundaryCondition::may_move(const unsigned int c) const
  {
    return (type == Type::strain && direction[c] != 0) || (type == Type::formula && displacement[c] != "0");
  }

  Schema boundary_schema()
  {
    const std::string components = "Which components are prescribed, any of x y z; the others are free.";
    Schema            fixed("The face does not move.");
    fixed.text("components", "x y z", components);

    Schema strain("The face moves by reference length * strain(t) along a direction; prescribed components across it stay zero.");
    strain.text("components", "x y z", components);
    add_direction(strain, "Direction of the motion");
    strain
        .optional_number("reference length", "m", Range::positive(),
                         "Length that the strain refers to; default: that of the body along the direction.")
        .section("strain", drive_schema("boundary strain", "-"));

    Schema formula("The face moves by a displacement u(X, t) given by formulas, together with its time derivatives.");
    formula.text("components", "x y z", components);
    add_formulas(formula, "displacement ", "Displacement [m]");
    add_formulas(formula, "velocity ", "Its first time derivative [m/s]");
    add_formulas(formula, "acceleration ", "Its second time derivative [m/s^2]");

    Schema traction("A dead load per reference area.");
    add_formulas(traction, "traction ", "Traction [Pa]");
    add_box(traction);

    const auto load = [](Schema schema, const std::string &name, const std::string &unit, const std::string &what) {
      schema.number(name, std::nullopt, unit, Range::any(), what).optional_section("profile", drive_schema("factor of the " + name, "-"));
      return schema;
    };
    Schema pressure = load(Schema("A dead load along the inward normal of the face at rest, per reference area."), "pressure", "Pa",
                           "Force per reference area.");
    add_box(pressure);

    Schema directed = load(Schema("A dead load along a direction, per reference area."), "traction", "Pa", "Force per reference area.");
    add_direction(directed, "Direction of the load");
    add_box(directed);

    Schema follower = load(Schema("A pressure on the face as it moves: the force -p n per current area turns and grows with it."),
                           "pressure", "Pa", "Force per current area, inwards where positive.");
    add_box(follower);

    Schema foundation(
        "Springs between the face and the ground, per reference area: the force is -k u - k_n (u.N) N, N the normal at rest.");
    foundation.number("stiffness", 0, "Pa/m", Range::not_negative(), "k, in all directions.")
        .number("normal stiffness", 0, "Pa/m", Range::not_negative(), "k_n, along the normal, added to the other.");
    add_box(foundation);

    const Schema symmetry("The face, a plane of any direction, moves only within its plane: the body goes on behind it as in a mirror.");

    const auto as_one = [](Schema schema) {
      add_direction(schema, "Direction n along which the face moves as one");
      schema.choice("across", "free", {"free", "held"}, "Whether points of the face may move across n.");
      return schema;
    };
    Schema isotonic = load(as_one(Schema("The face moves as one along a direction, as far as a given force takes it.")), "force", "N",
                           "Force along n: positive where it pulls that way.");
    Schema stop("A stop for afterloaded contractions: the force -k max(0, q - position) along n keeps the face from moving farther.");
    stop.number("stiffness", std::nullopt, "N/m", Range::positive(), "k: the face stands beyond the stop by the force on it over k.")
        .number("position", 0, "m", Range::any(), "Motion q = u.n of the face where it touches the stop.");
    isotonic.optional_section("stop", stop);

    Schema tendon =
        as_one(Schema("The face moves as one along a direction, pulled by a tendon in series. The tendon is slack at rest, its far "
                      "end moves along n."));
    tendon.section("spring", tendon_spring_schema()).optional_section("motion", drive_schema("motion of the far end of the tendon", "m"));

    Schema each("A named condition on one face.");
    each.text("face", std::nullopt, "Face of the body, by a name of its geometry.");
    each.variant("type", std::nullopt,
                 {{"fixed", fixed},
                  {"strain", strain},
                  {"formula", formula},
                  {"traction", traction},
                  {"directed traction", directed},
                  {"pressure", pressure},
                  {"follower pressure", follower},
                  {"elastic foundation", foundation},
                  {"symmetry plane", symmetry},
                  {"isotonic", isotonic},
                  {"tendon spring", tendon}},
                 "Kind of condition.");
    return Schema("Boundary conditions, each a list with a name of your choice; faces without one are free of traction. Where two faces "
                  "meet, the later condition holds on the common edge.")
        .named_sections(each);
  }

  std::vector<BoundaryCondition> read_boundary(const Node &node, const Geometry &geometry, const LineGiven &given, const bool dynamic)
  {
    std::vector<BoundaryCondition> conditions;
    for (const Node &condition : node.named())
      conditions.push_back(read_condition(condition, geometry, dynamic));
    const LineChoice line = find_line_of_action(given, geometry, conditions);
    for (std::size_t i = 0; i < conditions.size(); ++i)
      finish(node.named()[i], geometry, line, conditions[i]);
    refuse_overlaps(node, conditions, face_names(geometry));
    return conditions;
  }
} // namespace myolines
