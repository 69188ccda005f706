// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/complaint.h"

#include <myolines/meshes/plain_mesh.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace myolines::test
{
  inline PlainMesh   mesh_of(const std::string &text) { return parse_mesh(text, "mesh"); }
  inline std::string refusal_of(const std::string &text)
  {
    return complaint([&] { mesh_of(text); });
  }

  /// Two cubes side by side, 1 muscle and 2 tendon, with the ends 11 and 12 of the body; points are numbered from 5 on, by fives.
  struct TwoCubes
  {
    static constexpr int cell[2][8] = {{0, 1, 4, 3, 6, 7, 10, 9}, {1, 2, 5, 4, 7, 8, 11, 10}}, face[2][4] = {{0, 3, 9, 6}, {2, 5, 11, 8}};
    static constexpr int group_of_face[2] = {11, 12};

    static std::array<double, 3> point(const int i) { return {{1.25 * (i % 3), 1. * (i / 3 % 2), 0.5 * (i / 6)}}; }
    static int                   number(const int i) { return 5 * (i + 1); }
  };

  /// Whether that is what a file had.
  inline std::string difference_from_two_cubes(const PlainMesh &mesh)
  {
    std::ostringstream text;
    if (mesh.points.size() != 12 || mesh.cells.size() != 2 || mesh.faces.size() != 2)
      {
        text << mesh.points.size() << " points, " << mesh.cells.size() << " cells, " << mesh.faces.size() << " faces";
        return text.str();
      }
    for (int c = 0; c < 2; ++c)
      {
        for (int v = 0; v < 8; ++v)
          if (mesh.points[mesh.cells[c].corner[v]] != TwoCubes::point(TwoCubes::cell[c][v]))
            text << "corner " << v << " of cell " << c << "; ";
        for (int v = 0; v < 4; ++v)
          if (mesh.points[mesh.faces[c].corner[v]] != TwoCubes::point(TwoCubes::face[c][v]))
            text << "corner " << v << " of face " << c << "; ";
        if (mesh.cells[c].group != c + 1 || mesh.faces[c].group != TwoCubes::group_of_face[c])
          text << "groups " << mesh.cells[c].group << ", " << mesh.faces[c].group << "; ";
      }
    return text.str();
  }

  /// Numbers as bytes, in either order.
  class Bytes
  {
  public:
    explicit Bytes(const bool swapped = false)
      : swapped_(swapped)
    {}
    template <typename T>
    Bytes &add(const T value)
    {
      char bytes[sizeof(T)];
      std::memcpy(bytes, &value, sizeof(T));
      if (swapped_)
        std::reverse(bytes, bytes + sizeof(T));
      text.append(bytes, sizeof(T));
      return *this;
    }
    Bytes &i(const int value) { return add<std::int32_t>(value); }
    Bytes &l(const std::int64_t value) { return add<std::int64_t>(value); }
    Bytes &d(const double value) { return add<double>(value); }
    Bytes &t(const std::string &words)
    {
      text += words;
      return *this;
    }

    std::string text;

  private:
    bool swapped_;
  };
} // namespace myolines::test
