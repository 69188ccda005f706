// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Private to this room.

#include <myolines/solve/preconditioner.h>
#include <myolines/solve/tangent_operator.h>

#include <mpi.h>

#include <vector>

namespace myolines
{
  /// C^T J C x = b as Krylov methods see it: the owned entries as plain arrays. Where local unknowns z are kept they stand behind x,
  ///
  ///     A x + (s B)^T (w z/s) = b,      w (s B x - s C s (z/s)) = s b_z,
  ///
  /// s the scale that makes the residual of z a force (LocalEquations::local_scale()): vectors of Krylov hold z/s and s r_z.
  class KrylovSystem
  {
  public:
    /// @p scale: s, or null: no local unknowns are kept. Actions where they are may be rounded if Newton's method asks for z, @p rounded:
    /// its residuals tell what that leaves. Otherwise the tolerance is that of the exact tangent.
    KrylovSystem(const TangentOperator &tangent, const Vector *scale, bool rounded);

    using Entries = std::vector<double>; ///< those that this rank owns

    MPI_Comm communicator() const { return x_.get_mpi_communicator(); }
    double   norm(const Entries &x) const;

    /// y = the left-hand sides of x.
    void apply(const double *x, double *y) const;

    /// z = P r. Where local unknowns are kept, @p elimination belongs to @p preconditioner, @p weight is that of u.
    void precondition(const Preconditioner &preconditioner, const LocalEquations::Elimination *elimination, double weight, const double *r,
                      double *z) const;

    /// Right-hand sides and unknowns as arrays; @p z may be null where none are kept, as b_z: zero.
    Entries right(const Vector &b, const Vector *b_z) const;
    void    take(const Entries &all, Vector &x, Vector *z) const;

  private:
    void split(const double *all, bool unknowns) const;

    const TangentOperator       &tangent_;
    const Vector                *scale_;
    const LocalEquations::Digits digits_;
    mutable Vector               x_, y_, z_, y_z_;
  };
} // namespace myolines
