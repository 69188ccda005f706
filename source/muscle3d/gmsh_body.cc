#include "gmsh_mesh.h"
#include "hexahedra.h"

#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/base/names.h>
#include <myolines/base/scratch_folder.h>
#include <myolines/materials/tissue.h>
#include <myolines/muscle3d/cell_id.h>
#include <myolines/muscle3d/gmsh_body.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gmsh.h>
#include <map>
#include <set>
#include <sstream>

namespace myolines
{
  namespace
  {
    using Face = Quadrilateral;

    struct Refusal
    {
      std::string where;

      [[noreturn]] void operator()(const std::string &what, const std::string &expected, const std::string &hint = "") const
      {
        throw InputError(InputProblem{where, what, expected, hint});
      }
    };

    std::string text(const dealii::Point<3> &x)
    {
      std::ostringstream out;
      out << "(" << x << ") m";
      return out.str();
    }

    /// What is wrong with a file is told where the scene names it.
    std::string mesh_in(const std::filesystem::path &file, const Refusal &refuse)
    {
      try
        {
          return gmsh_mesh(file);
        }
      catch (const InputError &error)
        {
          const InputProblem &problem = error.problems().front();
          refuse(problem.where + ": " + problem.what, problem.expected, problem.hint);
        }
    }

    /// Gmsh, open on the mesh in a file. It gets a copy of the mesh alone in a folder of its own: what it takes for a script it executes,
    /// and beside a file it looks for options.
    class Session
    {
    public:
      Session(const std::filesystem::path &file, const Refusal &refuse)
      {
        const ScratchFolder         scratch;
        const std::filesystem::path copy = scratch.path() / "mesh.msh";
        write_file(copy, mesh_in(file, refuse));
        gmsh::initialize(0, nullptr, false);
        try
          {
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::open(copy.string());
          }
        catch (...)
          {
            gmsh::finalize();
            refuse("Gmsh cannot read " + file.string(), gmsh_formats);
          }
      }
      ~Session() { gmsh::finalize(); }
    };

    /// Entities of a dimension by the tag of their physical group, with its name; tag 0: none.
    struct Group
    {
      int              tag;
      std::string      name;
      std::vector<int> entities;
    };
    std::vector<Group> groups(const int dimension)
    {
      gmsh::vectorpair all, entities;
      gmsh::model::getPhysicalGroups(all, dimension);
      std::set<int>      grouped;
      std::vector<Group> found;
      for (const auto &[d, tag] : all)
        {
          Group group{tag, "", {}};
          gmsh::model::getPhysicalName(d, tag, group.name);
          gmsh::model::getEntitiesForPhysicalGroup(d, tag, group.entities);
          grouped.insert(group.entities.begin(), group.entities.end());
          found.push_back(group);
        }
      gmsh::model::getEntities(entities, dimension);
      Group rest{0, "", {}};
      for (const auto &[d, tag] : entities)
        if (grouped.count(tag) == 0)
          rest.entities.push_back(tag);
      found.push_back(rest);
      return found;
    }

    /// Nodes of the elements of an entity, n each. @throws if there are others than @p type.
    std::vector<std::size_t> elements(const int dimension, const int entity, const int type, const Refusal &refuse)
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
      std::vector<std::size_t> all;
      for (std::size_t i = 0; i < types.size(); ++i)
        {
          std::string         name;
          int                 d, order, n, n_primary;
          std::vector<double> local;
          gmsh::model::mesh::getElementProperties(types[i], name, d, order, n, local, n_primary);
          if (types[i] != type)
            refuse("the mesh has elements of kind " + name, dimension == 3 ? "hexahedra of 8 nodes only" : "quadrilaterals of 4 nodes only",
                   "in Gmsh: transfinite volumes and recombined surfaces, order 1");
          all.insert(all.end(), nodes[i].begin(), nodes[i].end());
        }
      return all;
    }

    unsigned int tissue_of(const Group &group, const Refusal &refuse)
    {
      std::vector<std::string> names;
      for (const TissueKind &kind : tissue_kinds())
        {
          const bool named = group.name == kind.name || group.name.rfind(kind.name + " ", 0) == 0;
          if (named || (group.name.empty() && static_cast<int>(kind.id) == group.tag))
            return kind.id;
          names.push_back(kind.name);
        }
      if (group.name.empty() && group.tag == 0)
        return muscle_id;
      refuse("the physical volume " + (group.name.empty() ? std::to_string(group.tag) : "\"" + group.name + "\"") + " is no tissue",
             "one of " + join(names) + ", perhaps with a space and more words after it, or the number 1, 2 or 3",
             nearest_hint(group.name, names));
    }

    CellId cell_id(const Group &group, const Refusal &refuse)
    {
      if (group.tag >= static_cast<int>(CellId::max_volumes))
        refuse("the physical volume " + std::to_string(group.tag) + " has too large a number",
               "at most " + std::to_string(CellId::max_volumes - 1));
      return {tissue_of(group, refuse), static_cast<unsigned int>(group.tag)};
    }

    /// Vertices by place, to find what coincides within a millionth of the body.
    class Places
    {
    public:
      Places(const std::vector<dealii::Point<3>> &vertices, const double size)
        : cell_(1e-6 * size)
      {
        for (const dealii::Point<3> &x : vertices)
          at_.insert(key(x));
      }
      std::size_t size() const { return at_.size(); }
      bool        contains(const dealii::Point<3> &x) const { return at_.count(key(x)) > 0; }

    private:
      std::array<long, 3> key(const dealii::Point<3> &x) const
      {
        return {{std::lround(x[0] / cell_), std::lround(x[1] / cell_), std::lround(x[2] / cell_)}};
      }
      double                        cell_;
      std::set<std::array<long, 3>> at_;
    };

    void refuse_hanging_nodes(const GmshBody &body, const std::vector<Face> &faces, const Refusal &refuse)
    {
      const Places places(body.vertices, body.low.distance(body.high));
      if (places.size() < body.vertices.size())
        refuse("some nodes coincide: parts of the mesh touch but are not joined", "one node at one place", "in Gmsh: Coherence Mesh");
      const auto &x = body.vertices;
      for (const Face &f : faces)
        for (const auto &[i, j] : {std::pair(0, 1), std::pair(1, 3), std::pair(3, 2), std::pair(2, 0), std::pair(0, 3)})
          if (const dealii::Point<3> middle = dealii::Point<3>(0.5 * (x[f[i]] + x[f[j]])); places.contains(middle))
            refuse("a node hangs at " + text(middle) + ": cells of different size meet", "a conforming mesh");
    }

    /// Fills a body from the file that Gmsh has open.
    class Reader
    {
    public:
      Reader(GmshBody &body, const double scale, const Refusal &refuse)
        : body_(body)
        , refuse_(refuse)
      {
        std::vector<std::size_t> tags;
        std::vector<double>      coordinates, parameters;
        gmsh::model::mesh::getNodes(tags, coordinates, parameters);
        for (std::size_t i = 0; i < tags.size(); ++i)
          nodes_[tags[i]] = scale * dealii::Point<3>(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
      }

      void read_cells()
      {
        for (const Group &group : groups(3))
          read_volume(group);
        if (body_.cells.empty())
          refuse_("the mesh has no cells", "hexahedra of 8 nodes", "in Gmsh: mesh in 3D and save all or the physical volumes");
        for (const TissueKind &kind : tissue_kinds())
          if (const auto n = std::count_if(body_.cells.begin(), body_.cells.end(),
                                           [&](const auto &c) { return CellId::of(c.material_id).tissue == kind.id; });
              n > 0)
            {
              body_.tissues.push_back(kind.name);
              body_.report.push_back(std::to_string(n) + " cells of " + kind.name);
            }
        std::ostringstream quality;
        quality << "volume " << body_.volume << " m^3; smallest corner Jacobian over the largest of its cell: " << worst_;
        body_.report.push_back(quality.str());
      }

      void read_box()
      {
        body_.low = body_.high = body_.vertices.front();
        for (const dealii::Point<3> &x : body_.vertices)
          for (unsigned int c = 0; c < 3; ++c)
            {
              body_.low[c]  = std::min(body_.low[c], x[c]);
              body_.high[c] = std::max(body_.high[c], x[c]);
            }
      }

      void read_faces(const std::vector<Face> &outside)
      {
        const std::map<Face, unsigned int> named = named_quadrilaterals();
        std::vector<std::vector<Face>>     of_name(body_.face_names.size());
        unsigned int                       free = 0;
        for (const Face &face : outside)
          {
            const auto          found = named.find(sorted(face));
            dealii::CellData<2> quad;
            std::copy(face.begin(), face.end(), quad.vertices.begin());
            quad.boundary_id = found == named.end() ? GmshBody::unnamed : found->second;
            body_.faces.boundary_quads.push_back(quad);
            if (found == named.end())
              ++free;
            else
              of_name[found->second].push_back(face);
          }
        for (std::size_t i = 0; i < of_name.size(); ++i)
          add_face(body_.face_names[i], of_name[i]);
        if (free > 0)
          body_.report.push_back(std::to_string(free) + " quadrilaterals of the boundary belong to no physical surface: free");
      }

    private:
      static Face sorted(Face face)
      {
        std::sort(face.begin(), face.end());
        return face;
      }

      void read_volume(const Group &group)
      {
        const std::size_t before = body_.cells.size();
        for (const int entity : group.entities)
          if (const std::vector<std::size_t> cell_nodes = elements(3, entity, 5, refuse_); !cell_nodes.empty())
            {
              if (!seen_.insert(entity).second)
                refuse_("a volume of the physical group " + title(group) + " belongs to another group, too",
                        "one physical volume for each part");
              const CellId id = cell_id(group, refuse_);
              for (std::size_t first = 0; first < cell_nodes.size(); first += 8)
                add_cell(&cell_nodes[first], id.material_id());
            }
        if (const std::size_t n = body_.cells.size() - before; n > 0 && group.tag != 0)
          body_.report.push_back(std::to_string(n) + " cells in volume " + title(group));
      }

      static std::string title(const Group &group)
      {
        return std::to_string(group.tag) + (group.name.empty() ? "" : ", \"" + group.name + "\"");
      }

      /// Only nodes of cells become vertices.
      unsigned int vertex(const std::size_t tag)
      {
        const auto [entry, fresh] = numbers_.emplace(tag, body_.vertices.size());
        if (fresh)
          body_.vertices.push_back(nodes_.at(tag));
        return entry->second;
      }

      void add_cell(const std::size_t *cell_nodes, const unsigned int id)
      {
        constexpr unsigned int order[] = {0, 1, 3, 2, 4, 5, 7, 6}; // Gmsh goes round, deal.II row by row
        dealii::CellData<3>    cell;
        cell.material_id = id;
        for (unsigned int i = 0; i < 8; ++i)
          cell.vertices[i] = vertex(cell_nodes[order[i]]);
        const double quality = corner_quality(body_.vertices, cell.vertices.data());
        if (!(quality > 0))
          refuse_("a cell at " + text(body_.vertices[cell.vertices[0]]) + " is inverted or degenerate",
                  "hexahedra with positive Jacobians at all corners");
        worst_ = std::min(worst_, quality);
        body_.volume += cell_volume(body_.vertices, cell.vertices.data());
        body_.cells.push_back(cell);
      }

      /// Place of the name by sorted vertices; fills the names.
      std::map<Face, unsigned int> named_quadrilaterals()
      {
        std::map<Face, unsigned int> named;
        for (const Group &group : groups(2))
          if (group.tag != 0)
            {
              for (const int entity : group.entities)
                {
                  const std::vector<std::size_t> quads = elements(2, entity, 3, refuse_);
                  for (std::size_t first = 0; first < quads.size(); first += 4)
                    {
                      Face face;
                      for (unsigned int i = 0; i < 4; ++i)
                        face[i] = vertex(quads[first + i]);
                      named[sorted(face)] = body_.face_names.size();
                    }
                }
              body_.face_names.push_back(group.name.empty() ? std::to_string(group.tag) : group.name);
            }
        return named;
      }

      void add_face(const std::string &name, const std::vector<Face> &quads)
      {
        if (quads.empty())
          refuse_("the physical surface \"" + name + "\" is not at the boundary of the cells", "surfaces of the body");
        dealii::Point<3> centre;
        for (const Face &quad : quads)
          for (const unsigned int v : quad)
            centre += body_.vertices[v] / (4. * quads.size());
        dealii::Point<3> nearest = body_.vertices[quads.front()[0]];
        for (const Face &quad : quads)
          for (const unsigned int v : quad)
            if (body_.vertices[v].distance(centre) < nearest.distance(centre))
              nearest = body_.vertices[v];
        body_.face_centres.push_back(nearest);
        body_.report.push_back(std::to_string(quads.size()) + " quadrilaterals on the face \"" + name + "\"");
      }

      GmshBody                               &body_;
      const Refusal                          &refuse_;
      std::map<std::size_t, dealii::Point<3>> nodes_;   ///< by tag
      std::map<std::size_t, unsigned int>     numbers_; ///< of vertices by tag
      std::set<int>                           seen_;    ///< entities whose cells have been added
      double                                  worst_ = 1;
    };
  } // namespace

  GmshBody::GmshBody(const std::filesystem::path &file, const double scale, const std::string &where)
  {
    const Refusal refuse{where};
    const Session session(file, refuse);
    Reader        reader(*this, scale, refuse);
    reader.read_cells();
    reader.read_box();
    const std::vector<Face> outside = outer_faces(cells);
    refuse_hanging_nodes(*this, outside, refuse);
    reader.read_faces(outside);
  }
} // namespace myolines
