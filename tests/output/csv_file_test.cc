// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>

#include "folder.h"

#include <cmath>
#include <limits>
#include <random>

using namespace myolines;

TEST(CsvFile, NumbersReadBackExactly)
{
  test::Folder                           folder;
  CsvFile                                csv(folder.path, "a.csv", {"value"});
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int>     exponent(-300, 300);
  std::vector<double>                    values{0, 0.1, 1. / 3, 1e-308, std::numeric_limits<double>::max(), std::nextafter(1., 2.)};
  for (int i = 0; i < 200; ++i)
    values.push_back(std::ldexp(mantissa(random), exponent(random)));
  for (const double value : values)
    csv.row(std::vector<double>{value});

  const std::vector<std::string> lines = folder.lines("a.csv");
  ASSERT_EQ(lines.size(), values.size() + 1);
  EXPECT_EQ(lines[0], "value");
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(std::strtod(lines[i + 1].c_str(), nullptr), values[i]) << lines[i + 1];
}

TEST(CsvFile, EveryRowIsOnDiskAtOnce)
{
  test::Folder folder;
  CsvFile      csv(folder.path, "a.csv", {"Time [s]", "Force [N]"});
  EXPECT_EQ(folder.text("a.csv"), "Time [s],Force [N]\n");
  csv.row(std::vector<double>{0.025, -1.5});
  EXPECT_EQ(folder.text("a.csv"), "Time [s],Force [N]\n0.025,-1.5\n");
}

TEST(CsvFile, WhatIsNoNumberIsAnEmptyCellAndNotedOnce)
{
  test::Folder       folder;
  const OutputFolder outputs(folder.path);
  CsvFile            csv(outputs, "a.csv", {"Time [s]", "Gearing", "Force [N]"});
  for (const double t : {0., 1.})
    csv.row(std::vector<double>{t, std::numeric_limits<double>::quiet_NaN(), 2});
  EXPECT_EQ(folder.text("a.csv"), "Time [s],Gearing,Force [N]\n0,,2\n1,,2\n");
  EXPECT_EQ(outputs.left_empty(), (std::map<std::string, std::set<std::string>>{{"a.csv", {"Gearing"}}}));
}

TEST(CsvFile, QuotesWhatWouldBreakATable)
{
  test::Folder folder;
  CsvFile      csv(folder.path, "a.csv", {"n", "reason"});
  csv.row(std::vector<std::string>{"1", "det F <= 0, \"cell\" 3"});
  EXPECT_EQ(folder.lines("a.csv")[1], "1,\"det F <= 0, \"\"cell\"\" 3\"");
}

TEST(CsvFile, RefusesARowOfAnotherWidth)
{
  test::Folder folder;
  CsvFile      csv(folder.path, "a.csv", {"a", "b"});
  EXPECT_THROW(csv.row(std::vector<double>{1}), std::logic_error);
}

TEST(CsvFile, SaysWhichFileCannotBeWritten)
{
  test::Folder folder;
  try
    {
      CsvFile csv(folder.path / "missing", "a.csv", {"a"});
      FAIL() << "a file in a missing folder was opened";
    }
  catch (const std::runtime_error &error)
    {
      EXPECT_NE(std::string(error.what()).find("a.csv"), std::string::npos);
    }
}

namespace
{
  Archive with_two_rows(const test::Folder &folder)
  {
    Archive saved;
    CsvFile csv(folder.path, "a.csv", {"Time [s]", "Force [N]"});
    csv.row(std::vector<double>{0, 1});
    csv.row(std::vector<double>{1, 2});
    csv.save(saved);
    csv.row(std::vector<double>{2, 3}); // after it was saved: lost to whoever resumes
    return saved;
  }

  /// What with_two_rows() saved, with a file that is as long but says something else.
  Archive with_another_digit(const test::Folder &folder)
  {
    const Archive saved = with_two_rows(folder);
    require_tables(folder.path, saved);
    std::string text           = folder.text("a.csv");
    text[text.find("0,1") + 2] = '7';
    std::ofstream(folder.path / "a.csv", std::ios::binary) << text;
    return saved;
  }
} // namespace

TEST(CsvFile, AResumedRunGoesOnWhereItWasSaved)
{
  test::Folder  folder;
  const Archive saved = with_two_rows(folder);
  CsvFile       csv(OutputFolder(folder.path, &saved), "a.csv", {"Time [s]", "Force [N]"});
  csv.row(std::vector<double>{2, 30});
  EXPECT_EQ(folder.text("a.csv"), "Time [s],Force [N]\n0,1\n1,2\n2,30\n");
  CsvFile fresh(OutputFolder(folder.path, &saved), "b.csv", {"Time [s]"});
  EXPECT_EQ(folder.text("b.csv"), "Time [s]\n") << "a file that was not saved begins anew";
}

TEST(CsvFile, AResumedRunRefusesAFileThatIsNotAsItWas)
{
  test::Folder  folder;
  const Archive saved = with_two_rows(folder);
  const auto    again = [&](const std::vector<std::string> &columns) { CsvFile(OutputFolder(folder.path, &saved), "a.csv", columns); };
  EXPECT_THROW(again({"Time [s]", "Force [kN]"}), InputError);
  EXPECT_THROW(require_tables(folder.path, with_another_digit(folder)), InputError);
  std::filesystem::resize_file(folder.path / "a.csv", 25);
  EXPECT_THROW(again({"Time [s]", "Force [N]"}), InputError);
  std::filesystem::remove(folder.path / "a.csv");
  EXPECT_THROW(again({"Time [s]", "Force [N]"}), InputError);
}

TEST(TextFile, ReplacesAndLeavesNothingBehind)
{
  test::Folder folder;
  replace_file(folder.path / "x.txt", "first, longer text");
  replace_file(folder.path / "x.txt", "second");
  EXPECT_EQ(folder.text("x.txt"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
}
