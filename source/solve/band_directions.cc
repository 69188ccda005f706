// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/band_directions.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    bool same(const double left, const double right) { return std::abs(left - right) <= 1e-10 * std::abs(left); }

    /// Equal up to the rounding of step sizes, which are differences of instants; far below the tolerances of the solver.
    bool same(const WeightsByOrder &left, const WeightsByOrder &right)
    {
      return std::equal(left.begin(), left.end(), right.begin(),
                        [](const Weights &a, const Weights &b) { return same(a.u, b.u) && same(a.v, b.v) && same(a.a, b.a); });
    }
  } // namespace

  bool BandDirections::factorise(NonlinearProblem &problem, const std::size_t size)
  {
    const auto &bands = dynamic_cast<const BandLinearisation &>(problem.linearisation());
    if (factored_ && factored_->bands == &bands && factored_->version == bands.version() && same(factored_->weights, problem.weights()))
      return true;
    const WorkLedger::Timer timer(ledger_, "factorisation");
    ledger_.count("preconditioner set-ups");
    if (!matrix_ || matrix_->size() != size || matrix_->bandwidth() != std::min<std::size_t>(bands.bandwidth(), size - 1))
      matrix_.emplace(size, bands.bandwidth());
    factored_.reset();
    bands.fill(problem.weights(), *matrix_);
    if (!matrix_->factorise())
      return false;
    factored_ = Factored{&bands, bands.version(), problem.weights()};
    return true;
  }

  LinearReport BandDirections::solve(NonlinearProblem &problem, const Vector &b, Vector &dx, double, double, const LocalPart *)
  {
    ledger_.count("linear solves");
    ledger_.count("linear iterations");
    LinearReport report;
    report.iterations = 1;
    if (!factorise(problem, b.size()))
      {
        report.relative_residual = 1;
        report.reason            = "the matrix is singular";
        return report;
      }
    report.converged = true;
    dx.zero_out_ghost_values();
    std::copy(b.begin(), b.end(), dx.begin());
    const WorkLedger::Timer timer(ledger_, "band solve");
    matrix_->solve(dx.begin());
    return report;
  }
} // namespace myolines
