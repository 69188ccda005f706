// SPDX-License-Identifier: LGPL-2.1-or-later
#include "gmsh_kinds.h"

namespace myolines
{
  namespace
  {
    constexpr double version_41 = 4.05; ///< between 4.0 and 4.1

    /// Passes numbers over, whatever they are: boxes of empty entities are infinite.
    void skip_numbers(Cursor &cursor, const std::size_t n)
    {
      for (std::size_t i = 0; i < n; ++i)
        if (cursor.binary)
          cursor.raw<double>("the box of an entity");
        else if (cursor.word().empty())
          cursor.refuse("the file ends within the box of an entity", "the whole file");
    }

    /// A number of integers, and those.
    std::vector<int> integers(Cursor &cursor, const std::string &things, const bool short_count = false)
    {
      const auto announced = short_count ? cursor.integer("the number of " + things) : cursor.large_integer("the number of " + things);
      std::vector<int> all(cursor.count(announced, cursor.binary ? 4 : 2, things));
      for (int &one : all)
        one = static_cast<int>(cursor.integer("one of the " + things));
      return all;
    }

    std::vector<int> groups_of(const GmshEntities &entities, const int dimension, const std::int64_t tag)
    {
      const auto found = entities.find({dimension, static_cast<int>(tag)});
      return found == entities.end() ? std::vector<int>() : found->second;
    }

    struct Block
    {
      int          dimension;
      std::int64_t entity, kind; ///< kind: parametric, or type of elements
      std::size_t  n;
    };

    /// The head of a block of nodes or elements: 4.0 has the entity before its dimension.
    Block read_block(Cursor &cursor, const double version, const std::size_t bytes, const std::string &things)
    {
      Block      block;
      const auto first = cursor.integer("the dimension of an entity"), second = cursor.integer("the number of an entity");
      block.dimension = static_cast<int>(version > version_41 ? first : second);
      block.entity    = version > version_41 ? second : first;
      block.kind      = cursor.integer("the kind of " + things);
      block.n         = cursor.count(cursor.large_integer("the number of " + things), bytes, things);
      return block;
    }

    /// How many blocks there are; what else the first line tells is passed over.
    std::size_t read_head(Cursor &cursor, const double version, const std::string &things)
    {
      const std::size_t blocks = cursor.count(cursor.large_integer("the number of blocks"), cursor.binary ? 20 : 8, "blocks of " + things);
      cursor.count(cursor.large_integer("the number of " + things), cursor.binary ? 8 : 2, things);
      if (version > version_41)
        {
          cursor.large_integer("the lowest number of " + things);
          cursor.large_integer("the highest number of " + things);
        }
      return blocks;
    }
  } // namespace

  void read_gmsh4_entities(Cursor &cursor, const double version, const bool partitioned, GmshEntities &entities)
  {
    if (partitioned)
      {
        cursor.large_integer("the number of partitions");
        const std::size_t ghosts =
            cursor.count(cursor.large_integer("the number of ghost entities"), cursor.binary ? 8 : 4, "ghost entities");
        for (std::size_t i = 0; i < 2 * ghosts; ++i)
          cursor.integer("a ghost entity");
      }
    std::size_t n[4];
    for (std::size_t &count : n)
      count = cursor.count(cursor.large_integer("the number of entities"), cursor.binary ? 36 : 8, "entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < n[dimension]; ++i)
        {
          const int           tag = static_cast<int>(cursor.integer("the number of an entity"));
          std::pair<int, int> parent{-1, -1};
          if (partitioned)
            {
              parent.first  = static_cast<int>(cursor.integer("the dimension of a parent"));
              parent.second = static_cast<int>(cursor.integer("the number of a parent"));
              integers(cursor, "partitions of an entity", version < version_41);
            }
          skip_numbers(cursor, dimension == 0 && version > version_41 ? 3 : 6);
          std::vector<int> groups = integers(cursor, "groups of an entity");
          if (dimension > 0)
            integers(cursor, "boundaries of an entity");
          if (groups.empty() && parent.first == dimension && entities.count(parent) > 0)
            groups = entities.at(parent);
          entities[{dimension, tag}] = groups;
        }
  }

  void read_gmsh4_nodes(Cursor &cursor, const double version, MeshBuilder &builder)
  {
    const std::size_t blocks = read_head(cursor, version, "nodes");
    for (std::size_t b = 0; b < blocks; ++b)
      {
        const Block               block = read_block(cursor, version, cursor.binary ? 28 : 8, "nodes");
        const std::size_t         more  = block.kind != 0 ? block.dimension : 0; // coordinates on the entity
        std::vector<std::int64_t> tags(version > version_41 ? block.n : 0);
        for (std::int64_t &tag : tags)
          tag = cursor.large_integer("the number of a node");
        for (std::size_t i = 0; i < block.n; ++i)
          {
            const auto          tag = tags.empty() ? cursor.integer("the number of a node") : tags[i];
            PlainMesh::Position x;
            for (double &c : x)
              c = cursor.number("a coordinate");
            skip_numbers(cursor, more);
            builder.add_point(tag, x);
          }
      }
  }

  void read_gmsh4_elements(Cursor &cursor, const double version, const GmshEntities &entities, PlainMesh &mesh, MeshBuilder &builder)
  {
    const std::size_t         blocks = read_head(cursor, version, "elements");
    std::vector<std::int64_t> nodes;
    for (std::size_t b = 0; b < blocks; ++b)
      {
        const Block    block  = read_block(cursor, version, cursor.binary ? 8 : 4, "elements");
        const GmshKind kind   = gmsh_kind(block.kind, cursor);
        const auto     groups = groups_of(entities, block.dimension, block.entity);
        nodes.resize(kind.n_nodes);
        const auto next = [&](const std::string &what) { return version > version_41 ? cursor.large_integer(what) : cursor.integer(what); };
        for (std::size_t i = 0; i < block.n; ++i)
          {
            next("the number of an element");
            for (std::int64_t &node : nodes)
              node = next("a node of an element");
            add_gmsh_element(kind, groups, nodes, mesh, builder);
          }
      }
  }
} // namespace myolines
