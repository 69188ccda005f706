// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myolines
{
  /// A mesh as its file has it, whatever the format: places, cells, and faces that the file gives names or numbers. Nothing is checked
  /// but that all numbers of points are there.
  struct PlainMesh
  {
    /// Shape of a cell or a face.
    enum class Shape
    {
      triangle,      ///< 3 corners
      quadrilateral, ///< 4 corners
      tetrahedron,   ///< 4 corners
      pyramid,       ///< 5 corners
      wedge,         ///< 6 corners
      hexahedron     ///< 8 corners
    };

    using Position = std::array<double, 3>; ///< A place, in the unit of the file.

    /// A cell or a face. Corners go round: of the base and then, above it, of the top or the apex. Seen from there the base is
    /// counter-clockwise in cells that are right-handed.
    struct Element
    {
      Shape                       shape;  ///< how many of the corners count
      int                         group;  ///< 0: none
      std::array<unsigned int, 8> corner; ///< places in the list of points
    };

    /// Numbers at cells or at points.
    struct Field
    {
      std::string         name;         ///< as in the file
      unsigned int        n_components; ///< of a cell or point
      std::vector<double> values;       ///< [cells or points][components]
    };

    std::vector<Position>                   points;         ///< as written, without a unit
    std::vector<Element>                    cells;          ///< of any shape
    std::vector<Element>                    faces;          ///< that the file names or numbers; one in several groups is there for each
    std::map<std::size_t, std::vector<int>> further_groups; ///< of cells in several groups, by place in the list
    std::map<int, std::string>              cell_groups;    ///< names of groups of cells by number, where they have one
    std::map<int, std::string>              face_groups;    ///< names of groups of faces, likewise
    std::vector<Field>                      cell_fields;    ///< numbers at cells
    std::vector<Field>                      point_fields;   ///< numbers at points
    std::vector<std::string> possible_groups;  ///< arrays of cells that could be numbers of groups, where none is known as such
    std::size_t              straightened = 0; ///< cells of higher order, of which the corners are kept
    std::string              format;           ///< "Gmsh 4.1, binary"
  };

  /// How many corners, of faces and cells.
  unsigned int n_corners(PlainMesh::Shape shape);

  /// Places in PlainMesh::Element::corner of the corners of each face of a cell.
  const std::vector<std::vector<unsigned int>> &faces_of(PlainMesh::Shape cell);

  /// "tetrahedra".
  const std::string &plural(PlainMesh::Shape shape);

  /// Volume between flat faces, each of four corners halved along a diagonal; negative for left-handed cells.
  double signed_volume(const PlainMesh &mesh, const PlainMesh::Element &cell);

  /// Corners of a face, ascending; the fourth of a triangle is no_corner.
  using FaceKey                    = std::array<unsigned int, 4>;
  constexpr unsigned int no_corner = 0xFFFFFFFF;                   ///< the number of no point
  FaceKey                face_key(const PlainMesh::Element &face); ///< Those of @p face.

  /// Face @p f of a cell, a triangle or a quadrilateral.
  PlainMesh::Element face_of(const PlainMesh::Element &cell, unsigned int f);

  /// The faces that only one cell has, seen from outside where cells are right-handed.
  std::vector<PlainMesh::Element> outer_faces(const PlainMesh &mesh);

  /// The same mesh of hexahedra alone, in which faces that cells share stay shared. With nothing but hexahedra it is as it was. Else a
  /// tetrahedron becomes 4, a wedge 6 and a hexahedron 8, one for each corner, a triangle of the faces 3 and a quadrilateral 4. As that
  /// is no way to divide a pyramid, in a mesh with pyramids all cells become tetrahedra before: a hexahedron 6, a wedge 3 and a pyramid 2,
  /// along the diagonals from the point of each face that comes first. Fields are left out.
  PlainMesh split_into_hexahedra(const PlainMesh &mesh);

  /// Reads a mesh of any format that is known, told by its first line: Gmsh 1, 2 and 4 (ASCII, binary), VTK (legacy and XML, `.vtu`) and
  /// Abaqus (`.inp`). @throws InputError with line or byte for files that are damaged, cut off or of another kind.
  PlainMesh read_mesh(const std::filesystem::path &file);
  /// The same from the bytes of a file, @p file standing for it in messages.
  PlainMesh parse_mesh(const std::string &bytes, const std::filesystem::path &file);
} // namespace myolines
