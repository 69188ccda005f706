// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/linear_solver.h>

#include <optional>
#include <string>

namespace myolines
{
  /// When the preconditioner "automatic" goes over from p multigrid to sparse factors: once solves have taken so many iterations that
  /// factors would have been cheaper. Flat and slender bodies have cheap factors, and their cells are hard for p multigrid.
  class DirectTakeover
  {
  public:
    DirectTakeover() = default; ///< never

    /// Of the list @p preconditioner of a scene, for a system of @p n_unknowns on @p ranks. Never, where p multigrid is not the choice of
    /// "automatic" or the factors would take more than 1 GB.
    DirectTakeover(const scene::Node &preconditioner, const Linearisation &linearisation, std::size_t n_unknowns, unsigned int ranks);

    /// Whether it is time, after a solve with p multigrid: it has failed, or lost more than one such solve; before that it may still be the
    /// better choice. True once.
    bool due(const LinearReport &solve);

    std::string words() const; ///< for a plan: "; direct takes over ...", or nothing

  private:
    std::optional<double> worth_;      ///< iterations from which on factors are cheaper
    double                regret_ = 0; ///< iterations beyond that, summed over the last solves
    double                bytes_  = 0; ///< of the factors, with the matrix and what the elimination needs beside
  };
} // namespace myolines
