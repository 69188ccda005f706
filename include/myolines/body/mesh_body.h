// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/tissue.h>
#include <myolines/meshes/plain_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// A face by its place: the quadrilaterals of the boundary of which all that is given is true.
  struct PlacedFace
  {
    static constexpr double infinity = std::numeric_limits<double>::infinity(); ///< no bound

    std::string                         name;       ///< that the scene gives it
    std::string                         scene_path; ///< for messages
    std::optional<dealii::Tensor<1, 3>> normal;     ///< the outward normal is within the angle of this direction, unit
    double                              angle = 30; ///< [degree]
    std::optional<dealii::Point<3>>     through;    ///< all corners lie on the plane through it, across the normal [m]
    std::optional<double>               tolerance;  ///< of their distance from that plane [m]; none: size / 1000
    dealii::Point<3>                    low{-infinity, -infinity, -infinity}; ///< box with the centre in it [m]: least coordinates
    dealii::Point<3>                    high{infinity, infinity, infinity};   ///< and greatest
  };

  /// The body of a mesh file: hexahedra, checked, whatever the file has.
  struct MeshBody
  {
    std::vector<dealii::Point<3>>       vertices;      ///< [m]
    std::vector<dealii::CellData<3>>    cells;         ///< material ids are those of CellId
    dealii::SubCellData                 faces;         ///< boundary ids are places in face_names
    std::vector<std::string>            face_names;    ///< by number; see face_names()
    std::size_t                         n_named = 0;   ///< of the faces: those of the file and by place; the other one is the rest
    std::map<std::string, unsigned int> further_names; ///< of faces that have several
    std::vector<std::string>            tissues;       ///< by name
    dealii::Point<3>                    low;           ///< corner of the box around it with the least coordinates [m]
    dealii::Point<3>                    high;          ///< corner with the greatest [m]
    double                              volume = 0;    ///< [m^3]
    double                   worst = 1; ///< smallest scaled Jacobian of a cell: the determinant at a corner over the lengths of its edges
    std::vector<std::string> report;    ///< lines for `check`
    std::vector<std::string> doubts;    ///< what was perhaps meant otherwise: warnings of `check` and `run`

    /// The name of all quadrilaterals of the boundary that no other face has.
    static constexpr const char *rest = "rest";

    /// Groups of cells are tissues, by name (one of @p names, or such a name, a space and more: "muscle soleus") or,
    /// without one, by number (1, 2, 3, ...); without any, and with a single group of any other name, all is muscle. Groups of surfaces
    /// name faces; without a name their number is it. Faces by place take what these leave.
    /// @throws InputError at @p where for a file that is no mesh, inverted or degenerate cells, hanging points, several parts that do not
    /// touch, surfaces that overlap, and unknown tissues.
    MeshBody(const std::filesystem::path &file, double scale, const std::string &where, const std::vector<PlacedFace> &placed = {},
             const TissueNames &names = printed_tissues());
  };
} // namespace myolines
