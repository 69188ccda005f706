// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/direction_solver.h>
#include <myolines/system/band_linearisation.h>

#include <optional>

namespace myolines
{
  /// Directions of problems whose linearisation is a BandLinearisation: a direct solve without set-up. A factorisation is kept while the
  /// matrix stays.
  ///
  /// Ledger: "preconditioner set-ups" (factorisations), "linear solves", "linear iterations"; seconds of "factorisation", "band solve".
  class BandDirections : public DirectionSolver
  {
  public:
    /// @p ledger outlives the object.
    explicit BandDirections(WorkLedger &ledger)
      : ledger_(ledger)
    {}

    /// Whether the problem has such a linearisation.
    static bool fit(NonlinearProblem &problem) { return dynamic_cast<BandLinearisation *>(&problem.linearisation()) != nullptr; }

    bool         exact() const override { return true; }
    LinearReport solve(NonlinearProblem &problem, const Vector &b, Vector &dx, double tolerance, double enough,
                       const LocalPart *local) override;

    /// Drops the factorisation.
    void forget() { factored_.reset(); }

  private:
    /// What the matrix that is factored was made from.
    struct Factored
    {
      const BandLinearisation *bands;
      std::uint64_t            version;
      WeightsByOrder           weights;
    };

    bool factorise(NonlinearProblem &problem, std::size_t size);

    WorkLedger               &ledger_;
    std::optional<BandMatrix> matrix_;
    std::optional<Factored>   factored_;
  };
} // namespace myolines
