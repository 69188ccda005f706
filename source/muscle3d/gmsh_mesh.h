#pragma once

#include <filesystem>
#include <string>

namespace myolines
{
  inline const std::string gmsh_formats =
      "a mesh in a format of Gmsh, 1, 2.2 or 4.1, ASCII or binary: its first line is $MeshFormat or $NOD";

  /// The mesh in @p file in the format of the file: its sections of nodes, elements, entities and names, and nothing else. Other sections
  /// and what stands between and behind them (commands for views, a script) are left out.
  /// @throws InputError if the file is none, is cut off, or announces more nodes or elements than it can hold.
  std::string gmsh_mesh(const std::filesystem::path &file);
} // namespace myolines
