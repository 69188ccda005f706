#pragma once

#include <myolines/muscle3d/geometry.h>
#include <myolines/system/drive.h>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// One named boundary condition. Faces are numbered as in the peer.
  struct BoundaryCondition
  {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    enum class Type
    {
      fixed,    ///< u_c = 0
      strain,   ///< u = reference length * strain(t) * direction
      formula,  ///< u_c = f_c(x, y, z, t), with dt and d2t given as formulas too
      traction, ///< dead load per reference area T(x, y, z, t) [Pa]
      pressure, ///< dead load -p(t) along the reference normal
    };
    std::string                  name;
    Type                         type = Type::fixed;
    unsigned int                 face = 0;
    std::array<bool, 3>          components{{true, true, true}};       ///< which components are prescribed (none by loads)
    std::array<double, 3>        direction{{1, 0, 0}};                 ///< unit vector, type strain
    double                       reference_length = 0;                 ///< [m], type strain
    std::shared_ptr<const Drive> strain;                               ///< type strain
    std::array<std::string, 3>   displacement, velocity, acceleration; ///< type formula [m], [m/s], [m/s^2]
    std::array<std::string, 3>   traction;                             ///< type traction [Pa]
    double                       pressure = 0;                         ///< type pressure [Pa]
    std::shared_ptr<const Drive> profile;                              ///< factor of the pressure; nullptr: 1
    std::array<double, 3>        low{{-infinity, -infinity, -infinity}},
        high{{infinity, infinity, infinity}}; ///< box that a load is confined to [m]
    std::string scene_path;                   ///< for messages

    bool prescribes_motion() const { return type != Type::traction && type != Type::pressure; }
    /// The drive behind it, or nullptr.
    const Drive *drive() const { return strain ? strain.get() : profile.get(); }
  };

  /// Declaration of the list `boundary`, and its reading. @throws InputError for what ranges cannot express (unknown face or
  /// component, a direction of length zero, two conditions that prescribe the same component of the same face, malformed formulas).
  scene::Schema                  boundary_schema();
  std::vector<BoundaryCondition> read_boundary(const scene::Node &node, const Geometry &geometry, bool dynamic);
} // namespace myolines
