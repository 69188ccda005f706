// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>
#include <myolines/body/mesh_body.h>

#include <sstream>

namespace myolines
{
  /// Refuses the mesh where the scene names it.
  struct MeshRefusal
  {
    std::string where;

    [[noreturn]] void operator()(const std::string &what, const std::string &expected, const std::string &hint = "") const
    {
      throw InputError(InputProblem{where, what, expected, hint});
    }
  };

  /// "(0.01 0 0) m"
  inline std::string place_text(const dealii::Point<3> &x)
  {
    std::ostringstream out;
    out << "(" << x << ") m";
    return out.str();
  }

  /// The material id (CellId) of every cell of @p mesh by its groups, tissues being called as in @p names; adds lines about them to the
  /// report of @p body, and the tissues.
  std::vector<unsigned int> tissues_of_cells(const PlainMesh &mesh, const TissueNames &names, MeshBody &body, const MeshRefusal &refuse);

  /// Gives every quadrilateral of the boundary its face: those of @p mesh, those by place, the rest.
  void add_faces(const PlainMesh &mesh, const std::vector<PlacedFace> &placed, MeshBody &body, const MeshRefusal &refuse);
} // namespace myolines
