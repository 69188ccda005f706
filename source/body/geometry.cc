// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/body/geometry.h>
#include <myolines/body/mesh_schema.h>
#include <myolines/fem/distortion.h>
#include <myolines/materials/tissue.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    using scene::Range;
    using scene::Schema;

    const double degree = dealii::numbers::PI / 180;

    Schema block_schema()
    {
      Schema block("Box with one corner at the origin; its faces are x-, x+, y-, y+, z-, z+.");
      block.number("length", 0.03, "m", Range::positive(), "Extent along x, the line of action.")
          .number("width", 0.01, "m", Range::positive(), "Extent along y.")
          .number("height", 0.01, "m", Range::positive(), "Extent along z.")
          .integer("cells x", 1, Range::closed(1, 1000), "Coarse cells along x.")
          .integer("cells y", 1, Range::closed(1, 1000), "Coarse cells along y.")
          .integer("cells z", 1, Range::closed(1, 1000), "Coarse cells along z.")
          .integer("refinement", 3, Range::closed(0, 8), "Each refinement halves the cells in all directions.")
          .number("distortion", 0, "-", Range::closed(0, largest_distortion),
                  "Shifts the vertices of the refined mesh at random, always the same way, by up to this part of a cell in each direction; "
                  "the box keeps its shape.")
          .text("tissue", "muscle", "What it is made of: a printed tissue or one of system/tissues/own.");
      return block;
    }

    Schema gastrocnemius_schema()
    {
      const Gastrocnemius usual;
      Schema schema("Idealised gastrocnemius: muscle between two layers of aponeurosis, sheared boxes. x- and x+ are the ends of "
                    "the lower and the upper layer, \"muscle x-\" and \"muscle x+\" all other ends.");
      schema.number("muscle length", usual.muscle_length, "m", Range::positive(), "Between the ends, along the line of action x.")
          .number("aponeurosis length", usual.aponeurosis_length, "m", Range::positive(), "Of each layer.")
          .number("aponeurosis height", usual.aponeurosis_height, "m", Range::positive(), "Thickness of each layer, along z.")
          .number("width", usual.width, "m", Range::positive(), "Extent along y.")
          .number("pennation angle", usual.pennation, "degree", Range{0, 90, true, true}, "Between fibres and x.")
          .integer("refinement", 2, Range::closed(0, 6),
                   "Muscle of 2^g x 2^(g+1) x 2^g cells along fibre, aponeurosis and width; layers one cell thick.");
      return schema;
    }

    /// Corner (i, j, k) of the cells of a gastrocnemius: i from below the lower layer to above the upper one.
    dealii::Point<3> corner(const Gastrocnemius &g, const unsigned int i, const unsigned int j, const unsigned int k,
                            const unsigned int halves)
    {
      const auto   fibre = g.fibre_direction(), layer = g.aponeurosis_direction();
      const double across = std::min(1., std::max(0., (i - 1.) / halves)) * g.fibre_length(),
                   along  = j / (2. * halves) * g.aponeurosis_length;
      dealii::Point<3> x(across * fibre[0] + along * layer[0], k * g.width / halves, across * fibre[2] + along * layer[2]);
      if (i == 0)
        x[2] -= g.aponeurosis_height;
      if (i == halves + 2)
        x[2] += g.aponeurosis_height;
      return x;
    }

    /// Face of cell (i, j, k) at the boundary, by its number in the cell; directions are thickness, aponeurosis, width.
    unsigned int boundary_id(const unsigned int face, const unsigned int i, const unsigned int last)
    {
      switch (face)
        {
        case 0:
          return 4;
        case 1:
          return 5;
        case 2:
          return i == 0 ? 0 : 6;
        case 3:
          return i == last ? 1 : 7;
        default:
          return face - 2; // width: 2, 3
        }
    }

    void make_gastrocnemius(const Geometry &geometry, dealii::Triangulation<3> &mesh)
    {
      const std::array<unsigned int, 3> n = geometry.cells;
      std::vector<dealii::Point<3>>     vertices;
      for (unsigned int k = 0; k <= n[2]; ++k)
        for (unsigned int j = 0; j <= n[1]; ++j)
          for (unsigned int i = 0; i <= n[0]; ++i)
            vertices.push_back(corner(*geometry.gastrocnemius, i, j, k, n[2]));

      const auto                          &kinds = tissue_kinds();
      std::vector<dealii::CellData<3>>     cells;
      std::vector<std::array<unsigned, 3>> place;
      for (unsigned int k = 0; k < n[2]; ++k)
        for (unsigned int j = 0; j < n[1]; ++j)
          for (unsigned int i = 0; i < n[0]; ++i)
            {
              dealii::CellData<3> cell;
              for (unsigned int v = 0; v < 8; ++v)
                cell.vertices[v] = (i + (v & 1)) + (n[0] + 1) * ((j + ((v >> 1) & 1)) + (n[1] + 1) * (k + (v >> 2)));
              cell.material_id = kinds[i == 0 || i == n[0] - 1].id;
              cells.push_back(cell);
              place.push_back({{i, j, k}});
            }
      mesh.create_triangulation(vertices, cells, {});
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            cell->face(f)->set_boundary_id(boundary_id(f, place[cell->index()][0], n[0] - 1));
    }
  } // namespace

  namespace
  {
    void make_from_file(const Geometry &geometry, NodeSpace::Mesh &mesh)
    {
      std::vector<dealii::CellData<3>> cells = geometry.mesh->cells;
      dealii::GridTools::consistently_order_cells(cells);
      mesh.create_triangulation(geometry.mesh->vertices, cells, geometry.mesh->faces);
      mesh.refine_global(geometry.refinement);
    }

    Geometry read_body_of_mesh(const scene::Node &node, const TissueNames &tissues)
    {
      Geometry geometry;
      geometry.mesh       = read_mesh_body(node, tissues);
      geometry.refinement = static_cast<unsigned int>(node.integer("refinement"));
      // As many cells per direction as if they were cubes that fill the box around the body.
      const MeshBody &body = *geometry.mesh;
      double          box  = 1;
      for (unsigned int c = 0; c < 3; ++c)
        {
          geometry.size[c] = body.high[c] - body.low[c];
          box *= geometry.size[c];
        }
      const double edge = std::cbrt(box / body.cells.size());
      for (unsigned int c = 0; c < 3; ++c)
        geometry.cells[c] = std::max(1u, static_cast<unsigned int>(std::lround(geometry.size[c] / edge)));
      return geometry;
    }
  } // namespace

  double Gastrocnemius::aponeurosis_angle() const
  {
    return std::asin(muscle_length / aponeurosis_length * std::sin(pennation * degree)) - pennation * degree;
  }

  double Gastrocnemius::fibre_length() const { return aponeurosis_length * std::sin(aponeurosis_angle()) / std::sin(pennation * degree); }

  std::array<double, 3> Gastrocnemius::fibre_direction() const { return {{std::cos(pennation * degree), 0, std::sin(pennation * degree)}}; }

  std::array<double, 3> Gastrocnemius::aponeurosis_direction() const
  {
    return {{std::cos(aponeurosis_angle()), 0, -std::sin(aponeurosis_angle())}};
  }

  const std::vector<std::string> &face_names(const Geometry &geometry)
  {
    static const std::vector<std::string> of_block{"x-", "x+", "y-", "y+", "z-", "z+"};
    static const std::vector<std::string> of_gastrocnemius{"x-", "x+", "y-", "y+", "z-", "z+", "muscle x-", "muscle x+"};
    return geometry.mesh ? geometry.mesh->face_names : geometry.gastrocnemius ? of_gastrocnemius : of_block;
  }

  unsigned int read_face(const scene::Node &node, const std::string &parameter, const Geometry &geometry)
  {
    const std::vector<std::string> &faces = face_names(geometry);
    const std::string               name  = node.text(parameter);
    const auto                      found = std::find(faces.begin(), faces.end(), name);
    if (found != faces.end())
      return static_cast<unsigned int>(found - faces.begin());
    if (geometry.mesh)
      if (const auto further = geometry.mesh->further_names.find(name); further != geometry.mesh->further_names.end())
        return further->second;
    std::string hint = nearest_hint(name, faces);
    if (geometry.mesh && geometry.mesh->n_named < 2)
      hint = "the mesh names " + std::string(geometry.mesh->n_named == 0 ? "no surface" : "one surface only") +
             ": name some there (in Gmsh: Physical Surface), or by place in system/geometry/faces; \"" + MeshBody::rest +
             "\" is all that has no name (and boundary id 0)";
    if (geometry.mesh)
      for (const std::string &doubt : geometry.mesh->doubts)
        hint += (hint.empty() ? "" : "; ") + doubt;
    node.refuse(parameter, "the body has no face \"" + name + "\"", "one of " + join(faces), hint);
  }

  std::vector<dealii::Point<3>> corners(const Geometry &geometry)
  {
    if (geometry.mesh)
      return geometry.mesh->vertices;
    std::vector<dealii::Point<3>> corners;
    const auto                   &n = geometry.cells;
    for (const unsigned int k : {0u, 1u})
      for (const unsigned int j : {0u, 1u})
        for (const unsigned int i : {0u, 1u})
          corners.push_back(geometry.gastrocnemius ? corner(*geometry.gastrocnemius, i * n[0], j * n[1], k * n[2], n[2])
                                                   : dealii::Point<3>(i * geometry.size[0], j * geometry.size[1], k * geometry.size[2]));
    return corners;
  }

  namespace
  {
    /// Integrals over the bilinear quadrilateral of four vertices, row by row: area and first moments.
    void add_moments(const std::array<dealii::Point<3>, 4> &v, double &area, dealii::Tensor<1, 3> &moment)
    {
      const dealii::QGauss<2> rule(3);
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double x = rule.point(q)[0], y = rule.point(q)[1];
          const auto   along  = (1 - y) * (v[1] - v[0]) + y * (v[3] - v[2]);
          const auto   across = (1 - x) * (v[2] - v[0]) + x * (v[3] - v[1]);
          const double dA     = cross_product_3d(along, across).norm() * rule.weight(q);
          area += dA;
          moment += dA * ((1 - x) * (1 - y) * v[0] + x * (1 - y) * v[1] + (1 - x) * y * v[2] + x * y * v[3]);
        }
    }

    dealii::Point<3> centre_of_mesh_face(const MeshBody &body, const unsigned int face)
    {
      double               area = 0;
      dealii::Tensor<1, 3> moment;
      for (const dealii::CellData<2> &quad : body.faces.boundary_quads)
        if (quad.boundary_id == face)
          {
            std::array<dealii::Point<3>, 4> corner;
            for (unsigned int i = 0; i < 4; ++i)
              corner[i] = body.vertices[quad.vertices[i]];
            add_moments(corner, area, moment);
          }
      return dealii::Point<3>(moment / area);
    }
  } // namespace

  dealii::Point<3> face_centre(const Geometry &geometry, const unsigned int face)
  {
    if (geometry.mesh)
      return centre_of_mesh_face(*geometry.mesh, face);
    dealii::Point<3> centre(geometry.size[0] / 2, geometry.size[1] / 2, geometry.size[2] / 2);
    if (!geometry.gastrocnemius)
      {
        centre[face / 2] = face % 2 == 0 ? 0 : geometry.size[face / 2];
        return centre;
      }
    const Gastrocnemius &g  = *geometry.gastrocnemius;
    const auto           at = [&](const double fibres, const double layers, const double height, const double width) {
      const auto       fibre = g.fibre_direction(), layer = g.aponeurosis_direction();
      dealii::Point<3> x;
      for (unsigned int c = 0; c < 3; ++c)
        x[c] = fibres * g.fibre_length() * fibre[c] + layers * g.aponeurosis_length * layer[c];
      x[1] += width * g.width;
      x[2] += height * g.aponeurosis_height;
      return x;
    };
    switch (face)
      {
      case 0:
        return at(0, 0, -0.5, 0.5);
      case 1:
        return at(1, 1, 0.5, 0.5);
      case 2:
        return at(0.5, 0.5, 0, 0);
      case 3:
        return at(0.5, 0.5, 0, 1);
      case 4:
        return at(0, 0.5, -1, 0.5);
      case 5:
        return at(1, 0.5, 1, 0.5);
      case 6:
        return at(0.5, 0, 0, 0.5);
      default:
        return at(0.5, 1, 0, 0.5);
      }
  }

  std::vector<std::string> tissues_of(const Geometry &geometry)
  {
    if (geometry.mesh)
      return geometry.mesh->tissues;
    return geometry.gastrocnemius ? std::vector<std::string>{"muscle", "aponeurosis"} : std::vector<std::string>{geometry.tissue};
  }

  void make_mesh(const Geometry &geometry, NodeSpace::Mesh &mesh)
  {
    if (geometry.gastrocnemius)
      make_gastrocnemius(geometry, mesh);
    else if (geometry.mesh)
      make_from_file(geometry, mesh);
    else
      {
        make_block(mesh, geometry.size, geometry.cells, 0);
        for (const auto &cell : mesh.active_cell_iterators())
          cell->set_material_id(geometry.tissue_id);
        mesh.refine_global(geometry.refinement);
        if (geometry.distortion > 0)
          distort_block(mesh, geometry.size, geometry.cells, geometry.refinement, geometry.distortion);
      }
  }

  Schema geometry_schema()
  {
    return Schema("Reference body and its mesh.")
        .variant("type", "block",
                 {{"block", block_schema()},
                  {"idealised gastrocnemius", gastrocnemius_schema()},
                  {"mesh", mesh_body_schema()},
                  {"gmsh", mesh_body_schema()}},
                 "Shape of the body; \"gmsh\" is the former name of \"mesh\".");
  }

  Geometry read_geometry(const scene::Node &node, const TissueNames &tissues)
  {
    Geometry   geometry;
    const auto number = [&](const std::string &name) { return static_cast<unsigned int>(node.integer(name)); };
    if (node.text("type") == "mesh" || node.text("type") == "gmsh")
      return read_body_of_mesh(node, tissues);
    if (node.text("type") == "block")
      {
        geometry.size       = {{node.number("length"), node.number("width"), node.number("height")}};
        geometry.cells      = {{number("cells x"), number("cells y"), number("cells z")}};
        geometry.refinement = number("refinement");
        geometry.distortion = node.number("distortion");
        geometry.tissue     = node.text("tissue");
        geometry.tissue_id  = tissue_id(tissues, geometry.tissue);
        if (geometry.tissue_id == 0)
          node.refuse("tissue", "\"" + geometry.tissue + "\" is no tissue", "one of " + join(tissues),
                      nearest_hint(geometry.tissue, tissues));
        return geometry;
      }
    const Gastrocnemius g{node.number("muscle length"), node.number("aponeurosis length"), node.number("aponeurosis height"),
                          node.number("width"), node.number("pennation angle")};
    if (!(g.muscle_length * std::sin(g.pennation * degree) < g.aponeurosis_length))
      node.refuse("aponeurosis length", "the aponeurosis is too short to close the triangle of muscle, fibre and aponeurosis",
                  "more than muscle length times sin(pennation angle) = " +
                      std::to_string(g.muscle_length * std::sin(g.pennation * degree)) + " m");
    if (!(g.aponeurosis_angle() > 0))
      node.refuse("aponeurosis length", "is not shorter than the muscle, so that fibres would have no length",
                  "less than muscle length = " + std::to_string(g.muscle_length) + " m");
    const unsigned int halves = 1u << number("refinement");
    geometry.gastrocnemius    = g;
    geometry.size             = {{g.muscle_length, g.width, g.fibre_length() * std::sin(g.pennation * degree) + 2 * g.aponeurosis_height}};
    geometry.cells            = {{halves + 2, 2 * halves, halves}};
    geometry.refinement       = 0;
    return geometry;
  }
} // namespace myolines
