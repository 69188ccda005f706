// SPDX-License-Identifier: LGPL-2.1-or-later
// Units that a person may have meant otherwise: `check` says so, and reads those that a table tells.
#include "program_runner.h"

#include <gtest/gtest.h>

namespace
{
  /// Corners of a block of 3 x 1 x 1 cm, in parts of a metre.
  std::string corners(const std::string &names, const double unit, const std::string &value)
  {
    std::ostringstream text;
    text << names << "\n";
    for (int i = 0; i < 8; ++i)
      text << 0.03 * unit * (i % 2) << "," << 0.01 * unit * (i / 2 % 2) << "," << 0.01 * unit * (i / 4) << "," << value << "\n";
    return text.str();
  }

  std::string told(const TestFolder &folder, const std::string &more)
  {
    const Outcome outcome = run_program(folder, "check " + myolines::test::source_folder() +
                                                    "/input/isometric_block.xml --set system/geometry/refinement=0 " + more);
    return outcome.out.substr(std::min(outcome.out.find("Warning"), outcome.out.size())) + outcome.err;
  }
} // namespace

TEST(Units, AnAngleInRadiansIsTold)
{
  const TestFolder folder;
  EXPECT_NE(told(folder, "--set system/fibres/angle=-0.5236").find("Were radians meant? That would be 30.0001 degrees"), std::string::npos);
  for (const char *good : {"0", "5", "-30"})
    EXPECT_EQ(told(folder, std::string("--set system/fibres/angle=") + good), "");
}

TEST(Units, ATableOfPointsInMillimetresIsToldOrReadAsSuch)
{
  const TestFolder  folder;
  const std::string table = "--set system/fields/table=table.csv";
  folder.write("table.csv", corners("qp_x,qp_y,qp_z,fat_fraction", 1e3, "0.1"));
  EXPECT_NE(told(folder, table).find("Is \"table scale\" in system/fields the unit of the table"), std::string::npos);
  EXPECT_EQ(told(folder, table + " --set 'system/fields/table scale=mm'"), "");
  for (const char *names : {"qp_x [mm],qp_y [mm],qp_z [mm],fat_fraction [%]", "qp_x,qp_y,qp_z,fat_fraction\nmm,mm,mm,%"})
    {
      folder.write("table.csv", corners(names, 1e3, "10"));
      EXPECT_EQ(told(folder, table), "") << names;
      EXPECT_NE(told(folder, table + " --set 'system/fields/table scale=mm'").find("has a unit, and the scene a \"table scale\""),
                std::string::npos);
    }
  folder.write("table.csv", corners("qp_x [N],qp_y,qp_z,fat_fraction", 1, "0.1"));
  EXPECT_NE(told(folder, table).find("the column \"qp_x [N]\" is in \"N\""), std::string::npos);
  folder.write("table.csv", corners("qp_x,qp_y,qp_z,fat_fraction", 1, "0.1"));
  EXPECT_EQ(told(folder, table), "");
  EXPECT_NE(told(folder, table + " --set 'system/fields/table scale=mm'").find("Is \"table scale\""), std::string::npos);
}
