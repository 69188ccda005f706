// SPDX-License-Identifier: LGPL-2.1-or-later
// Spectral radius, algorithmic damping and period error of the integrators over omega dt, as the program takes its steps: one
// block of numbers for each method, for gnuplot. The same transition matrices are compared with theory in tests/integrators.

#include "../integrators/measured.h"

#include <deal.II/base/mpi.h>

#include <iostream>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  struct Curve
  {
    std::string title;
    std::string method;
    Overrides   parameters;
  };

  const std::vector<Curve> curves = {
      {"backward Euler", "backward euler", {}},
      {"BDF2", "bdf2", {}},
      {"SDIRK2, TR-BDF2, Rosenbrock", "sdirk2", {}},
      {"SDIRK3", "sdirk3", {}},
      {"average acceleration", "newmark", {}},
      {"linear acceleration", "newmark", {"preset=linear acceleration"}},
      {"central difference", "newmark", {"preset=central difference"}},
      {"HHT, alpha = -0.3", "hht alpha", {"alpha=-0.3"}},
      {"WBZ, alpha = -0.3", "wbz alpha", {"alpha=-0.3"}},
      {"generalized alpha, radius 0.5", "generalized alpha", {"spectral radius at infinity=0.5"}},
      {"generalized alpha, radius 0", "generalized alpha", {"spectral radius at infinity=0"}},
      {"Wilson, theta = 1.4", "wilson theta", {"theta=1.4"}},
  };

  /// The history that a method keeps is that of its case in the suite with the same way of taking forces.
  Verified verified(const Curve &curve)
  {
    for (const Verified &known : all_cases())
      if (known.entry.facts.name == curve.method)
        {
          Verified result         = known;
          result.facts.parameters = curve.parameters;
          return result;
        }
    throw std::logic_error(curve.method + " has no case");
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout.precision(8);
  for (const Curve &curve : curves)
    {
      const Verified method = verified(curve);
      std::cout << "\"" << curve.title << "\"\n";
      for (double w = 1e-2; w < 1.001e3; w *= std::pow(10., 0.025))
        {
          const std::complex<double> q     = principal_root(characteristic_polynomial(transition_matrix(method, w, 0)));
          const double               angle = std::arg(q);
          std::cout << w / (2 * dealii::numbers::PI) << ' ' << std::abs(q) << ' ' << -std::log(std::abs(q)) / angle << ' ' << w / angle - 1
                    << '\n';
        }
      std::cout << "\n\n";
    }
}
