// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/interpolation.h>
#include <myolines/algebra/patch_matrices.h>
#include <myolines/algebra/sparse_matrix.h>
#include <myolines/system/point.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace myolines
{
  /// What sparse LU factors cost: sums over the dense fronts of an elimination, of their numbers of unknowns.
  struct FactorisationCost
  {
    double cubes   = 0; ///< operations are a few times as many
    double squares = 0; ///< entries are a few times as many
  };

  /// What multilevel preconditioners may know beyond the matrix.
  struct MultilevelData
  {
    /// Unknowns of one node stand next to each other: 3 for displacements, 1 for scalar systems.
    unsigned int unknowns_per_node = 1;

    /// Vectors the operator nearly maps to zero (rigid-body modes), zero on constrained unknowns.
    std::vector<Vector> near_null_space;
  };

  /// J = C^T J C as a two-level preconditioner sees it: without the matrix itself.
  struct TwoLevel
  {
    PatchMatrices       &patches;            ///< symmetric parts of the principal submatrices of overlapping patches, not inverted yet
    const Interpolation &interpolation;      ///< P, from the coarse space
    SparseMatrix        &coarse;             ///< P^T J P; who needs it no longer may release_entries()
    const MultilevelData coarse_data;        ///< of the coarse matrix
    Vector               coarse_layout;      ///< any vector of the coarse space
    const Constraints   &coarse_constraints; ///< what relates its unknowns: coarse vectors are C q before P

    /// y = J x, full length, of a cheaper J close to the one of the state (say of lower quadrature, or rounded). @p x needs current ghosts.
    std::function<void(const Vector &x, Vector &y)> action;
  };

  /// The linearised equations of local unknowns z (SemiDiscreteSystem::local()) that are kept as unknowns beside x, instead of
  /// J x = b with z eliminated, J = A + w.u B^T C^(-1) B:
  ///
  ///     A x + w.u B^T z = b,      w.u B x - w.u C z = b_z.
  ///
  /// C is a matrix of its own for every cell, and small where the equation of z is stiff. Newton's method has b = -R(u, z) and
  /// b_z = -g; the local unknowns then change by w.u z. Of a step (Point::before) the B^T of the first equation is not the transpose of the
  /// B of the second: z enters forces by the mean of two states, and its equation holds at the end.
  class LocalEquations
  {
  public:
    virtual ~LocalEquations() = default;

    /// z = 0 of all cells, with ghosts.
    virtual Vector make_local() const = 0;

    /// What a residual of 1 in the equation of an entry of z amounts to in the unit of R: as SemiDiscreteSystem::residual() measures it in
    /// Evaluation::local, or, @p eliminated, what it leaves in the equation of x with z eliminated.
    virtual Vector local_scale(bool eliminated) const = 0;

    /// Of the derivatives in an action: all digits, or at least those of single precision, which do for Newton's method. The rows of z
    /// have all.
    enum class Digits
    {
      all,
      single
    };

    /// The left-hand sides at @p x and @p z, neither needs ghosts; @p y full length, no constraint applied.
    virtual void apply_with_local(const WeightsByOrder &weights, Digits digits, const Vector &x, const Vector &z, Vector &y,
                                  Vector &y_z) const = 0;

    /// g of the point: the residual of the equation of z. Zero where z is that of u.
    virtual void local_residual(Vector &g) const = 0;

    /// B and W, to solve with [A, w.u B^T; w.u B, -w.u W^(-1)]: (A + w.u B^T W B) x = b + B^T W b_z, z = W (B x - b_z / w.u). Keeps the
    /// values of the moment.
    class Elimination
    {
    public:
      virtual ~Elimination() = default;

      /// b += B^T W b_z, full length, no constraint applied.
      virtual void condense(const Vector &b_z, Vector &b) const = 0;

      /// z = W (B x - b_z / weight).
      virtual void recover(double weight, const Vector &x, const Vector &b_z, Vector &z) const = 0;
    };

    /// W = C^(-1), or, @p softened, one that is mild enough for preconditioners of A + w.u B^T W B.
    virtual std::unique_ptr<Elimination> eliminate(bool softened) const = 0;
  };

  /// A system linearised at a Point: everything solvers may ask of K = dR/du, C = dR/dv, M = dR/da.
  /// Filled by SemiDiscreteSystem::linearise(); weights are given at use, so one linearisation serves any integrator.
  class Linearisation
  {
  public:
    virtual ~Linearisation() = default;

    /// y = J x with J = w.u K + w.v C + w.a M, full length, no constraint applied: rows and columns of constrained
    /// unknowns are those of the free system (a lift or a reaction needs them). @p x needs no ghosts on entry.
    virtual void apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const = 0;

    /// Where the system has local unknowns: their equations.
    virtual const LocalEquations *local() const { return nullptr; }

    /// Whether apply() costs less than filling the matrix of sparse() and a few products with it.
    virtual bool action_is_cheap() const { return false; }

    /// C^T J C with unit rows for constrained unknowns (times a typical diagonal entry). The reference stays valid, and
    /// the values stand, until the next call or the next linearise().
    virtual const SparseMatrix &sparse(const WeightsByOrder &weights) = 0;

    /// The same for preconditioners of the system with local unknowns: A + w.u B^T W B, see LocalEquations::eliminate().
    virtual const SparseMatrix &softened_sparse(const WeightsByOrder &weights) { return sparse(weights); }

    /// Data for multilevel preconditioners, or nullptr where the system has none. Independent of the weights.
    virtual const MultilevelData *multilevel() const { return nullptr; }

    /// An estimate for the matrix of sparse(); none where the system has none. Independent of the state.
    virtual std::optional<FactorisationCost> factorisation_cost() const { return std::nullopt; }

    /// Whether two_level() gives something.
    virtual bool has_two_levels() const { return false; }

    /// Fresh patches and coarse matrix for the weights, or nullptr where the system has none. Valid until the next call. @p softened: of
    /// the matrix of softened_sparse().
    virtual TwoLevel *two_level(const WeightsByOrder & /*weights*/, bool /*softened*/) { return nullptr; }
  };
} // namespace myolines
