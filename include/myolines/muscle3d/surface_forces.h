// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/discretisation.h>
#include <myolines/system/point.h>

#include <deal.II/lac/full_matrix.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Forces on faces that depend on the displacement: pressures on the face as it moves, elastic foundations, and the tendon or the stop
  /// of a face that moves as one. These act as a traction F(d - u.n) n / A at every point, which is the same where u.n is.
  class SurfaceForces
  {
  public:
    SurfaceForces(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation);

    /// Whether there are any, on any rank.
    bool any() const { return !conditions_.empty(); }

    /// r -= force at displacement @p u with current ghosts. Not compressed.
    /// The size of the forces [N], over all ranks.
    double subtract(double t, Side side, const Vector &u, Vector &r) const;

    /// -dF/du of one face of a cell: rows and columns are 3 i + c, i counts the nodes of the face.
    struct Tangent
    {
      NodeSpace::Cell                  cell;
      const std::vector<unsigned int> &nodes;  ///< local numbers of the nodes in vectors
      const std::vector<int>          &places; ///< their lexicographic numbers in the cell
      dealii::FullMatrix<double>       matrix;
    };
    /// Of all faces of owned and ghost cells at @p u.
    std::vector<Tangent> tangents(double t, Side side, const Vector &u, bool symmetrised) const;

    // Of all ranks.
    double energy(double t, Side side, const Vector &u) const;                 ///< stored in foundations, tendons, stops [J]
    double power(double t, Side side, const Vector &u, const Vector &v) const; ///< of pressures and of far ends of tendons [W]
    dealii::Tensor<1, 3> force(double t, Side side, const Vector &u, const BoundaryCondition &condition) const; ///< sum over the face [N]

  private:
    /// What is fixed at a quadrature point: weight of the rule, and its part of the reference face.
    struct FacePoint
    {
      double               weight; ///< of the unit square; 0 outside the box of the condition
      double               area;   ///< [m^2], likewise
      dealii::Tensor<1, 3> normal; ///< outward, at rest
    };
    struct Face
    {
      NodeSpace::Cell           cell;
      std::size_t               condition; ///< its number in conditions_
      double                    sign;      ///< outwards: of the product of the two tangents
      std::vector<unsigned int> nodes;
      std::vector<int>          places;
      std::vector<FacePoint>    points;
    };
    struct Condition
    {
      const BoundaryCondition *given;
      double                   area = 0;                         ///< of the whole face [m^2]
      double                   scale(double t, Side side) const; ///< pressure [Pa], motion of the far end or place of the stop [m]
    };
    /// Displacement at a point, and tangents of the deformed face.
    struct Deformed
    {
      dealii::Tensor<1, 3> u, x1, x2;
    };

    void                 add_face(const NodeSpace::Cell &cell, unsigned int face, std::size_t condition);
    Deformed             deformed(const Face &face, std::size_t q, const Vector &u) const;
    dealii::Tensor<1, 3> force(const Face &face, std::size_t q, double scale, const Deformed &x) const;
    void                 add_tangent(const Face &face, std::size_t q, double scale, const Deformed &x, dealii::FullMatrix<double> &K) const;
    /// visit(face, condition, point number, deformed) for points of owned cells that carry a force.
    template <typename Visitor>
    void for_each_point(const Vector &u, const Visitor &visit) const;

    const Muscle3dDiscretisation &d_;
    int                           n1_; ///< nodes in one direction
    std::vector<Condition>        conditions_;
    std::vector<Face>             faces_;
    // Of the nodes of a face at the points of its rule: [points][nodes].
    std::vector<std::vector<double>> value_, d1_, d2_;
  };
} // namespace myolines
