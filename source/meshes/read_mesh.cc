// SPDX-License-Identifier: LGPL-2.1-or-later
#include "formats.h"

#include <myolines/scene/input_text.h>

namespace myolines
{
  namespace
  {
    std::string_view without_white_space(std::string_view text)
    {
      const std::size_t first = text.find_first_not_of(" \t\r\n");
      return first == std::string_view::npos ? std::string_view() : text.substr(first);
    }

    bool begins_with(const std::string_view text, const std::string_view word) { return text.substr(0, word.size()) == word; }

    /// A keyword of Abaqus in the first line that is no comment.
    bool is_abaqus(std::string_view text)
    {
      while (begins_with(text, "**"))
        {
          const std::size_t end = text.find('\n');
          text                  = end == std::string_view::npos ? std::string_view() : without_white_space(text.substr(end));
        }
      return text.size() > 1 && text[0] == '*' && ((text[1] >= 'A' && text[1] <= 'Z') || (text[1] >= 'a' && text[1] <= 'z'));
    }
  } // namespace

  void MeshBuilder::add_point(const std::int64_t number, const PlainMesh::Position &x)
  {
    const auto [entry, fresh] = places_.emplace(number, static_cast<unsigned int>(mesh_.points.size()));
    if (fresh)
      mesh_.points.push_back(x);
    else if (mesh_.points[entry->second] != x)
      cursor_.refuse("the point " + std::to_string(number) + " is there twice, at different places", "one place for each number");
  }

  void MeshBuilder::add(const PlainMesh::Shape shape, const std::vector<int> &groups, const std::vector<std::int64_t> &numbers)
  {
    PlainMesh::Element element{shape, groups.empty() ? 0 : groups.front(), {}};
    for (unsigned int i = 0; i < n_corners(shape); ++i)
      {
        const auto found = place(numbers[i]);
        if (!found)
          cursor_.refuse("an element has the point " + std::to_string(numbers[i]) + ", which is not in the file", "a number of a point");
        element.corner[i] = *found;
      }
    if (!faces_of(shape).empty())
      {
        if (groups.size() > 1)
          mesh_.further_groups[mesh_.cells.size()].assign(groups.begin() + 1, groups.end());
        mesh_.cells.push_back(element);
        return;
      }
    mesh_.faces.push_back(element);
    for (std::size_t i = 1; i < groups.size(); ++i)
      {
        element.group = groups[i];
        mesh_.faces.push_back(element);
      }
  }

  std::optional<unsigned int> MeshBuilder::place(const std::int64_t number) const
  {
    const auto found = places_.find(number);
    return found == places_.end() ? std::nullopt : std::optional<unsigned int>(found->second);
  }

  PlainMesh read_mesh(const std::filesystem::path &file) { return parse_mesh(scene::read_input_bytes(file), file); }

  PlainMesh parse_mesh(const std::string &bytes, const std::filesystem::path &file)
  {
    Cursor                 cursor(file, bytes);
    const std::string_view text = without_white_space(bytes);
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    if (word == "$MeshFormat" || word == "$NOD" || word == "$Comments")
      return read_gmsh(cursor);
    if (begins_with(text, "# vtk DataFile"))
      return read_legacy_vtk(cursor);
    if (begins_with(text, "<?xml") || begins_with(text, "<VTKFile"))
      return read_vtu(cursor);
    if (is_abaqus(text))
      return read_abaqus(cursor);
    cursor.refuse("this is no mesh: its first line is none of a format that is known",
                  "$MeshFormat or $NOD (Gmsh, .msh), # vtk DataFile (.vtk), <VTKFile (.vtu) or a keyword like *HEADING (Abaqus, .inp)");
  }
} // namespace myolines
