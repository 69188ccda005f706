// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hexahedra.h"

#include <myolines/body/cell_id.h>
#include <myolines/body/mesh_export.h>
#include <myolines/materials/tissue.h>

namespace myolines
{
  namespace
  {
    void add_group(const CellId id, const TissueNames &tissues, PlainMesh &exported)
    {
      const std::string &tissue   = tissues[id.tissue - 1];
      const int          group    = static_cast<int>(id.volume != 0 ? id.volume : id.tissue);
      exported.cell_groups[group] = id.volume != 0 && id.volume != id.tissue ? tissue + " " + std::to_string(id.volume) : tissue;
    }

    /// Corners round about, from deal.II's row by row.
    template <typename Vertex>
    PlainMesh::Element element_of(const PlainMesh::Shape shape, const int group, const Vertex &vertex)
    {
      PlainMesh::Element element{shape, group, {}};
      for (unsigned int i = 0; i < n_corners(shape); ++i)
        element.corner[i] = vertex(i % 4 < 2 ? i : i ^ 1u);
      return element;
    }
  } // namespace

  PlainMesh export_mesh(const Geometry &geometry, const TissueNames &tissues)
  {
    NodeSpace::Mesh mesh(MPI_COMM_SELF);
    make_mesh(geometry, mesh);
    PlainMesh exported;
    exported.points.resize(mesh.n_vertices());
    for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
      exported.points[v] = {{mesh.get_vertices()[v][0], mesh.get_vertices()[v][1], mesh.get_vertices()[v][2]}};
    const std::vector<std::string> &names = face_names(geometry);
    PlainMesh::Field                quality{"scaled jacobian", 1, {}};
    for (const auto &cell : mesh.active_cell_iterators())
      {
        const CellId id = CellId::of(cell->material_id());
        add_group(id, tissues, exported);
        exported.cells.push_back(element_of(PlainMesh::Shape::hexahedron, static_cast<int>(id.volume != 0 ? id.volume : id.tissue),
                                            [&](const unsigned int i) { return cell->vertex_index(i); }));
        unsigned int vertices[8];
        for (unsigned int i = 0; i < 8; ++i)
          vertices[i] = cell->vertex_index(i);
        quality.values.push_back(scaled_jacobian(mesh.get_vertices(), vertices));
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() < names.size() && names[face->boundary_id()] != MeshBody::rest)
            {
              const int group             = static_cast<int>(face->boundary_id()) + 1;
              exported.face_groups[group] = names[face->boundary_id()];
              exported.faces.push_back(
                  element_of(PlainMesh::Shape::quadrilateral, group, [&](const unsigned int i) { return face->vertex_index(i); }));
            }
      }
    exported.cell_fields.push_back(quality);
    return exported;
  }
} // namespace myolines
