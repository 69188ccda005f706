// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

#include <cmath>

namespace myolines::testing
{
  namespace
  {
    /// (3/2 - z) x^2 - 2 x + 1/2 = 0; the principal root is e^z (1 + z^3/3 + ...). A first step of backward Euler, wrong by
    /// z^2/2, changes the amplitude by 3/4 z^2.
    Case bdf2_case(const std::string &label, const std::string &first_step, const double amplitude)
    {
      Case c;
      c.label      = label;
      c.parameters = {"first step=" + first_step};
      c.order      = 2;
      c.history    = {{"last increment of u", 0}, {"last increment of v", 1}};
      c.polynomial = [](const double w, const double xi) {
        std::vector<std::complex<double>> roots;
        for (const double sign : {1., -1.})
          {
            const std::complex<double> z(-xi * w, sign * std::sqrt(1 - xi * xi) * w);
            const std::complex<double> root = std::sqrt(1. + 2. * z);
            roots.push_back((2. + root) / (3. - 2. * z));
            roots.push_back((2. - root) / (3. - 2. * z));
          }
        return from_roots(roots);
      };
      c.error = [amplitude](const double T) {
        return Motion{T / 3 * std::sin(T) - amplitude * std::cos(T), T / 3 * std::cos(T) + amplitude * std::sin(T)};
      };
      return c;
    }
  } // namespace

  std::vector<Case> bdf2_cases()
  {
    std::vector<Case> cases = {bdf2_case("bdf2", "sdirk2", 0), bdf2_case("bdf2_backward_euler_first", "backward euler", 0.75)};
    cases[0].estimate       = 2. / 9; // the error against exact earlier values; those of the method itself make it 1/3
    cases[1].controls_error = false;  // its first step is not estimated
    cases[1].exact_start    = false;
    return cases;
  }
} // namespace myolines::testing
