// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/interpolation.h>
#include <myolines/algebra/patch_matrices.h>
#include <myolines/algebra/sparse_matrix.h>
#include <myolines/system/point.h>

#include <functional>
#include <vector>

namespace myolines
{
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
    PatchMatrices       &patches; ///< symmetric parts of the principal submatrices of overlapping patches, not inverted yet
    const Interpolation &interpolation;
    const SparseMatrix  &coarse;             ///< P^T J P
    const MultilevelData coarse_data;        ///< of the coarse matrix
    Vector               coarse_layout;      ///< any vector of the coarse space
    const Constraints   &coarse_constraints; ///< what relates its unknowns: coarse vectors are C q before P

    /// y = J x, full length, of a cheaper J close to the true one (say of lower quadrature) at the state of the patches;
    /// empty where the true one is cheap enough. @p x needs current ghosts.
    std::function<void(const Vector &x, Vector &y)> action;
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

    /// The same at fixed local unknowns: without what their change adds to K.
    virtual void apply_at_fixed_local(const WeightsByOrder &weights, const Vector &x, Vector &y) const { apply(weights, x, y); }

    /// Whether apply() costs less than filling the matrix of sparse() and a few products with it.
    virtual bool action_is_cheap() const { return false; }

    /// C^T J C with unit rows for constrained unknowns (times a typical diagonal entry). The reference stays valid, and
    /// the values stand, until the next call or the next linearise().
    virtual const SparseMatrix &sparse(const WeightsByOrder &weights) = 0;

    /// Data for multilevel preconditioners, or nullptr where the system has none. Independent of the weights.
    virtual const MultilevelData *multilevel() const { return nullptr; }

    /// Whether two_level() gives something.
    virtual bool has_two_levels() const { return false; }

    /// Fresh patches and coarse matrix for the weights, or nullptr where the system has none. Valid until the next call.
    virtual TwoLevel *two_level(const WeightsByOrder & /*weights*/) { return nullptr; }
  };
} // namespace myolines
