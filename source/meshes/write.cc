// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/meshes/write.h>
#include <myolines/scene/numbers.h>

#include <functional>
#include <sstream>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    using Shape   = PlainMesh::Shape;
    using Element = PlainMesh::Element;

    struct Types
    {
      int vtk, gmsh;
    };
    Types types_of(const Shape shape)
    {
      static constexpr Types types[] = {{5, 2}, {9, 3}, {10, 4}, {14, 7}, {13, 6}, {12, 5}};
      return types[static_cast<int>(shape)];
    }

    /// Cells, then faces.
    void for_each(const PlainMesh &mesh, const std::function<void(const Element &)> &action)
    {
      for (const auto *elements : {&mesh.cells, &mesh.faces})
        for (const Element &element : *elements)
          action(element);
    }

    /// "3 1 muscle"
    std::vector<std::string> names_of_groups(const PlainMesh &mesh)
    {
      std::vector<std::string> names;
      for (const auto &[number, name] : mesh.face_groups)
        names.push_back("2 " + std::to_string(number) + " " + name);
      for (const auto &[number, name] : mesh.cell_groups)
        names.push_back("3 " + std::to_string(number) + " " + name);
      return names;
    }

    void begin_array(std::ostream &out, const std::string &type, const std::string &name, const unsigned int n_components = 1)
    {
      out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << n_components << "\" format=\"ascii\">\n";
    }

    void write_field(std::ostream &out, const PlainMesh::Field &field, const std::size_t rows)
    {
      begin_array(out, "Float64", field.name, field.n_components);
      for (std::size_t i = 0; i < rows * field.n_components; ++i)
        out << (i < field.values.size() ? scene::format_number(field.values[i]) : "0") << ((i + 1) % field.n_components == 0 ? "\n" : " ");
      out << "</DataArray>\n";
    }

    void write_vtu_cells(std::ostream &out, const PlainMesh &mesh)
    {
      out << "<Cells>\n";
      begin_array(out, "Int64", "connectivity");
      for_each(mesh, [&](const Element &element) {
        for (unsigned int i = 0; i < n_corners(element.shape); ++i)
          out << element.corner[i] << " ";
        out << "\n";
      });
      out << "</DataArray>\n";
      begin_array(out, "Int64", "offsets");
      std::size_t end = 0;
      for_each(mesh, [&](const Element &element) { out << (end += n_corners(element.shape)) << "\n"; });
      out << "</DataArray>\n";
      begin_array(out, "UInt8", "types");
      for_each(mesh, [&](const Element &element) { out << types_of(element.shape).vtk << "\n"; });
      out << "</DataArray>\n</Cells>\n";
    }

    std::string vtu_text(const PlainMesh &mesh)
    {
      const std::size_t  n_all = mesh.cells.size() + mesh.faces.size();
      std::ostringstream out;
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
             "header_type=\"UInt64\">\n"
             "<UnstructuredGrid>\n";
      if (const std::vector<std::string> names = names_of_groups(mesh); !names.empty())
        {
          out << "<FieldData>\n<Array type=\"String\" Name=\"names of groups\" NumberOfTuples=\"" << names.size()
              << "\" format=\"ascii\">\n";
          for (const std::string &name : names)
            {
              for (const char letter : name)
                out << static_cast<unsigned int>(static_cast<unsigned char>(letter)) << " ";
              out << "0\n";
            }
          out << "</Array>\n</FieldData>\n";
        }
      out << "<Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\"" << n_all << "\">\n<PointData>\n";
      for (const PlainMesh::Field &field : mesh.point_fields)
        write_field(out, field, mesh.points.size());
      out << "</PointData>\n<CellData>\n";
      begin_array(out, "Int32", "group");
      for_each(mesh, [&](const Element &element) { out << element.group << "\n"; });
      out << "</DataArray>\n";
      for (const PlainMesh::Field &field : mesh.cell_fields)
        write_field(out, field, n_all);
      out << "</CellData>\n<Points>\n";
      begin_array(out, "Float64", "Points", 3);
      for (const PlainMesh::Position &x : mesh.points)
        out << scene::format_number(x[0]) << " " << scene::format_number(x[1]) << " " << scene::format_number(x[2]) << "\n";
      out << "</DataArray>\n</Points>\n";
      write_vtu_cells(out, mesh);
      out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
      return out.str();
    }

    std::string gmsh_text(const PlainMesh &mesh)
    {
      std::ostringstream out;
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << mesh.face_groups.size() + mesh.cell_groups.size() << "\n";
      for (const auto &[number, name] : mesh.face_groups)
        out << "2 " << number << " \"" << name << "\"\n";
      for (const auto &[number, name] : mesh.cell_groups)
        out << "3 " << number << " \"" << name << "\"\n";
      out << "$EndPhysicalNames\n$Nodes\n" << mesh.points.size() << "\n";
      std::size_t number = 0;
      for (const PlainMesh::Position &x : mesh.points)
        out << ++number << " " << scene::format_number(x[0]) << " " << scene::format_number(x[1]) << " " << scene::format_number(x[2])
            << "\n";
      out << "$EndNodes\n$Elements\n" << mesh.cells.size() + mesh.faces.size() << "\n";
      number = 0;
      for_each(mesh, [&](const Element &element) {
        out << ++number << " " << types_of(element.shape).gmsh << " 2 " << element.group << " " << element.group;
        for (unsigned int i = 0; i < n_corners(element.shape); ++i)
          out << " " << element.corner[i] + 1;
        out << "\n";
      });
      out << "$EndElements\n";
      return out.str();
    }
  } // namespace

  const std::vector<std::string> &mesh_endings()
  {
    static const std::vector<std::string> endings{".vtu", ".msh"};
    return endings;
  }

  std::string mesh_text(const PlainMesh &mesh, const std::string &ending)
  {
    if (ending == ".vtu")
      return vtu_text(mesh);
    if (ending == ".msh")
      return gmsh_text(mesh);
    throw std::logic_error("meshes are not written to files that end in \"" + ending + "\"");
  }
} // namespace myolines
