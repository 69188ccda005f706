// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/boundary/boundary.h>
#include <myolines/boundary/line_of_action.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace myolines::test
{
  using Condition = std::shared_ptr<const BoundaryCondition>;

  /// "name=value" with all digits.
  inline std::string set(const std::string &name, const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << name << "=" << value;
    return text.str();
  }

  /// A condition of a block as a scene with these entries makes it: condition("isotonic", 1, {"force=3"}).
  inline Condition condition(const std::string &type, const unsigned int face, const std::vector<std::string> &entries = {},
                             const std::string &name = "")
  {
    const BoundaryEntry &entry = boundary_entry(type);
    BoundaryFacts        facts;
    facts.name  = name.empty() ? "face " + std::to_string(face) : name;
    facts.where = "test: " + facts.name;
    facts.face  = face;
    facts.end   = entry.end;
    return entry.make(scene::list_of_defaults(entry.schema, "test", entries), {facts, Geometry(), LineChoice(), true});
  }

  /// A face of which components are held.
  inline Condition held(const unsigned int face, const std::string &components = "x y z", const std::string &name = "")
  {
    return condition("fixed", face, {"components=" + components}, name);
  }
} // namespace myolines::test
