// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "example.h"

namespace myolines::test
{
  // The two cubes as files of Gmsh.

  const std::string group_names = "$PhysicalNames\n4\n2 11 \"x-\"\n2 12 \"far end\"\n3 1 \"muscle\"\n3 2 \"tendon\"\n$EndPhysicalNames\n";

  inline std::string coordinates(const int i)
  {
    const auto         x = TwoCubes::point(i);
    std::ostringstream text;
    text << x[0] << " " << x[1] << " " << x[2] << "\n";
    return text.str();
  }

  inline std::string nodes_of(const int *nodes, const int n)
  {
    std::string text;
    for (int v = 0; v < n; ++v)
      text += " " + std::to_string(TwoCubes::number(nodes[v]));
    return text + "\n";
  }

  inline std::string numbered_nodes()
  {
    std::string text = "12\n";
    for (int i = 0; i < 12; ++i)
      text += std::to_string(TwoCubes::number(i)) + " " + coordinates(i);
    return text;
  }

  /// Version 1, the elementary number being 0 throughout.
  inline std::string gmsh_1()
  {
    std::string text = "$NOD\n" + numbered_nodes() + "$ENDNOD\n$ELM\n4\n";
    for (int c = 0; c < 2; ++c)
      text += std::to_string(c + 1) + " 5 " + std::to_string(c + 1) + " 0 8" + nodes_of(TwoCubes::cell[c], 8);
    for (int f = 0; f < 2; ++f)
      text += std::to_string(f + 3) + " 3 " + std::to_string(TwoCubes::group_of_face[f]) + " 0 4" + nodes_of(TwoCubes::face[f], 4);
    return text + "$ENDELM\n";
  }

  /// Cells with the number of a partition, as partitioned meshes have it.
  inline std::string gmsh_2()
  {
    std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + group_names + "$Nodes\n" + numbered_nodes() + "$EndNodes\n$Elements\n5\n9 15 2 3 3 5\n";
    for (int f = 0; f < 2; ++f)
      text += std::to_string(f + 1) + " 3 2 " + std::to_string(TwoCubes::group_of_face[f]) + " 7" + nodes_of(TwoCubes::face[f], 4);
    for (int c = 0; c < 2; ++c)
      text += std::to_string(c + 3) + " 5 4 " + std::to_string(c + 1) + " 0 1 " + std::to_string(c + 1) + nodes_of(TwoCubes::cell[c], 8);
    return text + "$EndElements\n";
  }

  inline std::string gmsh_2_binary(const bool swapped)
  {
    Bytes b(swapped);
    b.t("$MeshFormat\n2.2 1 8\n").i(1).t("\n$EndMeshFormat\n" + group_names + "$Nodes\n12\n");
    for (int i = 0; i < 12; ++i)
      {
        b.i(TwoCubes::number(i));
        for (const double x : TwoCubes::point(i))
          b.d(x);
      }
    b.t("\n$EndNodes\n$Elements\n4\n").i(3).i(2).i(2);
    for (int f = 0; f < 2; ++f)
      {
        b.i(f + 1).i(TwoCubes::group_of_face[f]).i(1);
        for (const int v : TwoCubes::face[f])
          b.i(TwoCubes::number(v));
      }
    for (int c = 0; c < 2; ++c)
      {
        b.i(5).i(1).i(2).i(c + 3).i(c + 1).i(0);
        for (const int v : TwoCubes::cell[c])
          b.i(TwoCubes::number(v));
      }
    return b.t("\n$EndElements\n").text;
  }

  /// Text with a blank behind each number, or bytes of them.
  class Numbers
  {
  public:
    Numbers(const bool binary, const bool swapped)
      : binary_(binary)
      , bytes_(swapped)
    {}
    template <typename T>
    Numbers &add(const T value)
    {
      std::ostringstream text;
      text << value << " ";
      binary_ ? bytes_.add<T>(value) : bytes_.t(text.str());
      return *this;
    }
    Numbers &i(const int value) { return add<std::int32_t>(value); }
    Numbers &l(const std::int64_t value) { return add<std::int64_t>(value); }
    Numbers &d(const double value) { return add<double>(value); }
    Numbers &t(const std::string &words)
    {
      bytes_.t(words);
      return *this;
    }
    const std::string &text() const { return bytes_.text; }

  private:
    bool  binary_;
    Bytes bytes_;
  };

  /// Version 4.0 or 4.1 with entities: volumes 21, 22, surfaces 31, 32, whose groups they have; @p partitioned: by their parents.
  inline std::string gmsh_4(const bool newer, const bool binary, const bool swapped = false, const bool partitioned = false)
  {
    Numbers    n(binary, swapped);
    const auto tag = [&](const int value) { newer ? n.l(value) : n.i(value); };
    n.t(std::string("$MeshFormat\n") + (newer ? "4.1 " : "4 ") + (binary ? "1" : "0") + " 8\n");
    if (binary)
      n.i(1);
    n.t("\n$EndMeshFormat\n" + group_names + "$Entities\n");
    n.l(1).l(0).l(2).l(2).i(1); // a point, two surfaces, two volumes
    for (int c = 0; c < (newer ? 3 : 6); ++c)
      n.d(0);
    n.l(0);
    for (int surface = 0; surface < 2; ++surface)
      n.i(31 + surface).d(0).d(0).d(0).d(1).d(1).d(1).l(1).i(-TwoCubes::group_of_face[surface]).l(1).i(-4);
    for (int volume = 0; volume < 2; ++volume)
      n.i(21 + volume).d(0).d(0).d(0).d(1).d(1).d(1).l(1).i(volume + 1).l(2).i(31).i(-32);
    n.t("\n$EndEntities\n");
    if (partitioned) // volume 41 is a part of 21; the others are as they were
      {
        n.t("$PartitionedEntities\n").l(2).l(1).i(77).i(1);
        n.l(0).l(0).l(0).l(1).i(41).i(3).i(21);
        newer ? n.l(1) : n.i(1);
        n.i(1).d(0).d(0).d(0).d(1).d(1).d(1).l(0).l(0).t("\n$EndPartitionedEntities\n");
      }
    n.t("$Nodes\n").l(2).l(12);
    if (newer)
      n.l(5).l(60);
    for (int block = 0; block < 2; ++block)
      {
        newer ? n.i(3).i(21 + block) : n.i(21 + block).i(3);
        n.i(block).l(6); // the second has parameters
        for (int i = 6 * block; newer && i < 6 * block + 6; ++i)
          n.l(TwoCubes::number(i));
        for (int i = 6 * block; i < 6 * block + 6; ++i)
          {
            if (!newer)
              n.i(TwoCubes::number(i));
            for (const double x : TwoCubes::point(i))
              n.d(x);
            for (int p = 0; p < 3 * block; ++p)
              n.d(0.5);
          }
      }
    n.t("\n$EndNodes\n$Elements\n").l(4).l(4);
    if (newer)
      n.l(1).l(4);
    for (int f = 0; f < 2; ++f)
      {
        newer ? n.i(2).i(31 + f) : n.i(31 + f).i(2);
        n.i(3).l(1);
        tag(f + 1);
        for (const int v : TwoCubes::face[f])
          tag(TwoCubes::number(v));
      }
    for (int c = 0; c < 2; ++c)
      {
        const int entity = partitioned && c == 0 ? 41 : 21 + c;
        newer ? n.i(3).i(entity) : n.i(entity).i(3);
        n.i(5).l(1);
        tag(c + 3);
        for (const int v : TwoCubes::cell[c])
          tag(TwoCubes::number(v));
      }
    return n.t("\n$EndElements\n").text();
  }
} // namespace myolines::test
