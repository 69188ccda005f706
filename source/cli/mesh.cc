// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/body/mesh_export.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/meshes/write.h>
#include <myolines/muscle3d/parameters.h>
#include <myolines/output/text_file.h>

#include <algorithm>

namespace myolines
{
  void mesh_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, const std::filesystem::path &file,
                    std::ostream &out)
  {
    const std::vector<std::string> &endings = mesh_endings();
    if (std::find(endings.begin(), endings.end(), file.extension().string()) == endings.end())
      throw InputError(InputProblem{"--out " + file.string(), "its ending names no format", "one of " + join(endings), ""});
    const scene::Node  read   = read_whole_scene(scene, overrides);
    const scene::Node &system = read.section("system");
    if (system.text("type") != "muscle 3d")
      system.refuse("type", "a system of type \"" + system.text("type") + "\" has no mesh of cells", "\"muscle 3d\"");
    const TissueNames tissues = read_tissue_names(system.section("tissues"));
    const PlainMesh   mesh    = export_mesh(read_geometry(system.section("geometry"), tissues), tissues);
    on_writing_rank(file.string(), "a path in a folder that exists and can be written", "",
                    [&] { replace_file(file, mesh_text(mesh, file.extension().string())); });
    out << "mesh written: " << file.string() << ", "
        << (mesh.cells.size() == 1 ? "1 hexahedron" : std::to_string(mesh.cells.size()) + " hexahedra") << ", " << mesh.points.size()
        << " points, in metres\n";
    for (const auto &[number, name] : mesh.cell_groups)
      out << "  cells " << number << ": " << name << "\n";
    for (const auto &[number, name] : mesh.face_groups)
      out << "  face " << number << ": " << name << "\n";
  }
} // namespace myolines
