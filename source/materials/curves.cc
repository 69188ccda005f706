#include <myolines/materials/curves.h>

#include <algorithm>
#include <cmath>

namespace myolines::curves
{
  double passive_energy(const double stretch)
  {
    // Antiderivative of (c2 (s - x0)^2 + c1 (s - x0) + c0)/s, piece by piece between the knots of passive().
    constexpr double knots[5] = {1, 1.25, 1.5, 1.65, 1e300};
    constexpr double c[4][3]  = {{2.353845, 0, 0}, {3.436357, 1.176922, 0.147115}, {0.427408, 2.895101, 0.656118}, {0, 3.023323, 1.1}};
    double           energy   = 0;
    for (int piece = 0; piece < 4 && stretch > knots[piece]; ++piece)
      {
        const double x0 = knots[piece], x1 = std::min(stretch, knots[piece + 1]);
        const double c2 = c[piece][0], c1 = c[piece][1], c0 = c[piece][2];
        energy += 0.5 * c2 * (x1 * x1 - x0 * x0) + (c1 - 2 * c2 * x0) * (x1 - x0) + (c0 - c1 * x0 + c2 * x0 * x0) * std::log(x1 / x0);
      }
    return energy;
  }
} // namespace myolines::curves
