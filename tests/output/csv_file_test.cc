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

TEST(TextFile, ReplacesAndLeavesNothingBehind)
{
  test::Folder folder;
  replace_file(folder.path / "x.txt", "first, longer text");
  replace_file(folder.path / "x.txt", "second");
  EXPECT_EQ(folder.text("x.txt"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
}
