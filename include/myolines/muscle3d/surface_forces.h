// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/discretisation.h>
#include <myolines/system/point.h>

#include <deal.II/lac/full_matrix.h>

#include <map>
#include <string>
#include <vector>

namespace myolines
{
  /// Forces of boundary conditions, integrated over their faces with the quadrature of the cells: dead loads, and what depends on how the
  /// face moves.
  class SurfaceForces
  {
  public:
    /// Finds the points of the faces. @p discretisation outlives the object. Collective. @throws InputError for a condition that acts on no
    /// area.
    SurfaceForces(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation);

    // Whether there are any, on any rank.
    bool any() const { return has_[pushing]; }       ///< that depend on the motion
    bool any_loads() const { return has_[loading]; } ///< that do not: dead loads
    bool rates() const { return rates_; }            ///< whether forces depend on the velocity

    /// r -= forces that depend on the motion, or those of the step from Point::before. @p point: its vectors have current ghosts, v where
    /// rates(). Not compressed.
    /// The size of the forces [N], over all ranks.
    double subtract(const Point &point, Vector &r) const;

    /// f += dead loads. Not compressed.
    void add_loads(double t, Side side, Vector &f) const;

    /// -dF/du (of a step: by the end) and -dF/dv of one face of a cell: rows and columns are 3 i + c, i counts the nodes of the face.
    struct Tangent
    {
      NodeSpace::Cell                  cell;      ///< that has the face
      const std::vector<unsigned int> &nodes;     ///< local numbers of the nodes in vectors
      const std::vector<int>          &places;    ///< their lexicographic numbers in the cell
      dealii::FullMatrix<double>       stiffness; ///< -dF/du [N/m]
      dealii::FullMatrix<double>       damping;   ///< empty where the force does not depend on the velocity
    };
    /// Of all faces of owned and ghost cells, ghosts as above.
    std::vector<Tangent> tangents(const Point &point, bool symmetrised) const;

    /// What forces that depend on the motion do, of all ranks: d(energy)/dt = power - dissipation - their power on the body.
    struct Work
    {
      double energy      = 0; ///< that they store [J]
      double power       = 0; ///< from outside [W]
      double dissipation = 0; ///< >= 0 [W]
    };
    /// Collective. @p of: of one condition alone.
    Work work(const Point &point, const BoundaryCondition *of = nullptr) const;

    /// Whether the force of @p condition follows its face and has an energy: a constant pressure on a face that is closed or whose edge
    /// cannot move. Then Work has that, else its power.
    bool has_potential(const BoundaryCondition &condition) const
    {
      const auto found = no_potential_.find(&condition);
      return found != no_potential_.end() && found->second.empty();
    }

    /// Of a condition that follows its face: why it has no energy; empty if it has one.
    const std::string &why_no_potential(const BoundaryCondition &condition) const { return no_potential_.at(&condition); }

    /// Power of all forces of @p condition on the body, dead loads included, over all ranks [W].
    double power_on_body(const Point &point, const BoundaryCondition &condition) const;

    /// Sums over the face of @p condition, over all ranks [N].
    Vector3 force(const Point &point, const BoundaryCondition &condition) const;
    Vector3 load(double t, Side side, const BoundaryCondition &condition) const; ///< Dead load of @p condition on its face [N]. Collective.

  private:
    struct Face
    {
      NodeSpace::Cell           cell;
      const BoundaryCondition  *condition;
      double                    sign; ///< outwards: of the product of the two tangents
      std::vector<unsigned int> nodes;
      std::vector<int>          places;
      std::vector<FacePoint>    points; ///< of area 0 where the condition does not act
    };

    void add_face(const NodeSpace::Cell &cell, unsigned int face, const BoundaryCondition &condition);
    void find_areas(const BoundaryConditions &conditions);
    void find_potentials(const Muscle3dParameters &parameters);
    struct Edge
    {
      bool cuts_cells; ///< it does not run along edges of cells
      bool moves;      ///< a node of it is not held
    };
    Edge edge(const BoundaryCondition &condition) const; ///< of its face, as far as this rank has it
    /// @p velocity: wanted by more than the force.
    FaceMotion motion(const Face &face, std::size_t q, const Point &point, bool velocity = false) const;
    FaceStep   step(const Face &face, std::size_t q, const Point &point) const;
    /// Of a point, or of a step, to which the dissipation belongs that Point::dissipation asks of supports.
    Vector3      force(const Face &face, std::size_t q, const Point &point) const;
    ForceTangent tangent(const Face &face, std::size_t q, const Point &point) const;
    void         add_tangent(const Face &face, std::size_t q, const Point &point, Tangent &tangent) const;
    /// Tangents of the deformed face.
    std::array<Vector3, 2> edges(const Face &face, std::size_t q, const Vector &u) const;
    /// visit(face, point number) for points of owned cells where a condition of the @p kind acts.
    template <typename Visitor>
    void for_each_point(int kind, const Visitor &visit) const;

    static constexpr int loading = 0, pushing = 1;

    const Muscle3dDiscretisation                    &d_;
    int                                              n1_; ///< nodes in one direction
    std::array<bool, 2>                              has_{};
    bool                                             rates_ = false;
    std::vector<Face>                                faces_;
    std::map<const BoundaryCondition *, std::string> no_potential_; ///< see why_no_potential()
    // Of the nodes of a face at the points of its rule: [points][nodes].
    std::vector<std::vector<double>> value_, d1_, d2_;
    std::vector<double>              weights_; ///< of the rule
  };
} // namespace myolines
