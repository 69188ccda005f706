// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/dirk.h>

#include <complex>
#include <string>
#include <vector>

namespace myolines
{
  /// What the coefficients of a DirkTable say of the method (Hairer and Wanner, Solving Ordinary Differential Equations II,
  /// doi:10.1007/978-3-642-05221-7, chapters IV.3 and IV.6).
  struct DirkFacts
  {
    unsigned int order          = 0;     ///< conditions up to order 4 are looked at
    unsigned int embedded_order = 0;     ///< likewise; 0: there is no embedded formula
    unsigned int stage_order    = 0;     ///< largest q up to 4 with sum_j a_ij c_j^(q-1) = c_i^q / q for all stages
    double       at_infinity    = 0;     ///< |R(z)| as z -> -infinity
    bool         a_stable       = false; ///< |R(i y)| <= 1, looked at for y from 1e-4 to 1e6
    /// A-stable, and nothing is left of the stiffest components after one step
    bool l_stable() const { return a_stable && at_infinity < 1e-12; }
  };

  DirkFacts facts_of(const DirkTable &table); ///< Computes them from the coefficients.

  /// R(z) of u' = lambda u, z = lambda dt: the factor of one step.
  std::complex<double> stability_function(const DirkTable &table, std::complex<double> z);

  /// Lines for `check`: order conditions, stability.
  std::vector<std::string> tell(const DirkFacts &facts);
} // namespace myolines
