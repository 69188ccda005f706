#include "gmsh_mesh.h"

#include <myolines/base/error.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace myolines
{
  namespace
  {
    const std::vector<std::string> mesh_sections{
        "MeshFormat", "PhysicalNames", "Entities", "PartitionedEntities", "Nodes", "Elements", "Periodic", "GhostElements", "NOD", "ELM"};

    /// Of the mesh and of others, from "$Name" to the end of the line with "$EndName".
    struct GmshSection
    {
      std::string name, body; ///< body: between both lines
      std::size_t begin, end;
    };

    /// The sections of a file one after the other.
    class GmshSections
    {
    public:
      GmshSections(const std::filesystem::path &file, const std::string &text)
        : file_(file)
        , text_(text)
      {}

      /// False if there is no further one.
      bool next(GmshSection &section)
      {
        for (std::size_t line = at_; line < text_.size(); line = next_line(line))
          if (text_[line] == '$')
            {
              const std::size_t body  = next_line(line);
              const std::string name  = scene::trimmed(text_.substr(line + 1, body - line - 1));
              const bool        first = name == "NOD" || name == "ELM"; // version 1 of the format shouts
              const std::size_t close = text_.find((first ? "$END" : "$End") + name, body);
              const bool        ours  = std::find(mesh_sections.begin(), mesh_sections.end(), name) != mesh_sections.end();
              if (close == std::string::npos && ours)
                refuse("the section $" + name + " has no end: the file is cut off");
              if (close == std::string::npos)
                continue;
              at_     = next_line(close);
              section = {name, text_.substr(body, close - body), line, at_};
              return true;
            }
        return false;
      }

      [[noreturn]] void refuse(const std::string &what) const
      {
        throw InputError(InputProblem{file_.string(), what, gmsh_formats, "in Gmsh: File, Export, as .msh"});
      }

    private:
      std::size_t next_line(const std::size_t from) const
      {
        const std::size_t end = text_.find('\n', from);
        return end == std::string::npos ? text_.size() : end + 1;
      }

      const std::filesystem::path &file_;
      const std::string           &text_;
      std::size_t                  at_ = 0;
    };

    struct GmshFormat
    {
      double version;
      bool   binary;
    };

    /// "4.1 0 8"
    GmshFormat gmsh_format(const GmshSection &section, const GmshSections &sections)
    {
      if (section.name == "NOD")
        return {1, false};
      std::istringstream line(section.body.substr(0, section.body.find('\n')));
      std::string        version, binary;
      line >> version >> binary;
      const auto number = scene::parse_number(version);
      if (!number || (binary != "0" && binary != "1") || !(*number >= 2 && *number < 5))
        sections.refuse("the format \"" + scene::trimmed(line.str()) + "\" is not known");
      return {*number, binary == "1"};
    }

    /// Every node and element takes at least two bytes: a larger number would only make the reader ask for memory.
    void refuse_impossible_count(const GmshSection &section, const GmshFormat format, const GmshSections &sections)
    {
      if (section.name != "Nodes" && section.name != "Elements" && section.name != "NOD" && section.name != "ELM")
        return;
      if (format.version >= 4 && format.binary) // numbers are no text
        return;
      std::istringstream numbers(section.body.substr(0, section.body.find('\n')));
      double             count = -1;
      numbers >> count;
      if (format.version >= 4) // blocks first
        numbers >> count;
      if (!(count >= 0) || count > static_cast<double>(section.body.size()) / 2)
        sections.refuse("the section $" + section.name + " announces \"" + scene::trimmed(numbers.str()) + "\", which its " +
                        std::to_string(section.body.size()) + " bytes cannot hold");
    }
  } // namespace

  std::string gmsh_mesh(const std::filesystem::path &file)
  {
    const std::string text  = scene::read_input_bytes(file);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    GmshSections      sections(file, text);
    const auto        begins_with = [&](const std::string &word) {
      return first != std::string::npos && text.compare(first, word.size(), word) == 0 &&
             text.find_first_of(" \t\r\n", first) == first + word.size();
    };
    if (!begins_with("$MeshFormat") && !begins_with("$NOD"))
      sections.refuse("this is no mesh of Gmsh: its first line is another one");

    std::string mesh;
    GmshSection section;
    GmshFormat  format{};
    while (sections.next(section))
      if (std::find(mesh_sections.begin(), mesh_sections.end(), section.name) != mesh_sections.end())
        {
          if (mesh.empty())
            format = gmsh_format(section, sections);
          refuse_impossible_count(section, format, sections);
          mesh += text.substr(section.begin, section.end - section.begin);
          if (mesh.back() != '\n')
            mesh += '\n';
        }
    return mesh;
  }
} // namespace myolines
