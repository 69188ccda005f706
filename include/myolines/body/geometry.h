// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/mesh_body.h>
#include <myolines/fem/node_space.h>
#include <myolines/scene/scene.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// The idealised gastrocnemius: muscle between two layers of aponeurosis, three parallelepipeds in the x-z plane glued along
  /// their faces, width along y. The muscle spans the fibre L_f (cos b, 0, sin b) and the aponeurosis L_apo (cos th, 0, -sin th)
  /// from the origin; their sum is (L_mus, 0, 0). Thesis 6.5.1; doi:10.3389/fphys.2021.628819.
  struct Gastrocnemius
  {
    double muscle_length      = 0.27;  ///< L_mus, between the ends of the diagonal [m]
    double aponeurosis_length = 0.208; ///< L_apo [m]
    double aponeurosis_height = 0.003; ///< along z [m]
    double width              = 0.055; ///< [m]
    double pennation          = 15.3;  ///< b [degree]

    double aponeurosis_angle() const; ///< th [radian]
    double fibre_length() const;      ///< L_f [m]
    /// a0 of fibres of the muscle and of the aponeurosis.
    std::array<double, 3> fibre_direction() const;
    std::array<double, 3> aponeurosis_direction() const; ///< the latter
  };

  /// The reference body and its mesh. A block is a box with one corner at the origin.
  struct Geometry
  {
    std::array<double, 3>       size{{0.03, 0.01, 0.01}}; ///< length along the line of action x, width, height [m]
    std::array<unsigned int, 3> cells{{1, 1, 1}};         ///< coarse cells per direction
    unsigned int                refinement = 3;           ///< global refinements of the coarse cells
    double       distortion = 0;         ///< of a block: largest shift of a vertex per direction, in parts of a cell; see distort_block()
    std::string  tissue     = "muscle";  ///< of a block, and its material id
    unsigned int tissue_id  = muscle_id; ///< that id
    std::optional<Gastrocnemius>    gastrocnemius; ///< the body, if it is one
    std::shared_ptr<const MeshBody> mesh;          ///< with neither: a block
  };

  /// Names of the faces by number. Of a block: x-, x+, y-, y+, z-, z+. Of the gastrocnemius: x- and x+ are the ends of the lower and
  /// of the upper layer, z- and z+ their outsides, "muscle x-" and "muscle x+" the ends of everything else. Of a mesh: its own, those by
  /// place, and the rest.
  const std::vector<std::string> &face_names(const Geometry &geometry);

  /// Number of the face that @p parameter names. @throws InputError with the nearest one.
  unsigned int read_face(const scene::Node &node, const std::string &parameter, const Geometry &geometry);

  /// Points of the body of which it is, or is contained in, the convex hull [m].
  std::vector<dealii::Point<3>> corners(const Geometry &geometry);

  /// Centre of a face: the mean of its points [m].
  dealii::Point<3> face_centre(const Geometry &geometry, unsigned int face);

  /// Tissues that the cells of the body are made of, by name.
  std::vector<std::string> tissues_of(const Geometry &geometry);

  /// Makes the mesh, faces numbered as named, cells with the material id of their tissue.
  void make_mesh(const Geometry &geometry, NodeSpace::Mesh &mesh);

  /// Declaration of the list `geometry`, and its reading. @throws InputError for angles that close no triangle.
  scene::Schema geometry_schema();
  Geometry      read_geometry(const scene::Node &node, const TissueNames &tissues); ///< Reads that list.
} // namespace myolines
