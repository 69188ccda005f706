// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/geometry.h>
#include <myolines/muscle3d/tendon_spring.h>
#include <myolines/system/drive.h>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  struct LineGiven;

  /// One named boundary condition. Faces are numbered as in the peer.
  struct BoundaryCondition
  {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    enum class Type
    {
      fixed,             ///< u_c = 0
      strain,            ///< u = reference length * strain(t) * direction
      formula,           ///< u_c = f_c(x, y, z, t), with dt and d2t given as formulas too
      traction,          ///< dead load per reference area T(x, y, z, t) [Pa]
      pressure,          ///< dead load -p(t) along the reference normal
      directed_traction, ///< dead load per reference area T(t) along a direction
      follower_pressure, ///< pressure p(t) on the deformed face, force -p J F^-T N per reference area
      foundation,        ///< springs per reference area, force -k u - k_n (u.N) N
      symmetry,          ///< u.N = 0 on a plane face
      isotonic,          ///< u.n = q on the whole face, moved by a given force F(t) along n, and by a stop
      tendon,            ///< u.n = q, the force being that of a spring whose far end moves by d(t) along n
    };
    std::string                         name;
    Type                                type = Type::fixed;
    unsigned int                        face = 0;
    std::array<bool, 3>                 components{{true, true, true}};       ///< which components are prescribed (none by loads)
    std::array<double, 3>               direction{{1, 0, 0}};                 ///< unit vector, types strain and those with a direction
    double                              reference_length = 0;                 ///< [m], type strain
    std::shared_ptr<const Drive>        strain;                               ///< type strain
    std::array<std::string, 3>          displacement, velocity, acceleration; ///< type formula [m], [m/s], [m/s^2]
    std::array<std::string, 3>          traction;                             ///< type traction [Pa]
    double                              load = 0;                             ///< pressure or traction [Pa], type isotonic: force [N]
    std::shared_ptr<const Drive>        profile; ///< factor of the load, nullptr: 1; type tendon: motion of the far end [m], nullptr: none
    double                              stiffness = 0, normal_stiffness = 0; ///< k, k_n of a foundation [Pa/m]
    bool                                held_across = false;                 ///< types isotonic and tendon: the face does not move across n
    std::shared_ptr<const TendonSpring> spring;            ///< type tendon; type isotonic: that of its stop, nullptr: none
    double                              stop_position = 0; ///< u.n where the face touches its stop [m]
    std::array<double, 3>               low{{-infinity, -infinity, -infinity}},
        high{{infinity, infinity, infinity}}; ///< box that a load is confined to [m]
    std::string scene_path;                   ///< for messages

    /// The motion of its components is a given function of time.
    bool prescribes_motion() const { return type == Type::fixed || type == Type::strain || type == Type::formula; }
    /// One unknown moves the whole face.
    bool moves_as_one() const { return type == Type::isotonic || type == Type::tendon; }
    bool constrains() const { return prescribes_motion() || type == Type::symmetry || moves_as_one(); }
    /// It pulls with a force of its own, and not with a given one.
    bool reacts() const { return constrains() || type == Type::foundation; }
    /// Whether component @p c may move where the motion is prescribed.
    bool may_move(unsigned int c) const;
    /// Whether @p x is in the box that a load is confined to.
    bool loads(const dealii::Point<3> &x) const;
    /// @throws InputError if the load acts on no area.
    void refuse_empty(double area) const;
    bool has_stop() const { return type == Type::isotonic && spring; }
    bool is_spring() const { return type == Type::foundation || spring; }
    /// Factor of the load at an instant.
    double factor(const double t, const Side side) const { return profile ? profile->value(t, side) : 1.; }
    /// The drive behind it, or nullptr.
    const Drive *drive() const { return strain ? strain.get() : profile.get(); }
  };

  /// Declaration of the list `boundary`, and its reading. @throws InputError for what ranges cannot express (unknown face or
  /// component, a direction of length zero, two conditions that prescribe the same component of the same face, malformed formulas).
  /// @p given: what the scene says of the line of action, from which directions that it leaves open follow for a mesh.
  scene::Schema                  boundary_schema();
  std::vector<BoundaryCondition> read_boundary(const scene::Node &node, const Geometry &geometry, const LineGiven &given, bool dynamic);
} // namespace myolines
