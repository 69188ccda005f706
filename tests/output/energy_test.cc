// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/energy_watch.h>

#include "folder.h"

#include <cmath>

using namespace myolines;

namespace
{
  std::string text(const EnergyReport &report)
  {
    std::string all;
    for (const std::string &line : energy_lines(report, "some method"))
      all += line + "\n";
    return all;
  }

  bool has(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }
} // namespace

TEST(EnergyLines, SmallDriftsAreToldWithoutAWarning)
{
  EnergyReport report;
  report.exchanged = 2;
  for (const double drift : {-0.01, 0.06})
    {
      report.drift     = drift;
      report.rise.size = std::max(0., drift);
      EXPECT_TRUE(has(text(report), "drifts by")) << text(report);
      EXPECT_FALSE(has(text(report), "Warning")) << text(report);
      EXPECT_FALSE(has(text(report), "dissipation")) << text(report);
    }
  EXPECT_TRUE(has(text(report), "0.06 J, 3 % of the 2 J exchanged")) << text(report);
}

TEST(EnergyLines, ALossIsNumericalDissipation)
{
  EnergyReport report;
  report.exchanged = 2;
  report.drift     = -0.5;
  EXPECT_EQ(text(report), "Energy: 0.5 J, 25 % of the 2 J exchanged, went into numerical dissipation of \"some method\".\n");
}

TEST(EnergyLines, AGainWarnsWithTimesAndMethodAlsoWhereItIsLostAgain)
{
  EnergyReport report;
  report.exchanged        = 2;
  report.drift            = -0.1;
  report.rise             = {0.3, 0.5, 0.4};
  report.jump             = {0.4, 0.42, 0.25};
  const std::string lines = text(report);
  EXPECT_TRUE(has(lines, "Warning: from t = 0.3 s to t = 0.5 s the balance of energy gains 0.4 J, 20 % of the 2 J exchanged")) << lines;
  EXPECT_TRUE(has(lines, "from t = 0.4 s to t = 0.42 s (0.25 J)")) << lines;
  EXPECT_TRUE(has(lines, "\"some method\"")) << lines;
}

TEST(EnergyLines, NothingIsToldOfABodyAtRest) { EXPECT_EQ(text(EnergyReport()), ""); }

// A state at which a method does not look may be torn; what was gained before is told all the same.
TEST(EnergyLines, AnEnergyThatIsNoNumberIsAWarningAndNoDigits)
{
  EnergyReport report;
  report.exchanged = 2;
  report.drift     = std::nan("");
  EXPECT_TRUE(has(text(report), "Warning: the energy of the last state is no number")) << text(report);
  EXPECT_FALSE(has(text(report), "nan")) << text(report);
  report.rise = {0.3, 0.5, 0.4};
  EXPECT_TRUE(has(text(report), "gains 0.4 J")) << text(report);
}
