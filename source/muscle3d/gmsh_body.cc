#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/materials/tissue.h>
#include <myolines/muscle3d/gmsh_body.h>

#include <deal.II/base/geometry_info.h>

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
    using Point = dealii::Point<3>;

    struct Refusal
    {
      std::string where;

      [[noreturn]] void operator()(const std::string &what, const std::string &expected, const std::string &hint = "") const
      {
        throw InputError(InputProblem{where, what, expected, hint});
      }
    };

    std::string text(const Point &x)
    {
      std::ostringstream out;
      out << "(" << x << ") m";
      return out.str();
    }

    /// Gmsh, open on a file.
    class Session
    {
    public:
      Session(const std::filesystem::path &file, const Refusal &refuse)
      {
        gmsh::initialize(0, nullptr, false);
        try
          {
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::open(file.string());
          }
        catch (...)
          {
            gmsh::finalize();
            refuse("Gmsh cannot read " + file.string(), "a mesh in a format of Gmsh, 2.2 or 4.1, ASCII or binary");
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
          if (kind.name == group.name || (group.name.empty() && static_cast<int>(kind.id) == group.tag))
            return kind.id;
          names.push_back(kind.name);
        }
      if (group.name.empty() && group.tag == 0)
        return muscle_id;
      refuse("the physical volume " + (group.name.empty() ? std::to_string(group.tag) : "\"" + group.name + "\"") + " is no tissue",
             "one of " + join(names) + ", or the number 1, 2 or 3", "nearest: \"" + nearest_name(group.name, names) + "\"");
    }

    /// Smallest determinant of the map at the corners of a cell over the largest.
    double corner_quality(const std::vector<Point> &x, const unsigned int *v)
    {
      double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
      for (unsigned int i = 0; i < 8; ++i)
        {
          dealii::Tensor<1, 3> edge[3];
          for (unsigned int d = 0; d < 3; ++d)
            edge[d] = x[v[i | (1u << d)]] - x[v[i & ~(1u << d)]];
          const double J = edge[0] * dealii::cross_product_3d(edge[1], edge[2]);
          low            = std::min(low, J);
          high           = std::max(high, J);
        }
      return high > 0 ? low / high : -1;
    }

    using Face = std::array<unsigned int, 4>;

    /// Vertices of the faces that only one cell has, in the order of deal.II.
    std::vector<Face> boundary_faces(const std::vector<dealii::CellData<3>> &cells)
    {
      std::map<Face, std::pair<Face, int>> count;
      for (const auto &cell : cells)
        for (unsigned int f = 0; f < 6; ++f)
          {
            Face face;
            for (unsigned int i = 0; i < 4; ++i)
              face[i] = cell.vertices[dealii::GeometryInfo<3>::face_to_cell_vertices(f, i)];
            Face sorted = face;
            std::sort(sorted.begin(), sorted.end());
            auto &entry = count[sorted];
            entry.first = face;
            ++entry.second;
          }
      std::vector<Face> faces;
      for (const auto &[sorted, entry] : count)
        if (entry.second == 1)
          faces.push_back(entry.first);
      return faces;
    }

    /// Vertices by place, to find what coincides within a millionth of the body.
    class Places
    {
    public:
      Places(const std::vector<Point> &vertices, const double size)
        : cell_(1e-6 * size)
      {
        for (const Point &x : vertices)
          at_.insert(key(x));
      }
      std::size_t size() const { return at_.size(); }
      bool        contains(const Point &x) const { return at_.count(key(x)) > 0; }

    private:
      std::array<long, 3> key(const Point &x) const
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
          if (const Point middle = Point(0.5 * (x[f[i]] + x[f[j]])); places.contains(middle))
            refuse("a node hangs at " + text(middle) + ": cells of different size meet", "a conforming mesh");
    }
  } // namespace

  GmshBody::GmshBody(const std::filesystem::path &file, const double scale, const std::string &where)
  {
    const Refusal refuse{where};
    const Session session(file, refuse);

    std::vector<std::size_t> tags;
    std::vector<double>      coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    std::map<std::size_t, Point> nodes;
    for (std::size_t i = 0; i < tags.size(); ++i)
      nodes[tags[i]] = scale * Point(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);

    std::map<std::size_t, unsigned int> numbers; // only nodes of cells become vertices
    const auto                          vertex = [&](const std::size_t tag) {
      const auto [entry, fresh] = numbers.emplace(tag, vertices.size());
      if (fresh)
        vertices.push_back(nodes.at(tag));
      return entry->second;
    };
    constexpr unsigned int order[] = {0, 1, 3, 2, 4, 5, 7, 6}; // Gmsh goes round, deal.II row by row
    double                 worst   = 1;
    for (const Group &group : groups(3))
      for (const int entity : group.entities)
        {
          const std::vector<std::size_t> cell_nodes = elements(3, entity, 5, refuse);
          if (cell_nodes.empty())
            continue;
          const unsigned int id = tissue_of(group, refuse);
          for (std::size_t first = 0; first < cell_nodes.size(); first += 8)
            {
              dealii::CellData<3> cell;
              cell.material_id = id;
              for (unsigned int i = 0; i < 8; ++i)
                cell.vertices[i] = vertex(cell_nodes[first + order[i]]);
              const double quality = corner_quality(vertices, cell.vertices.data());
              if (!(quality > 0))
                refuse("a cell at " + text(vertices[cell.vertices[0]]) + " is inverted or degenerate",
                       "hexahedra with positive Jacobians at all corners");
              worst = std::min(worst, quality);
              cells.push_back(cell);
            }
        }
    if (cells.empty())
      refuse("the mesh has no cells", "hexahedra of 8 nodes", "in Gmsh: mesh in 3D and save all or the physical volumes");

    low = high = vertices.front();
    for (const Point &x : vertices)
      for (unsigned int c = 0; c < 3; ++c)
        {
          low[c]  = std::min(low[c], x[c]);
          high[c] = std::max(high[c], x[c]);
        }
    for (const TissueKind &kind : tissue_kinds())
      if (const auto n = std::count_if(cells.begin(), cells.end(), [&](const auto &c) { return c.material_id == kind.id; }); n > 0)
        {
          tissues.push_back(kind.name);
          report.push_back(std::to_string(n) + " cells of " + kind.name);
        }

    const std::vector<Face> outside = boundary_faces(cells);
    refuse_hanging_nodes(*this, outside, refuse);
    std::map<Face, unsigned int> named;
    for (const Group &group : groups(2))
      if (group.tag != 0)
        {
          for (const int entity : group.entities)
            {
              const std::vector<std::size_t> quads = elements(2, entity, 3, refuse);
              for (std::size_t first = 0; first < quads.size(); first += 4)
                {
                  Face face;
                  for (unsigned int i = 0; i < 4; ++i)
                    face[i] = vertex(quads[first + i]);
                  std::sort(face.begin(), face.end());
                  named[face] = face_names.size();
                }
            }
          face_names.push_back(group.name.empty() ? std::to_string(group.tag) : group.name);
        }
    std::vector<unsigned int> n_faces(face_names.size() + 1, 0);
    std::vector<Point>        sums(face_names.size());
    for (const Face &face : outside)
      {
        Face sorted = face;
        std::sort(sorted.begin(), sorted.end());
        const auto          found = named.find(sorted);
        dealii::CellData<2> quad;
        std::copy(face.begin(), face.end(), quad.vertices.begin());
        quad.boundary_id = found == named.end() ? unnamed : found->second;
        faces.boundary_quads.push_back(quad);
        ++n_faces[found == named.end() ? face_names.size() : found->second];
        if (found != named.end())
          for (const unsigned int v : face)
            sums[found->second] += 0.25 * vertices[v];
      }
    for (std::size_t i = 0; i < face_names.size(); ++i)
      {
        if (n_faces[i] == 0)
          refuse("the physical surface \"" + face_names[i] + "\" is not at the boundary of the cells", "surfaces of the body");
        const Point centre = Point(sums[i] / n_faces[i]);
        face_centres.push_back(Point(1e300, 0, 0));
        for (const auto &quad : faces.boundary_quads)
          if (quad.boundary_id == i)
            for (const unsigned int v : quad.vertices)
              if (vertices[v].distance(centre) < face_centres.back().distance(centre))
                face_centres.back() = vertices[v];
        report.push_back(std::to_string(n_faces[i]) + " quadrilaterals on the face \"" + face_names[i] + "\"");
      }
    if (n_faces.back() > 0)
      report.push_back(std::to_string(n_faces.back()) + " quadrilaterals of the boundary belong to no physical surface: free");
    std::ostringstream quality;
    quality << "smallest corner Jacobian over the largest of its cell: " << worst;
    report.push_back(quality.str());
  }
} // namespace myolines
