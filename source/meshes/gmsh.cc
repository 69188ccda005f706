// SPDX-License-Identifier: LGPL-2.1-or-later
#include "gmsh_kinds.h"

#include <cstdlib>
#include <limits>

namespace myolines
{
  namespace
  {
    using Shape = PlainMesh::Shape;

    const std::string gmsh_versions = "a version of Gmsh, 1, 2.0 to 2.2, 4.0 or 4.1, ASCII (0) or binary (1) with numbers of 8 bytes";

    /// Group of a name that Gmsh makes for the parts of a partition; they are no groups of the user's.
    bool is_of_partition(const std::string &name) { return name.rfind("_part{", 0) == 0; }

    class GmshReader
    {
    public:
      explicit GmshReader(Cursor &cursor)
        : cursor_(cursor)
        , builder_(cursor, mesh_)
      {}

      PlainMesh read()
      {
        while (cursor_.left() > 0)
          {
            cursor_.binary              = false;
            const std::string_view line = cursor_.line();
            if (const std::size_t first = line.find_first_not_of(" \t"); first != std::string_view::npos && line[first] == '$')
              {
                const std::size_t last = line.find_last_not_of(" \t");
                section(std::string(line.substr(first + 1, last - first)));
              }
          }
        if (!nodes_ || !elements_)
          cursor_.refuse(std::string("there is no section $") + (version_ == 1 ? (nodes_ ? "ELM" : "NOD")
                                                                 : nodes_      ? "Elements"
                                                                               : "Nodes"),
                         "nodes and elements");
        return std::move(mesh_);
      }

    private:
      void section(const std::string &name)
      {
        if (name.rfind("End", 0) == 0 || name.rfind("END", 0) == 0)
          return;
        if (name == "NOD" || name == "ELM")
          version_ = 1;
        if (name == "MeshFormat")
          read_format();
        else if (name == "PhysicalNames")
          read_names();
        else if (name == "Entities" || name == "PartitionedEntities")
          in_numbers([&] { read_gmsh4_entities(cursor_, version_, name[0] == 'P', entities_); });
        else if (name == "Nodes" || name == "NOD")
          {
            nodes_ = true;
            in_numbers([&] { version_ < 3 ? read_nodes() : read_gmsh4_nodes(cursor_, version_, builder_); });
          }
        else if (name == "Elements" || name == "ELM")
          {
            elements_ = true;
            in_numbers([&] { version_ < 3 ? read_elements() : read_gmsh4_elements(cursor_, version_, entities_, mesh_, builder_); });
          }
        else
          return leave(name, false);
        leave(name, true);
      }

      /// Reads what may be binary.
      template <typename Action>
      void in_numbers(const Action &action)
      {
        if (mesh_.format.empty() && version_ != 1)
          cursor_.refuse("a section stands before $MeshFormat", "$MeshFormat first");
        cursor_.binary = binary_;
        action();
        cursor_.binary = false;
      }

      /// Goes behind the line that ends a section. In one that was @p read nothing may be left: its counts would be wrong.
      void leave(const std::string &name, const bool read)
      {
        const std::size_t end = cursor_.bytes().find((name == "NOD" || name == "ELM" ? "$END" : "$End") + name, cursor_.at());
        if (end == std::string_view::npos && read)
          cursor_.refuse("the section $" + name + " has no end: the file is cut off", "$End" + name);
        if (end == std::string_view::npos)
          return;
        const std::size_t more = cursor_.bytes().find_first_not_of(" \t\r\n", cursor_.at());
        if (read && more < end)
          {
            cursor_.go_to(more);
            cursor_.refuse("the section $" + name + " has more than the number at its beginning announces", "$End" + name,
                           "the file is damaged, or the number was not changed with the section");
          }
        cursor_.go_to(end);
        cursor_.line();
      }

      /// "4.1 0 8"
      void read_format()
      {
        Cursor                 words  = cursor_;
        const std::string_view text   = cursor_.line();
        version_                      = number_of(words.word());
        const std::string_view binary = words.word(), size = words.word();
        const bool             known = (version_ >= 2 && version_ < 3) || (version_ >= 4 && version_ < 4.2);
        if (!known || (binary != "0" && binary != "1") || size != "8")
          cursor_.refuse("the format \"" + std::string(text) + "\" is not known", gmsh_versions);
        binary_      = binary == "1";
        mesh_.format = "Gmsh " + std::string(text.substr(0, text.find(' '))) + (binary_ ? ", binary" : ", ASCII");
        if (!binary_)
          return;
        cursor_.binary = true;
        if (const auto one = cursor_.raw<std::int32_t>("the number that tells the order of bytes"); one != 1)
          {
            cursor_.swapped = true;
            if (one != 0x01000000)
              cursor_.refuse("the number that tells the order of bytes is " + std::to_string(one), "1");
          }
        cursor_.binary = false;
      }

      /// Lines of dimension, number and a name in quotation marks.
      void read_names()
      {
        const std::size_t n = cursor_.count(cursor_.integer("the number of names"), 5, "names");
        for (std::size_t i = 0; i < n; ++i)
          {
            const auto             dimension = cursor_.integer("the dimension of a group");
            const int              number    = static_cast<int>(cursor_.integer("the number of a group"));
            const std::string_view rest      = cursor_.line();
            const std::size_t      first = rest.find('"'), last = rest.rfind('"');
            if (first == last)
              cursor_.refuse("the group " + std::to_string(number) + " has no name in quotation marks", "dimension number \"name\"");
            const std::string name(rest.substr(first + 1, last - first - 1));
            if (is_of_partition(name))
              continue;
            if (dimension == 3)
              mesh_.cell_groups[number] = name;
            if (dimension == 2)
              mesh_.face_groups[number] = name;
          }
      }

      /// Of versions 1 and 2: number and place of each.
      void read_nodes()
      {
        const bool binary    = cursor_.binary;
        cursor_.binary       = false; // their number is text in any case
        const auto announced = cursor_.integer("the number of nodes");
        if (binary)
          cursor_.line();
        cursor_.binary      = binary;
        const std::size_t n = cursor_.count(announced, binary ? 28 : 8, "nodes");
        mesh_.points.reserve(n);
        for (std::size_t i = 0; i < n; ++i)
          {
            const auto          number = cursor_.integer("the number of a node");
            PlainMesh::Position x;
            for (double &c : x)
              c = cursor_.number("a coordinate");
            builder_.add_point(number, x);
          }
      }

      void read_elements()
      {
        const bool binary    = cursor_.binary;
        cursor_.binary       = false;
        const auto announced = cursor_.integer("the number of elements");
        if (binary)
          cursor_.line();
        cursor_.binary      = binary;
        const std::size_t n = cursor_.count(announced, 8, "elements");
        for (std::size_t read = 0; read < n;)
          read += binary ? read_block(n - read) : read_element();
      }

      std::size_t read_element()
      {
        cursor_.integer("the number of an element");
        const GmshKind kind = gmsh_kind(cursor_.integer("the type of an element"), cursor_);
        if (version_ == 1)
          {
            const int group = static_cast<int>(cursor_.integer("the physical number of an element"));
            cursor_.integer("the elementary number of an element");
            if (const auto nodes = cursor_.integer("a number of nodes"); nodes != static_cast<std::int64_t>(kind.n_nodes))
              cursor_.refuse("an element has " + std::to_string(nodes) + " nodes", std::to_string(kind.n_nodes) + " for its type");
            read_corners(kind, group);
            return 1;
          }
        read_tagged(kind, cursor_.integer("the number of tags"));
        return 1;
      }

      /// Elements of one type and number of tags.
      std::size_t read_block(const std::size_t most)
      {
        const GmshKind    kind      = gmsh_kind(cursor_.integer("the type of elements"), cursor_);
        const auto        announced = cursor_.integer("a number of elements"), tags = cursor_.integer("the number of tags");
        const std::size_t n = cursor_.count(announced, 4 * kind.n_nodes, "elements of one type");
        if (n == 0 || n > most)
          cursor_.refuse("a block of " + std::to_string(n) + " elements", "1 to " + std::to_string(most));
        for (std::size_t i = 0; i < n; ++i)
          {
            cursor_.integer("the number of an element");
            read_tagged(kind, tags);
          }
        return n;
      }

      /// The first tag is the physical group.
      void read_tagged(const GmshKind &kind, const std::int64_t announced)
      {
        const std::size_t tags  = cursor_.count(announced, cursor_.binary ? 4 : 2, "tags");
        int               group = 0;
        for (std::size_t t = 0; t < tags; ++t)
          {
            const auto tag = cursor_.integer("a tag of an element");
            if (t == 0)
              group = static_cast<int>(tag);
          }
        read_corners(kind, group);
      }

      void read_corners(const GmshKind &kind, const int group)
      {
        nodes_of_element_.resize(kind.n_nodes);
        for (std::int64_t &node : nodes_of_element_)
          node = cursor_.integer("a node of an element");
        add_gmsh_element(kind, {group}, nodes_of_element_, mesh_, builder_);
      }

      Cursor                   &cursor_;
      PlainMesh                 mesh_;
      MeshBuilder               builder_;
      GmshEntities              entities_;
      std::vector<std::int64_t> nodes_of_element_;
      double                    version_ = 0;
      bool                      binary_ = false, nodes_ = false, elements_ = false;
    };
  } // namespace

  GmshKind gmsh_kind(const std::int64_t type, const Cursor &cursor)
  {
    static const std::map<std::int64_t, GmshKind> kinds{
        {1, {1, 2, {}, true}},
        {2, {2, 3, Shape::triangle, true}},
        {3, {2, 4, Shape::quadrilateral, true}},
        {4, {3, 4, Shape::tetrahedron, true}},
        {5, {3, 8, Shape::hexahedron, true}},
        {6, {3, 6, Shape::wedge, true}},
        {7, {3, 5, Shape::pyramid, true}},
        {8, {1, 3, {}, false}},
        {9, {2, 6, Shape::triangle, false}},
        {10, {2, 9, Shape::quadrilateral, false}},
        {11, {3, 10, Shape::tetrahedron, false}},
        {12, {3, 27, Shape::hexahedron, false}},
        {13, {3, 18, Shape::wedge, false}},
        {14, {3, 14, Shape::pyramid, false}},
        {15, {0, 1, {}, true}},
        {16, {2, 8, Shape::quadrilateral, false}},
        {17, {3, 20, Shape::hexahedron, false}},
        {18, {3, 15, Shape::wedge, false}},
        {19, {3, 13, Shape::pyramid, false}},
        {20, {2, 9, Shape::triangle, false}},
        {21, {2, 10, Shape::triangle, false}},
        {22, {2, 12, Shape::triangle, false}},
        {23, {2, 15, Shape::triangle, false}},
        {26, {1, 4, {}, false}},
        {27, {1, 5, {}, false}},
        {29, {3, 20, Shape::tetrahedron, false}},
        {30, {3, 35, Shape::tetrahedron, false}},
        {36, {2, 16, Shape::quadrilateral, false}},
        {37, {2, 25, Shape::quadrilateral, false}},
        {92, {3, 64, Shape::hexahedron, false}},
        {93, {3, 125, Shape::hexahedron, false}},
    };
    const auto found = kinds.find(type);
    if (found == kinds.end())
      cursor.refuse("elements of type " + std::to_string(type) + " are not known",
                    "hexahedra, tetrahedra, wedges, pyramids and their faces, of order 1 to 4");
    return found->second;
  }

  void add_gmsh_element(const GmshKind &kind, const std::vector<int> &groups, const std::vector<std::int64_t> &nodes, PlainMesh &mesh,
                        MeshBuilder &builder)
  {
    if (!kind.shape)
      return;
    if (kind.dimension == 3 && !kind.straight)
      ++mesh.straightened;
    std::vector<int> unsigned_groups;
    for (const int group : groups)
      if (group != 0) // their sign is an orientation
        unsigned_groups.push_back(std::abs(std::max(group, -std::numeric_limits<int>::max())));
    if (kind.dimension == 3 || !unsigned_groups.empty()) // faces without a group say nothing
      builder.add(*kind.shape, unsigned_groups, nodes);
  }

  PlainMesh read_gmsh(Cursor &cursor)
  {
    PlainMesh mesh = GmshReader(cursor).read();
    if (mesh.format.empty())
      mesh.format = "Gmsh 1, ASCII";
    return mesh;
  }
} // namespace myolines
