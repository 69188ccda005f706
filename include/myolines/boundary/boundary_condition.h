// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  class NodeSpace;

  using Vector3 = dealii::Tensor<1, 3>; ///< a vector in space
  using Matrix3 = dealii::Tensor<2, 3>; ///< a tensor of second order in space

  /// What a condition does to the end of a muscle: lines of action go from end to end.
  enum class MuscleEnd
  {
    none,  ///< it acts at the side of a muscle, as a pressure does
    held,  ///< nothing moves there
    moved, ///< it moves the face, or pulls at it
  };

  /// Part of a face that a condition acts on: a box of the body at rest [m].
  struct Box
  {
    static constexpr double infinity = std::numeric_limits<double>::infinity(); ///< no bound
    std::array<double, 3>   low{{-infinity, -infinity, -infinity}};             ///< corner with the least coordinates
    std::array<double, 3>   high{{infinity, infinity, infinity}};               ///< corner with the greatest

    bool contains(const dealii::Point<3> &x) const; ///< whether @p x is in it, its faces included
  };

  /// What is known of a condition before any mesh: from it the system sees which of the functions below matter.
  struct BoundaryFacts
  {
    std::string  name;                   ///< that the scene gives it
    std::string  where;                  ///< in the scene, for messages
    unsigned int face = 0;               ///< by number, see face_names()
    MuscleEnd    end  = MuscleEnd::none; ///< what it does to the end of a muscle
    Box          part;                   ///< of the face, by places at rest

    std::array<bool, 3> prescribed{};         ///< components whose motion is a given function of time
    std::array<bool, 3> moving{};             ///< those of them that are not zero at all times
    bool                ties         = false; ///< it relates the unknowns of the face
    bool                moves_as_one = false; ///< ... of which one moves the whole face
    bool                loads        = false; ///< there is a dead load
    bool                pushes       = false; ///< there is a force that depends on the motion of the face
    bool                supports     = false; ///< ... which is a reaction, of springs or dashpots, and not a given load
    bool                rates        = false; ///< ... and depends on the velocity
    bool                follows      = false; ///< ... and depends on the deformed area: its tangent is not symmetric
    bool                strains      = false; ///< it stretches the body by a strain: forces are measured at its face by default

    std::string              says_tie;    ///< for `check`, where it ties: "moves as one"; empty: nothing to say
    std::string              says_spring; ///< likewise where it pushes
    std::string              says_motion; ///< likewise where it prescribes
    std::vector<std::string> columns;     ///< of reaction.csv beyond the force: "stop [N]"

    bool prescribes() const { return prescribed[0] || prescribed[1] || prescribed[2]; } ///< whether it prescribes the motion of a component
    bool constrains() const { return prescribes() || ties; }                            ///< whether unknowns of the face are not free
    /// It pulls with a force of its own, and not with a given one.
    bool reacts() const { return constrains() || supports; }
  };

  /// A quadrature point of a face at rest.
  struct FacePoint
  {
    dealii::Point<3> place;         ///< [m]
    Vector3          normal;        ///< outward unit vector
    double           area      = 0; ///< that the point stands for [m^2]
    double           face_area = 0; ///< of all points of the face that the condition acts on [m^2]
  };

  /// How the body moves at such a point.
  struct FaceMotion
  {
    Vector3 u;    ///< displacement [m]
    Vector3 v;    ///< velocity [m/s], for powers and forces that depend on it; else zero
    Vector3 area; ///< outward normal of the deformed face times the deformed area that the point stands for [m^2], for forces that follow
                  ///< it; else zero
  };

  /// How the body moves at such a point in a step: velocities are those of the step.
  struct FaceStep
  {
    FaceMotion begin;  ///< at its beginning
    FaceMotion end;    ///< at its end
    FaceMotion middle; ///< mean displacement; the area is the mean over the straight way, whose work is that of a pressure along it
  };

  /// Derivatives of a force f at a point: df = -(by_u du + by_v dv + by_area d(area)).
  struct ForceTangent
  {
    Matrix3 by_u;    ///< [N/m]
    Matrix3 by_v;    ///< [N s/m]
    Matrix3 by_area; ///< [Pa]
  };

  /// a.u = q at all nodes of a face: q is zero, or the one free unknown that moves the face.
  struct Tie
  {
    Vector3 direction;     ///< unit vector a
    bool    moves = false; ///< whether q is free
  };

  /// Force, moment and motion at the face of a condition as measured, see measure_reactions().
  struct FaceReaction
  {
    Vector3 constraint; ///< force with which prescribed and tied unknowns pull on the body [N]
    Vector3 moment;     ///< of those about the origin, with the places of now [N m]
    Vector3 support;    ///< force that depends on the motion [N]
    Vector3 load;       ///< dead load [N]
  };

  /// A boundary condition, a support or a load: everything that the system, its measures and `check` know of one. Each kind is a class in a
  /// file of its own (`boundary/`), which overrides what its facts say that it has. Equal arguments give equal results: a condition keeps
  /// no state. Forces are those on the body.
  class BoundaryCondition
  {
  public:
    /// Of these @p facts, which the constructors of kinds complete.
    explicit BoundaryCondition(BoundaryFacts facts)
      : facts_(std::move(facts))
    {}
    virtual ~BoundaryCondition() = default;

    const BoundaryFacts &facts() const { return facts_; } ///< what is known of it

    /// Given functions of time that it depends on, for their kinks and files.
    virtual std::vector<const Drive *> drives() const { return {}; }

    // Prescribed motion and relations.

    /// u [m], v [m/s], a [m/s^2] of a point of the face by its place at rest.
    using Motion = std::function<std::array<Vector3, 3>(const dealii::Point<3> &)>;
    /// That of one instant; only the prescribed components count.
    virtual Motion motion(double t, Side side) const;
    /// Collective. @throws InputError where the face has not the shape that it must have.
    virtual std::vector<Tie> ties(const NodeSpace & /*space*/) const { return {}; }

    // Forces. What a point stands for is in them [N].

    virtual Vector3 load(double /*t*/, Side, const FacePoint &) const { return {}; } ///< dead load [N]
    /// force that depends on the motion [N]
    virtual Vector3      force(double /*t*/, Side, const FacePoint &, const FaceMotion &) const { return {}; }
    virtual ForceTangent tangent(double /*t*/, Side, const FacePoint &, const FaceMotion &) const { return {}; } ///< derivatives of force()

    /// Force of a step [N] whose work is the change of energy(), at loads of the instant @p t.
    virtual Vector3 force_of_step(double t, Side side, const FacePoint &point, const FaceStep &x) const
    {
      return force(t, side, point, x.middle);
    }
    /// Its derivatives by the displacement at the end, the velocity and the mean area.
    virtual ForceTangent tangent_of_step(double t, Side side, const FacePoint &point, const FaceStep &x) const
    {
      ForceTangent k = tangent(t, side, point, x.middle);
      k.by_u *= 0.5;
      return k;
    }

    /// Energy stored by force() [J].
    virtual double energy(double /*t*/, Side, const FacePoint &, const FaceMotion &) const { return 0; }
    /// Power that force() brings into body and springs from outside [W]; with the other two, d(energy)/dt = power - dissipation - force.v.
    virtual double power(double /*t*/, Side, const FacePoint &, const FaceMotion &) const { return 0; }
    virtual double dissipation(double /*t*/, Side, const FacePoint &, const FaceMotion &) const { return 0; } ///< >= 0 [W]

    /// Pressure of force() on the deformed area, if it is one number at all times and places [Pa]: the force has then the energy pressure
    /// times volume wherever nothing moves the edge of the face, or it has none.
    virtual std::optional<double> constant_pressure() const { return std::nullopt; }

    /// Directions in which springs hold a point with this normal: rigid motions across them are free.
    virtual std::vector<Vector3> held_directions(const Vector3 & /*normal*/) const { return {}; }

    /// Elongation of the tendon of a face with the mean motion @p u [m], and of how long a one [m], 0: it has no length. Nothing: there is
    /// none.
    virtual std::optional<std::array<double, 2>> tendon(double /*t*/, Side, const Vector3 & /*u*/) const { return std::nullopt; }

    /// Values of facts().columns.
    virtual std::vector<double> own_columns(double /*t*/, Side, const FaceReaction &) const { return {}; }

  protected:
    BoundaryFacts facts_; ///< for constructors; constant afterwards
  };
} // namespace myolines
