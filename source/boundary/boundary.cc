// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/body/entries.h>
#include <myolines/boundary/boundary.h>
#include <myolines/boundary/line_of_action.h>

#include <stdexcept>

namespace myolines
{
#define MYOLINES_BOUNDARY_CONDITION(name) BoundaryEntry name##_condition();
#include "../../boundary/list.def"
#undef MYOLINES_BOUNDARY_CONDITION

  Registry<BoundaryEntry> &boundary_registry()
  {
    static Registry<BoundaryEntry> registry("boundary condition", {
#define MYOLINES_BOUNDARY_CONDITION(name) name##_condition(),
#include "../../boundary/list.def"
#undef MYOLINES_BOUNDARY_CONDITION
                                                                  });
    return registry;
  }

  const BoundaryEntry &boundary_entry(const std::string &name)
  {
    if (const BoundaryEntry *entry = boundary_registry().find(name))
      return *entry;
    throw std::out_of_range("no boundary condition is called \"" + name + "\"");
  }

  bool Box::contains(const dealii::Point<3> &x) const
  {
    for (unsigned int c = 0; c < 3; ++c)
      if (x[c] < low[c] || x[c] > high[c])
        return false;
    return true;
  }

  BoundaryCondition::Motion BoundaryCondition::motion(double, Side) const
  {
    return [](const dealii::Point<3> &) { return std::array<Vector3, 3>(); };
  }

  std::vector<BoundaryFacts> facts_of(const BoundaryConditions &conditions)
  {
    std::vector<BoundaryFacts> facts;
    for (const auto &condition : conditions)
      facts.push_back(condition->facts());
    return facts;
  }

  void refuse_empty(const BoundaryFacts &condition, const double area)
  {
    if (!(area > 0))
      throw InputError(InputProblem{condition.where,
                                    "the load acts nowhere: none of the quadrature points of the face is between its \"from\" and \"to\"",
                                    "a part of the face as wide as the distance of its quadrature points",
                                    "lengths are in metres; refine the mesh, or widen the part"});
  }

  scene::Schema boundary_schema()
  {
    std::vector<std::pair<std::string, scene::Schema>> kinds;
    for (const BoundaryEntry &entry : boundary_registry())
      kinds.emplace_back(entry.name, entry.schema);
    scene::Schema each("A named condition on one face.");
    each.text("face", std::nullopt, "Face of the body, by a name of its geometry, for example \"x+\".");
    each.variant("type", std::nullopt, kinds, "Kind of condition.");
    return scene::Schema(
               "Boundary conditions, each a list with a name of your choice; faces without one are free of traction. Where two faces "
               "meet, the later condition holds on the common edge.")
        .named_sections(each);
  }

  namespace
  {
    void refuse_overlaps(const scene::Node &node, const BoundaryConditions &conditions, const std::vector<std::string> &faces)
    {
      for (std::size_t i = 0; i < conditions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          {
            const BoundaryFacts &one = conditions[i]->facts(), &other = conditions[j]->facts();
            if (one.face != other.face)
              continue;
            for (unsigned int c = 0; c < 3; ++c)
              if (one.prescribed[c] && other.prescribed[c])
                node.refuse(one.name,
                            std::string("prescribes component ") + axes[c] + " of face " + faces[one.face] + ", as \"" + other.name +
                                "\" does already",
                            "one condition for each component of a face");
            if (one.ties && other.ties)
              node.refuse(one.name, "ties the unknowns of face " + faces[one.face] + ", as \"" + other.name + "\" does already",
                          "one symmetry plane, isotonic load or tendon spring for each face");
          }
    }
  } // namespace

  BoundaryConditions read_boundary(const scene::Node &node, const Geometry &geometry, const LineGiven &given, const bool dynamic)
  {
    std::vector<BoundaryFacts> facts;
    for (const scene::Node &condition : node.named())
      {
        facts.emplace_back();
        facts.back().name  = condition.name();
        facts.back().where = condition.where("face");
        facts.back().face  = read_face(condition, "face", geometry);
        facts.back().end   = boundary_entry(condition.text("type")).end;
      }
    const LineChoice   line = find_line_of_action(given, geometry, facts);
    BoundaryConditions conditions;
    for (std::size_t i = 0; i < facts.size(); ++i)
      conditions.push_back(boundary_entry(node.named()[i].text("type")).make(node.named()[i], {facts[i], geometry, line, dynamic}));
    refuse_overlaps(node, conditions, face_names(geometry));
    return conditions;
  }
} // namespace myolines
