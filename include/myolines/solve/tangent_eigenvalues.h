// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>

#include <vector>

namespace myolines
{
  /// The @p number smallest eigenvalues mu of K x = mu B x over the free unknowns, negative ones first, ascending, to about 1e-8 of the
  /// largest of them; B is M if @p with_mass, else the identity. Where a dense matrix is no larger than what an iteration stores, it is
  /// made; else the block Davidson method (Anasazi; Arbenz et al., doi:10.1002/nme.1365) finds them by actions of K and B only, with the
  /// preconditioner of the scene's list @p preconditioner. K must be symmetric. Works on all ranks, the dense matrix on one.
  /// @throws InputError if K is not symmetric, or there are fewer free unknowns; SolveError if the iteration has not converged.
  std::vector<double> smallest_eigenvalues(Linearisation &linearisation, bool with_mass, const Constraints &constraints,
                                           const Vector &layout, unsigned int number, const scene::Node &preconditioner,
                                           WorkLedger &ledger);

  /// Those of the tangent of @p system in the configuration of @p state, held at rest: v = a = 0, where force-velocity gives neither force
  /// nor stiffness. Stable equilibria have positive ones only. With inertia B = M and mu are squares of frequencies [1/s^2]; where one is
  /// negative small motions grow. Without, B is the identity, and mu [N/m] depends on the mesh but for its sign.
  std::vector<double> tangent_eigenvalues(const SemiDiscreteSystem &system, const State &state, unsigned int number,
                                          const scene::Node &preconditioner, WorkLedger &ledger);
} // namespace myolines
