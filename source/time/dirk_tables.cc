// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/dirk_tables.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    /// With the last row of @p a as the formula, and @p embedded as the other.
    DirkTable with_embedded(std::vector<std::vector<double>> a, std::vector<double> embedded)
    {
      for (std::size_t i = 0; i < embedded.size(); ++i)
        embedded[i] = a.back()[i] - embedded[i];
      return {std::move(a), std::move(embedded)};
    }
  } // namespace

  DirkTable sdirk2_table()
  {
    const double gamma = 1 - std::sqrt(0.5);
    return {{{gamma}, {1 - gamma, gamma}}, {-gamma / 5, gamma / 5}};
  }

  DirkTable sdirk3_table()
  {
    const double gamma = 0.43586652150845899942;
    const double b1    = -(6 * gamma * gamma - 16 * gamma + 1) / 4;
    const double b2    = (6 * gamma * gamma - 20 * gamma + 5) / 4;
    return {{{gamma}, {(1 - gamma) / 2, gamma}, {b1, b2, gamma}}, {gamma / 5, -2 * gamma / 5, gamma / 5}};
  }

  DirkTable tr_bdf2_table()
  {
    const double d = 1 - std::sqrt(0.5), w = std::sqrt(0.125);
    return {{{0}, {d, d}, {w, w, d}}, {w - (1 - w) / 3, w - (3 * w + 1) / 3, d - d / 3}};
  }

  DirkTable bathe_table(const double rho)
  {
    const double s = std::sqrt(2 + 2 * rho), g = 2 / (2 + s), d = g / 2, q1 = s / 4, q0 = 0.5 + (g - 1) * q1;
    const double middle = 1 / (6 * g * (1 - g)), last = 0.5 - g * middle;
    return with_embedded({{0}, {d, d}, {q0, q1, d}}, {1 - middle - last, middle, last});
  }

  DirkTable esdirk3_table()
  {
    const double g = 1767732205903. / 4055673282236;
    return with_embedded({{0},
                          {g, g},
                          {2746238789719. / 10658868560708, -640167445237. / 6845629431997, g},
                          {1471266399579. / 7840856788654, -4482444167858. / 7529755066697, 11266239266428. / 11593286722821, g}},
                         {2756255671327. / 12835298489170, -10771552573575. / 22201958757719, 9247589265047. / 10645013368117,
                          2193209047091. / 5459859503100});
  }

  DirkTable esdirk4_table()
  {
    return with_embedded(
        {{0},
         {1. / 4, 1. / 4},
         {8611. / 62500, -1743. / 31250, 1. / 4},
         {5012029. / 34652500, -654441. / 2922500, 174375. / 388108, 1. / 4},
         {15267082809. / 155376265600, -71443401. / 120774400, 730878875. / 902184768, 2285395. / 8070912, 1. / 4},
         {82889. / 524892, 0, 15625. / 83664, 69875. / 102672, -2260. / 8211, 1. / 4}},
        {4586570599. / 29645900160, 0, 178811875. / 945068544, 814220225. / 1159782912, -3700637. / 11593932, 61727. / 225920});
  }
} // namespace myolines
