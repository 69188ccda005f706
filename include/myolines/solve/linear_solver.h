// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/ledger.h>
#include <myolines/system/linearisation.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// How a linear solve ended: a value, never an exception.
  struct LinearReport
  {
    bool         converged = false;     ///< whether the tolerance was met
    std::string  reason;                ///< why not; empty if it did
    unsigned int iterations        = 0; ///< of the Krylov method
    double       relative_residual = 0; ///< true |b - J x| / |b|
  };

  /// The part of a system that belongs to the local unknowns z (LocalEquations).
  struct LocalPart
  {
    const Vector &b;              ///< b_z
    Vector       &x;              ///< z
    double        size;           ///< tolerances are parts of this instead of |b|
    bool          strict = false; ///< its residual counts as it would with z eliminated, LocalEquations::local_scale(true)
  };

  /// True once the run is asked to stop: solves then fail at the next occasion. All ranks get the same answer, in the same order of calls.
  using StopRequest = std::function<bool()>;

  /// Krylov solver (Belos) with a preconditioner by name, for C^T J C x = b on the free unknowns.
  ///
  /// CG where the operator is symmetric; GMRES otherwise, and as fallback when CG meets a direction of non-positive
  /// curvature or stalls. The true residual is checked after every solve. A preconditioner that is the inverse gets one
  /// application first, and Krylov iterations only if that was not enough.
  ///
  /// The preconditioner is kept from solve to solve. It is rebuilt, depending on `rebuild`, at each new step or only when
  /// it has become slow: when the iterations that keeping it has cost are worth a set-up (`slow iterations`). A solve that
  /// fails with a kept preconditioner is repeated with a fresh one. Call forget() before solving with another
  /// Linearisation than before.
  ///
  /// Ledger: "preconditioner set-ups", "linear solves", "linear iterations", "krylov fallbacks"; seconds of "assembly",
  /// "preconditioner", "linear solve".
  class LinearSolver
  {
  public:
    ///@{
    /// Parameters of the lists `solver/linear` and `solver/preconditioner`.
    static scene::Schema linear_schema();
    static scene::Schema preconditioner_schema();
    ///@}

    /// What the lists choose for a system, in words; @p constant: its Jacobian is. @throws InputError if the preconditioner does not fit
    /// the system.
    static std::vector<std::string> plan(const scene::Node &linear, const scene::Node &preconditioner, const Linearisation &linearisation,
                                         std::size_t n_unknowns, bool constant);

    /// Of those two lists. @p stop, if given, is asked before set-ups and in every iteration.
    LinearSolver(const scene::Node &linear, const scene::Node &preconditioner, WorkLedger &ledger, StopRequest stop = {});
    ~LinearSolver();

    /// True if the scene leaves the choice of the preconditioner to the program.
    bool automatic() const;

    /// Looked at before set-ups and in every iteration, by Newton's method too.
    bool asked_to_stop() const;

    /// The next solve may build a fresh preconditioner: the operator has moved on to another time step or stage weight.
    void new_step();

    /// Drops what was kept. A run that calls this when it saves its state goes on bit for bit like one that loads it.
    void forget();

    /// Solves to |b - J x| <= @p tolerance |b| over the free unknowns. Entries of constrained unknowns of @p b are
    /// ignored (a right-hand side f is given as C^T f) and those of @p x come back zero. Never throws: what went wrong is
    /// in the report, and x then holds the best iterate found, which may be zero. GMRES gives up when its last cycle tells
    /// that the iterations which are left will not do, and already when it did not halve a residual below @p enough |b|:
    /// another step of Newton's method is then worth more.
    ///
    /// Where the system has local unknowns and its action is cheap they are kept: the Krylov method, which is GMRES then, works on x and z,
    /// with preconditioners that need not know how stiff the equation of z is. With a @p local part the residual is that of
    /// both equations (scaled, LocalEquations::local_scale()), without z is eliminated: b_z = 0, and the residual is that of J x = b.
    LinearReport solve(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints, bool symmetric,
                       const Vector &b, Vector &x, double tolerance, double enough = 0, const LocalPart *local = nullptr);

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
  };
} // namespace myolines
