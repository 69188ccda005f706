// SPDX-License-Identifier: LGPL-2.1-or-later
#include "direct_takeover.h"

#include <myolines/solve/preconditioner.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  DirectTakeover::DirectTakeover(const scene::Node &preconditioner, const Linearisation &linearisation, const std::size_t n_unknowns,
                                 const unsigned int ranks)
  {
    if (preconditioner.text("type") != "automatic" ||
        automatic_choice(preconditioner, n_unknowns, linearisation.has_two_levels()) != "p multigrid")
      return;
    const std::optional<FactorisationCost> cost = linearisation.factorisation_cost();
    if (!cost)
      return;
    constexpr double largest = 1e9;  // [B]; more than that is for those who ask for direct
    constexpr double matrix  = 6000; // [B] per unknown, with its copies
    bytes_                   = 13 * sizeof(double) * cost->squares + matrix * static_cast<double>(n_unknowns);
    if (bytes_ > largest)
      return;
    // In iterations of p multigrid: the matrix and the solves, and the operations of the factors (doc/decisions/linear-solver-defaults.md).
    // Ranks share fronts less well than cells.
    worth_ = (15 + 1e-3 * cost->cubes / n_unknowns) * std::sqrt(ranks);
  }

  bool DirectTakeover::due(const LinearReport &solve)
  {
    if (!worth_)
      return false;
    regret_ = std::max(0., regret_ + solve.iterations - *worth_);
    if (solve.converged && regret_ <= *worth_)
      return false;
    worth_.reset();
    return true;
  }

  std::string DirectTakeover::words() const
  {
    if (!worth_)
      return "";
    std::ostringstream text;
    text << "; direct takes over where solves go on for more than " << std::lround(*worth_) << " iterations, with about "
         << std::max(1L, std::lround(bytes_ / 1e6)) << " MB more";
    return text.str();
  }
} // namespace myolines
