// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hexahedra.h"
#include "mesh_refusal.h"

#include <myolines/base/names.h>
#include <myolines/meshes/tidy.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    using Shape = PlainMesh::Shape;

    /// What is wrong with a file is told where the scene names it.
    PlainMesh mesh_in(const std::filesystem::path &file, const MeshRefusal &refuse)
    {
      try
        {
          return read_mesh(file);
        }
      catch (const InputError &error)
        {
          const InputProblem &problem = error.problems().front();
          refuse(problem.where + ": " + problem.what, problem.expected, problem.hint);
        }
    }

    dealii::Point<3> point_of(const PlainMesh::Position &x) { return {x[0], x[1], x[2]}; }

    /// "48 tetrahedra, 3 wedges"
    std::string counted(const PlainMesh &mesh)
    {
      std::vector<std::string> words;
      for (const Shape shape : {Shape::hexahedron, Shape::tetrahedron, Shape::wedge, Shape::pyramid})
        if (const auto n = std::count_if(mesh.cells.begin(), mesh.cells.end(), [shape](const auto &cell) { return cell.shape == shape; });
            n > 0)
          words.push_back(std::to_string(n) + " " + plural(shape));
      return join(words);
    }

    void tell(const std::size_t n, const std::string &what, std::vector<std::string> &report)
    {
      if (n > 0)
        report.push_back(std::to_string(n) + " " + what);
    }

    void refuse_what_is_no_body(const PlainMesh &mesh, const MeshRefusal &refuse)
    {
      if (const auto hanging = hanging_points(mesh); !hanging.empty())
        refuse("a point hangs at " + place_text(point_of(hanging.front())) + ": cells of different size meet", "a conforming mesh",
               "in Gmsh: Coherence Mesh");
      if (const auto faces = unfitting_faces(mesh); !faces.empty())
        refuse("a quadrilateral of one cell meets triangles of others at " + place_text(point_of(mesh.points[faces.front().corner[0]])) +
                   ": these cells do not fit each other",
               "a conforming mesh", "pyramids between hexahedra and tetrahedra");
      if (const auto parts = parts_of(mesh); parts.size() > 1)
        refuse("the mesh falls into " + std::to_string(parts.size()) + " parts that do not touch: one has a point at " +
                   place_text(point_of(mesh.points[mesh.cells[parts[0]].corner[0]])) + ", another one at " +
                   place_text(point_of(mesh.points[mesh.cells[parts[1]].corner[0]])),
               "one connected body", "join the parts, or make a mesh of each");
    }

    /// Parts of the body that only edges or points join.
    void tell_hinges(const PlainMesh &mesh, std::vector<std::string> &report)
    {
      const std::vector<std::size_t> parts = parts_without_common_faces(mesh);
      const auto place = [&](const std::size_t part) { return place_text(point_of(mesh.points[mesh.cells[parts[part]].corner[0]])); };
      if (parts.size() > 1)
        report.push_back("hinges: the body has " + std::to_string(parts.size()) +
                         " parts that have only edges or points in common; one has a point at " + place(0) + ", another one at " +
                         place(1));
    }

    /// The mesh in metres, put right.
    PlainMesh sound_mesh(const std::filesystem::path &file, const double scale, MeshBody &body, const MeshRefusal &refuse)
    {
      PlainMesh mesh = mesh_in(file, refuse);
      if (mesh.cells.empty())
        refuse("the mesh has no cells", "hexahedra, tetrahedra, wedges or pyramids",
               "in Gmsh: mesh in 3D and save all or the physical volumes");
      for (PlainMesh::Position &x : mesh.points)
        for (double &c : x)
          c *= scale;
      const Tidying done = tidy(mesh);
      body.report.push_back("mesh: " + counted(mesh) + " (" + mesh.format + ")");
      tell(mesh.straightened, "cells of higher order: their edges are straightened", body.report);
      tell(done.joined, "points at the place of another one: joined with it", body.report);
      tell(done.unused, "points of no cell: dropped", body.report);
      tell(done.loose, "faces with points of no cell: dropped", body.report);
      tell(done.twice, "cells were there twice: once taken", body.report);
      tell(done.turned, "left-handed cells: turned", body.report);
      for (const std::string &array : mesh.possible_groups)
        body.doubts.push_back("the array \"" + array + "\" of the mesh " + file.string() +
                              " could be the groups of its cells and faces, but is not taken as such: a name like \"group\" would say so");
      refuse_what_is_no_body(mesh, refuse);
      tell_hinges(mesh, body.report);
      return mesh;
    }

    void add_cells(const PlainMesh &mesh, const TissueNames &names, MeshBody &body, const MeshRefusal &refuse)
    {
      constexpr unsigned int order[] = {0, 1, 3, 2, 4, 5, 7, 6}; // files go round, deal.II row by row
      for (const PlainMesh::Position &x : mesh.points)
        body.vertices.push_back(point_of(x));
      const std::vector<unsigned int> ids = tissues_of_cells(mesh, names, body, refuse);
      for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        {
          dealii::CellData<3> cell;
          cell.material_id = ids[i];
          for (unsigned int v = 0; v < 8; ++v)
            cell.vertices[v] = mesh.cells[i].corner[order[v]];
          const double quality = scaled_jacobian(body.vertices, cell.vertices.data());
          if (!(quality > 0))
            refuse("a cell at " + place_text(body.vertices[cell.vertices[0]]) + " is inverted or degenerate",
                   "cells with positive Jacobians at all corners");
          body.worst = std::min(body.worst, quality);
          body.volume += cell_volume(body.vertices, cell.vertices.data());
          body.cells.push_back(cell);
        }
    }
  } // namespace

  MeshBody::MeshBody(const std::filesystem::path &file, const double scale, const std::string &where, const std::vector<PlacedFace> &placed,
                     const TissueNames &names)
  {
    const MeshRefusal refuse{where};
    const PlainMesh   mesh = sound_mesh(file, scale, *this, refuse), split = split_into_hexahedra(mesh);
    if (split.cells.size() > mesh.cells.size())
      {
        std::ostringstream text;
        text << "split into " << split.cells.size() << " hexahedra, " << static_cast<double>(split.cells.size()) / mesh.cells.size()
             << " for each cell";
        report.push_back(text.str());
      }
    const auto box = box_around(split);
    low            = point_of(box[0]);
    high           = point_of(box[1]);
    add_cells(split, names, *this, refuse);
    std::ostringstream facts;
    facts << "extent " << high[0] - low[0] << " x " << high[1] - low[1] << " x " << high[2] - low[2] << " m, volume " << volume
          << " m^3; smallest scaled Jacobian of a cell: " << worst;
    report.push_back(facts.str());
    add_faces(split, placed, *this, refuse);
  }
} // namespace myolines
