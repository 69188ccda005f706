#pragma once

#include <myolines/materials/tissue.h>
#include <myolines/scene/scene.h>
#include <myolines/system/drive.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  struct BlockGeometry
  {
    std::array<double, 3>       size{{0.03, 0.01, 0.01}}; ///< length, width, height [m]
    std::array<unsigned int, 3> cells{{1, 1, 1}};         ///< coarse cells per direction
    unsigned int                refinement = 3;           ///< global refinements of the coarse cells
    double                      distortion = 0; ///< largest shift of a vertex per direction, in parts of a cell; see distort_block()
  };

  /// One named boundary condition. Faces are numbered as in the peer: 0..5 = x-, x+, y-, y+, z-, z+.
  struct BoundaryCondition
  {
    enum class Type
    {
      fixed,    ///< u_c = 0
      strain,   ///< u = reference length * strain(t) * direction
      formula,  ///< u_c = f_c(x, y, z, t), with dt and d2t given as formulas too
      traction, ///< dead load per reference area T(x, y, z, t) [Pa]
    };
    std::string                  name;
    Type                         type = Type::fixed;
    unsigned int                 face = 0;
    std::array<bool, 3>          components{{true, true, true}};       ///< which components are prescribed (not for tractions)
    std::array<double, 3>        direction{{1, 0, 0}};                 ///< unit vector, type strain
    double                       reference_length = 0;                 ///< [m], type strain
    std::shared_ptr<const Drive> strain;                               ///< type strain
    std::array<std::string, 3>   displacement, velocity, acceleration; ///< type formula [m], [m/s], [m/s^2]
    std::array<std::string, 3>   traction;                             ///< type traction [Pa]
    std::string                  scene_path;                           ///< for messages
  };

  struct Muscle3dParameters
  {
    bool                                      dynamic       = true;
    bool                                      exact_tangent = true;
    unsigned int                              degree        = 2; ///< of the displacement, 1..3
    unsigned int                              n_points      = 4; ///< Gauss points per direction, 2..6
    BlockGeometry                             geometry;
    TissueParameters                          tissue;
    std::array<double, 3>                     fibre_direction{{1, 0, 0}}; ///< a0, unit
    std::vector<BoundaryCondition>            boundary;
    std::shared_ptr<const Drive>              activation; ///< nullptr: no activation in the scene, no active stress
    std::optional<std::array<std::string, 3>> body_force; ///< per reference volume [N/m^3], formulas of x, y, z, t
  };

  /// "x-", "x+", "y-", "y+", "z-", "z+": the faces of a block by number.
  const std::vector<std::string> &face_names();

  /// Declaration of the list `system` for type "muscle 3d".
  scene::Schema muscle3d_schema();

  /// @throws InputError for what ranges cannot express (unknown face or component, a direction of length zero, two
  /// conditions that prescribe the same component of the same face, malformed formulas).
  Muscle3dParameters read_muscle3d(const scene::Node &system);
} // namespace myolines
