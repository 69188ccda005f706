// SPDX-License-Identifier: LGPL-2.1-or-later
#include "abaqus_kinds.h"

#include <map>

namespace myolines
{
  using Shape = PlainMesh::Shape;

  std::string upper(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::toupper(c); });
    return text;
  }

  AbaqusKind abaqus_kind(const std::string &type, const Cursor &cursor)
  {
    static const std::map<std::size_t, Shape> solids{{4, Shape::tetrahedron}, {10, Shape::tetrahedron}, {5, Shape::pyramid},
                                                     {13, Shape::pyramid},    {6, Shape::wedge},        {15, Shape::wedge},
                                                     {8, Shape::hexahedron},  {20, Shape::hexahedron},  {27, Shape::hexahedron}};
    static const std::map<std::size_t, Shape> surfaces{
        {3, Shape::triangle}, {6, Shape::triangle}, {4, Shape::quadrilateral}, {8, Shape::quadrilateral}, {9, Shape::quadrilateral}};
    const auto number_behind = [&](const std::size_t at) {
      std::size_t n = 0;
      for (std::size_t i = at; i < type.size() && type[i] >= '0' && type[i] <= '9' && n < 100; ++i)
        n = 10 * n + static_cast<std::size_t>(type[i] - '0');
      return n;
    };
    if (const std::size_t at = type.find("C3D"); at != std::string::npos)
      if (const auto found = solids.find(number_behind(at + 3)); found != solids.end())
        return {found->first, found->second};
    for (const char *const family : {"SFM3D", "STRI", "CPS", "CPE", "M3D", "R3D", "S"})
      if (type.rfind(family, 0) == 0)
        if (const auto found = surfaces.find(number_behind(std::string_view(family).size())); found != surfaces.end())
          return {found->first, found->second};
    for (const char *const other : {"T3D", "B3", "MASS", "ROTARY", "SPRING", "DASHPOT", "CONN", "DCOUP", "GAP", "TRUSS", "FRAME", "PIPE"})
      if (type.rfind(other, 0) == 0)
        return {0, {}};
    cursor.refuse("elements of type \"" + type + "\" are not known",
                  "C3D8, C3D4, C3D6, C3D5, their kin of second order, and S3, S4, CPS3, CPS4");
  }
} // namespace myolines
