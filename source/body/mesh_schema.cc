// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/body/entries.h>
#include <myolines/body/mesh_schema.h>

#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    Schema face_schema()
    {
      Schema face("A face by place: all of the boundary for which everything that is given here is true and that the mesh does not name.");
      face.optional_text("normal", "\"x y z\": the outward normal is within the angle of this direction.")
          .number("angle", 30, "degree", Range::closed(0, 180), "Largest angle between the outward normal and its direction.")
          .optional_text("through", "\"x y z\" [m]: all corners lie on the plane through this point, across the normal.")
          .optional_number("tolerance", "m", Range::not_negative(),
                           "Largest distance of a corner from that plane; default: a thousandth of the size of the body.");
      for (const char *axis : axes)
        for (const char *end : {" from", " to"})
          face.optional_number(axis + std::string(end), "m", Range::any(), "Box with the centres of the quadrilaterals in it.");
      return face;
    }

    dealii::Point<3> read_point(const Node &node, const std::string &parameter)
    {
      std::istringstream words(node.text(parameter));
      dealii::Point<3>   x;
      std::string        rest;
      if (!(words >> x[0] >> x[1] >> x[2]) || (words >> rest))
        node.refuse(parameter, "\"" + node.text(parameter) + "\" is not a point", "three numbers separated by spaces");
      return x;
    }

    PlacedFace read_placed_face(const Node &node)
    {
      PlacedFace face;
      face.name       = node.name();
      face.scene_path = node.where("normal").substr(0, node.where("normal").rfind('/'));
      face.angle      = node.number("angle");
      if (node.has("normal"))
        {
          const auto n = read_direction(node, "normal");
          face.normal  = dealii::Tensor<1, 3>({n[0], n[1], n[2]});
        }
      if (node.has("through"))
        {
          face.through = read_point(node, "through");
          if (!face.normal)
            node.refuse("through", "a plane needs a normal", "\"normal\" beside it");
        }
      if (node.has("tolerance"))
        face.tolerance = node.number("tolerance");
      bool boxed = false;
      for (unsigned int c = 0; c < 3; ++c)
        {
          const std::string from = axes[c] + std::string(" from"), to = axes[c] + std::string(" to");
          boxed = boxed || node.has(from) || node.has(to);
          if (node.has(from))
            face.low[c] = node.number(from);
          if (node.has(to))
            face.high[c] = node.number(to);
        }
      if (!boxed && !face.normal)
        node.refuse("normal", "nothing says where the face is", "a normal, a plane or a box");
      return face;
    }
  } // namespace

  Schema mesh_body_schema()
  {
    Schema schema("A mesh from a file: Gmsh (.msh), VTK (.vtu, .vtk) or Abaqus (.inp). Tetrahedra, wedges and pyramids are split into "
                  "hexahedra. Groups of cells are tissues by name, perhaps with more words behind it (or 1 muscle, 2 aponeurosis, 3 "
                  "tendon), groups of surfaces name the faces; \"rest\" is the boundary without a name. The line of action is x.");
    schema.file("file", "Mesh, in any version and encoding of these formats.")
        .text("scale", "1", "Unit of the coordinates (m, cm, mm, um), or their factor to metres.")
        .integer("refinement", 0, Range::closed(0, 6), "Each refinement halves the cells in all directions.")
        .section("faces",
                 Schema("Faces by place, each a list with a name of your choice; earlier ones come first.").named_sections(face_schema()));
    return schema;
  }

  std::shared_ptr<const MeshBody> read_mesh_body(const Node &node, const TissueNames &names)
  {
    std::vector<PlacedFace> placed;
    for (const Node &face : node.section("faces").named())
      placed.push_back(read_placed_face(face));
    return std::make_shared<const MeshBody>(node.file("file"), read_unit(node, "scale"), node.where("file"), placed, names);
  }
} // namespace myolines
