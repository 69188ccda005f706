// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_refusal.h"

#include <myolines/base/counted.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace myolines
{
  namespace
  {
    constexpr unsigned int none = 0xFFFFFFFF;

    bool is_in(const PlainMesh::Element &quad, const PlacedFace &face, const MeshBody &body)
    {
      const std::vector<dealii::Point<3>> &x = body.vertices;
      dealii::Point<3>                     centre;
      for (unsigned int i = 0; i < 4; ++i)
        centre += x[quad.corner[i]] / 4;
      for (unsigned int c = 0; c < 3; ++c)
        if (centre[c] < face.low[c] || centre[c] > face.high[c])
          return false;
      if (!face.normal)
        return true;
      const auto                 corner = [&](const unsigned int i) { return x[quad.corner[i]]; };
      const dealii::Tensor<1, 3> area   = dealii::cross_product_3d(corner(2) - corner(0), corner(3) - corner(1)); // outwards
      const double               cosine = area * *face.normal / area.norm();
      if (!(cosine >= std::cos(face.angle * dealii::numbers::PI / 180) - 1e-12))
        return false;
      const double tolerance = face.tolerance.value_or(1e-3 * body.low.distance(body.high));
      return !face.through || std::all_of(quad.corner.begin(), quad.corner.begin() + 4, [&](const unsigned int v) {
        return std::abs((x[v] - *face.through) * *face.normal) <= tolerance;
      });
    }

    /// The faces of the boundary while they get their names.
    class Boundary
    {
    public:
      Boundary(const PlainMesh &mesh, MeshBody &body, const MeshRefusal &refuse)
        : mesh_(mesh)
        , body_(body)
        , refuse_(refuse)
        , outside_(outer_faces(mesh))
        , owner_(outside_.size(), none)
      {
        for (std::size_t i = 0; i < outside_.size(); ++i)
          place_[face_key(outside_[i])] = i;
      }

      /// Groups of the mesh, by number; those of one name are one. A group within the body is no face.
      void add_groups()
      {
        std::map<int, std::vector<std::size_t>> quads;
        std::map<int, std::size_t>              inside;
        std::map<std::string, int>              first; // number of a name
        for (const auto &[group, name] : mesh_.face_groups)
          first.emplace(name, group);
        const auto number = [&](const int group) {
          const auto named = mesh_.face_groups.find(group);
          return named == mesh_.face_groups.end() || named->second.empty() ? group : first.at(named->second);
        };
        for (const PlainMesh::Element &face : mesh_.faces)
          if (const auto found = place_.find(face_key(face)); found != place_.end())
            quads[number(face.group)].push_back(found->second);
          else
            ++inside[number(face.group)];
        for (const auto &[group, n] : inside)
          if (quads.count(group) == 0)
            body_.report.push_back("the surface \"" + name_of(group) + "\" is within the body: it is no face");
        for (const auto &[group, members] : quads)
          add(name_of(group), members);
      }

      void add_placed(const PlacedFace &face)
      {
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < outside_.size(); ++i)
          if (owner_[i] == none && is_in(outside_[i], face, body_))
            members.push_back(i);
        if (std::find(body_.face_names.begin(), body_.face_names.end(), face.name) != body_.face_names.end())
          refuse_at(face, "the mesh has a face of this name", "a name of its own");
        if (members.empty())
          refuse_at(face, "no part of the boundary is there that belongs to no other face",
                    "a place on the boundary between " + place_text(body_.low) + " and " + place_text(body_.high));
        add(face.name, members);
      }

      void add_rest()
      {
        body_.n_named = body_.face_names.size();
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < outside_.size(); ++i)
          if (owner_[i] == none)
            members.push_back(i);
        if (body_.n_named == 0)
          body_.report.push_back("no surface of the mesh has a name or a number: name some there, or by place in system/geometry/faces");
        if (std::find(body_.face_names.begin(), body_.face_names.end(), MeshBody::rest) != body_.face_names.end())
          refuse_("the mesh has a surface of the name \"" + std::string(MeshBody::rest) + "\", which stands for what has none",
                  "another name");
        if (!members.empty())
          add(MeshBody::rest, members);
      }

      /// As deal.II wants them.
      void fill() const
      {
        for (std::size_t i = 0; i < outside_.size(); ++i)
          {
            dealii::CellData<2> quad;
            for (unsigned int v = 0; v < 4; ++v)
              quad.vertices[v] = outside_[i].corner[v < 2 ? v : 5 - v]; // row by row
            quad.boundary_id = owner_[i];
            body_.faces.boundary_quads.push_back(quad);
          }
      }

    private:
      [[noreturn]] static void refuse_at(const PlacedFace &face, const std::string &what, const std::string &expected)
      {
        throw InputError(InputProblem{face.scene_path, what, expected, ""});
      }

      std::string name_of(const int group) const
      {
        const auto found = mesh_.face_groups.find(group);
        return found == mesh_.face_groups.end() || found->second.empty() ? std::to_string(group) : found->second;
      }

      void add(const std::string &name, const std::vector<std::size_t> &members)
      {
        const unsigned int number = static_cast<unsigned int>(body_.face_names.size());
        if (const unsigned int same = face_of_all(members); same != none)
          {
            body_.further_names[name] = same;
            body_.report.push_back("the face \"" + body_.face_names[same] + "\" is \"" + name + "\" as well");
            return;
          }
        for (const std::size_t i : members)
          {
            if (owner_[i] != none && owner_[i] != number)
              refuse_("a part of the boundary at " + place_text(body_.vertices[outside_[i].corner[0]]) + " is in two surfaces: \"" +
                          body_.face_names[owner_[i]] + "\" and also \"" + name + "\"",
                      "one surface for each part of the boundary");
            owner_[i] = number;
          }
        body_.face_names.push_back(name);
        body_.report.push_back(counted(members.size(), "quadrilateral") + " on the face \"" + name + "\"" +
                               (name == MeshBody::rest ? ", which no surface of the mesh names" : ""));
      }

      /// The face that has all these members and no others.
      unsigned int face_of_all(const std::vector<std::size_t> &members) const
      {
        const unsigned int first = owner_[members.front()];
        for (const std::size_t i : members)
          if (owner_[i] != first)
            return none;
        const std::set<std::size_t> different(members.begin(), members.end());
        return std::count(owner_.begin(), owner_.end(), first) == static_cast<std::ptrdiff_t>(different.size()) ? first : none;
      }

      const PlainMesh                &mesh_;
      MeshBody                       &body_;
      const MeshRefusal              &refuse_;
      std::vector<PlainMesh::Element> outside_; ///< seen from outside
      std::map<FaceKey, std::size_t>  place_;   ///< in outside_
      std::vector<unsigned int>       owner_;   ///< place in the names of faces
    };
  } // namespace

  void add_faces(const PlainMesh &mesh, const std::vector<PlacedFace> &placed, MeshBody &body, const MeshRefusal &refuse)
  {
    Boundary boundary(mesh, body, refuse);
    boundary.add_groups();
    for (const PlacedFace &face : placed)
      boundary.add_placed(face);
    boundary.add_rest();
    boundary.fill();
  }
} // namespace myolines
