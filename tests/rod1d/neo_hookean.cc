// SPDX-License-Identifier: LGPL-2.1-or-later
// The Neo-Hookean rod of thesis section 4.7 against an independent program, with the conventions of the thesis.

#include "../support/drives.h"
#include "../support/table.h"
#include "rod.h"

#include <myolines/system/drive_types.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  std::pair<std::string, Overrides> method(const std::string &tag)
  {
    if (tag == "BE")
      return {"backward euler", {}};
    if (tag == "BDF2")
      return {"bdf2", {"first step=backward euler"}};
    if (tag == "TRBDF2")
      return {"tr-bdf2", {"first step=own"}};
    if (tag == "NEWMARK")
      return {"newmark", {"first step=own"}};
    if (tag == "HHT0.3")
      return {"hht alpha", {"alpha=-0.3", "first step=own"}};
    if (tag == "HHT1_3")
      return {"hht alpha", {"alpha=-0.33333333333333331", "first step=own"}};
    return {"generalized alpha", {"spectral radius at infinity=0.5", "first step=own"}};
  }

  /// Largest differences of u and v from the rows of one scheme and profile up to @p last [s].
  void compare_states(const std::string &tag, const int profile, const double last)
  {
    const auto [name, parameters] = method(tag);
    Rod          rod(thesis_rod(profile), name, parameters);
    double       u = 0, v = 0;
    unsigned int n = 0;
    for (const Row &row : rows("nh_states.csv"))
      {
        const double t = std::stod(row[4]);
        if (row[0] != tag || std::stoi(row[1]) != profile || t > last)
          continue;
        if (rod.state.t < t)
          rod.run(t, 1e-4);
        const unsigned int i = std::stoi(row[5]);
        u                    = std::max(u, std::abs(rod.state.u(i) - std::stod(row[7])));
        v                    = std::max(v, std::abs(rod.state.v(i) - std::stod(row[8])));
        ++n;
      }
    EXPECT_GE(n, 17u) << tag;
    EXPECT_LT(u, 1e-12) << tag << ", profile " << profile;
    EXPECT_LT(v, 1e-8) << tag << ", profile " << profile;
  }
  /// Largest strain rate v/x and total variation of v/x at four places of the rod, as in nh_metrics.csv.
  struct StrainRates : Observer
  {
    explicit StrainRates(const Rod1dSystem &system)
      : system(system)
    {}
    void accepted(const State &state, const StepRecord &) override
    {
      for (unsigned int i = 0; i < 4; ++i)
        {
          const double now = system.value(state.v, x[i]) / x[i];
          largest[i]       = std::max(largest[i], std::abs(now));
          variation[i] += std::abs(now - last[i]);
          last[i] = now;
        }
    }
    const Rod1dSystem  &system;
    std::vector<double> x = {0.025, 0.05, 0.09, 0.1}, last = x, largest = x, variation = x;
  };

  /// The rows of one run, one for each place.
  void compare_metrics(const std::vector<Row> &run)
  {
    const Row      &first         = run.front();
    const int       profile       = std::stoi(first[1]);
    Rod1dParameters p             = thesis_rod(profile);
    p.material                    = RodMaterial::neo_hookean_thesis(std::stod(first[4]), 0.4);
    p.stiffness_factor            = std::stod(first[5]);
    const auto [name, parameters] = method(first[0]);
    Rod         rod(p, name, parameters, first[6] == "exact" ? Overrides{"boundary rates=exact", "start velocity=consistent"} : Overrides{},
                    {"relative tolerance=1e-9"});
    StrainRates rates(rod.system);
    rates.last = rates.largest = rates.variation = std::vector<double>(4, 0.);
    rod.run(profile == 3 ? 1 : 2, 1e-4, {&rates});
    for (unsigned int i = 0; i < 4; ++i)
      {
        const double largest = std::stod(run[i][8]), variation = std::stod(run[i][10]);
        const auto   what =
            first[0] + ", profile " + first[1] + ", kappa " + first[4] + ", factor " + first[5] + ", " + first[6] + ", x/L = " + run[i][7];
        EXPECT_NEAR(rates.largest[i], largest, 0.01 * largest) << what;
        EXPECT_NEAR(rates.variation[i], variation, 0.01 * variation) << what;
      }
  }
} // namespace

TEST(NeoHookeanRod, nodalStatesAreThoseOfAnIndependentProgram)
{
  for (const char *tag : {"BE", "BDF2", "TRBDF2", "NEWMARK", "HHT0.3", "HHT1_3", "GENALPHA0.5"})
    {
      compare_states(tag, 1, 1);
      compare_states(tag, 2, 1);
      compare_states(tag, 3, 1);
    }
}

/// Stiff and soft, with both kinds of boundary rates. Left out are backward Euler with exact rates, where the other program makes the
/// acceleration of the boundary from differences, and, for time, the schemes that the test above has covered.
TEST(NeoHookeanRod, overshootsAndOscillatesLikeAnIndependentProgram)
{
  std::map<std::string, std::vector<Row>> runs;
  for (const Row &row : rows("nh_metrics.csv"))
    if ((row[0] == "BE" && row[6] != "exact") || row[0] == "HHT0.3" || row[0] == "NEWMARK")
      runs[row[0] + row[1] + row[4] + row[5] + row[6]].push_back(row);
  EXPECT_EQ(runs.size(), 25u);
  for (const auto &[key, run] : runs)
    compare_metrics(run);
}

/// SDIRK3 with small steps against the exact-in-time solution of the same elements, with and without the impulse of the boundary
/// that starts with a velocity.
TEST(NeoHookeanRod, tendsToTheSolutionOfTheSemiDiscreteSystem)
{
  for (const std::string start : {"impulse", "noimpulse"})
    {
      Rod rod(thesis_rod(3), "sdirk3", {},
              {"boundary rates=exact", "events=restart", "start velocity=" + std::string(start == "impulse" ? "impulse" : "consistent")});
      for (const Row &row : rows("nh_semidiscrete_reference.csv"))
        {
          const double t = std::stod(row[2]);
          if (row[0] != start || row[1] != "8" || t > 0.0101)
            continue;
          if (rod.state.t < t)
            rod.run(t, 1e-6);
          const unsigned int i = std::stoi(row[3]);
          EXPECT_NEAR(rod.state.u(i), std::stod(row[5]), 1e-9) << start << ", t = " << t << ", node " << i;
        }
    }
}
