// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_refusal.h"

#include <myolines/base/counted.h>
#include <myolines/base/names.h>
#include <myolines/body/cell_id.h>
#include <myolines/materials/tissue.h>

#include <algorithm>
#include <map>
#include <set>

namespace myolines
{
  namespace
  {
    std::string small_letters(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::tolower(c); });
      return text;
    }

    /// What the groups of a mesh stand for.
    class TissuesOfGroups
    {
    public:
      TissuesOfGroups(const PlainMesh &mesh, const TissueNames &names, const MeshRefusal &refuse)
        : mesh_(mesh)
        , names_(names)
        , refuse_(refuse)
      {
        for (const auto &cell : mesh.cells)
          groups_.insert(cell.group);
        for (const auto &[cell, more] : mesh.further_groups)
          groups_.insert(more.begin(), more.end());
      }

      /// Of a cell in all these groups: that of the only one that is a tissue.
      CellId of(const std::vector<int> &groups) const
      {
        CellId found{0, 0};
        for (const int group : groups)
          if (const unsigned int tissue = tissue_of(group); tissue != 0)
            {
              if (found.tissue != 0 && found.volume != static_cast<unsigned int>(group))
                refuse_("a cell of the volume " + title(group) + " belongs to another group, too: " + title(static_cast<int>(found.volume)),
                        "one tissue for each cell");
              found = {tissue, static_cast<unsigned int>(group)};
            }
        if (found.tissue == 0)
          refuse_unknown(groups.front());
        if (found.volume >= CellId::max_volumes)
          refuse_("the volume " + title(groups.front()) + " has too large a number", "at most " + std::to_string(CellId::max_volumes - 1));
        return found;
      }

      /// "2, "muscle medial""
      std::string title(const int group) const
      {
        const std::string name = name_of(group);
        return std::to_string(group) + (name.empty() ? "" : ", \"" + name + "\"");
      }

      /// The only group, where it names no tissue and is all muscle; else nothing.
      std::string stranger() const
      {
        const int only = groups_.size() == 1 ? *groups_.begin() : 0;
        return only != 0 && known_tissue(only) == 0 && tissue_of(only) != 0 ? title(only) : "";
      }

    private:
      std::string name_of(const int group) const
      {
        const auto found = mesh_.cell_groups.find(group);
        return found == mesh_.cell_groups.end() ? "" : found->second;
      }

      /// By name, perhaps with more words behind it, or by number; 0 if it is none.
      unsigned int known_tissue(const int group) const
      {
        const std::string name = small_letters(name_of(group));
        if (group == 0)
          return muscle_id;
        unsigned int known  = 0;
        std::size_t  length = 0; // of the name: "fat pad" comes before "fat"
        for (unsigned int id = 1; id <= names_.size(); ++id)
          {
            const std::string tissue = small_letters(names_[id - 1]), next = name.substr(std::min(tissue.size(), name.size()), 1);
            const bool        same = name.rfind(tissue, 0) == 0 && (next.empty() || next == " " || next == "_" || next == "-");
            if (name.empty() ? static_cast<int>(id) == group : same && tissue.size() > length)
              {
                known  = id;
                length = tissue.size();
              }
          }
        return known;
      }

      /// A single group of another name is muscle, if the name is not nearly that of a tissue.
      unsigned int tissue_of(const int group) const
      {
        const unsigned int known = known_tissue(group);
        return known == 0 && groups_.size() == 1 && nearest_name(small_letters(name_of(group)), names_).empty() ? muscle_id : known;
      }

      [[noreturn]] void refuse_unknown(const int group) const
      {
        const std::string name = name_of(group);
        refuse_("the volume " + (name.empty() ? std::to_string(group) : "\"" + name + "\"") + " is no tissue",
                "one of " + join(names_) + ", perhaps with a space and more words after it, or the number of one, from 1 to " +
                    std::to_string(names_.size()),
                nearest_hint(small_letters(name), names_));
      }

      const PlainMesh   &mesh_;
      const TissueNames &names_;
      const MeshRefusal &refuse_;
      std::set<int>      groups_;
    };
  } // namespace

  std::vector<unsigned int> tissues_of_cells(const PlainMesh &mesh, const TissueNames &names, MeshBody &body, const MeshRefusal &refuse)
  {
    const TissuesOfGroups               tissues(mesh, names, refuse);
    std::map<std::vector<int>, CellId>  known;
    std::vector<unsigned int>           ids;
    std::map<unsigned int, std::size_t> of_tissue, of_volume;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
      {
        std::vector<int> groups{mesh.cells[i].group};
        if (const auto more = mesh.further_groups.find(i); more != mesh.further_groups.end())
          groups.insert(groups.end(), more->second.begin(), more->second.end());
        auto found = known.find(groups);
        if (found == known.end())
          found = known.emplace(groups, tissues.of(groups)).first;
        ids.push_back(found->second.material_id());
        ++of_tissue[found->second.tissue];
        ++of_volume[found->second.volume];
      }
    for (const auto &[volume, n] : of_volume)
      if (volume != 0)
        body.report.push_back(counted(n, "cell") + " in volume " + tissues.title(static_cast<int>(volume)));
    if (const std::string stranger = tissues.stranger(); !stranger.empty())
      body.report.push_back("volume " + stranger + " is the only one and names no tissue: all is muscle");
    for (const auto &[tissue, n] : of_tissue)
      {
        body.tissues.push_back(names[tissue - 1]);
        body.report.push_back(counted(n, "cell") + " of " + body.tissues.back());
      }
    return ids;
  }
} // namespace myolines
