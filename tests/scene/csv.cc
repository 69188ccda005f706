// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables that a person gives.
#include "../support/temporary.h"

#include <myolines/base/error.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/csv.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace myolines;
using namespace myolines::scene;

namespace
{
  class CsvInput : public ::testing::Test
  {
  protected:
    const std::filesystem::path file_ = test::temporary("csv_input.csv");

    void TearDown() override { std::filesystem::remove(file_); }

    CsvTable read(const std::string &text) const
    {
      std::ofstream(file_) << text;
      return read_csv_input(file_);
    }
  };

  TEST_F(CsvInput, LeavesOutWhiteSpaceAndEmptyLines)
  {
    const CsvTable table = read(" a , \"b, c\"\r\n1, 2\n\n3 ,4");
    EXPECT_EQ(table.header, (std::vector<std::string>{"a", "b, c"}));
    EXPECT_EQ(table.numbers(0), (std::vector<double>{1, 3}));
    EXPECT_EQ(table.numbers(table.required_column("b, c")), (std::vector<double>{2, 4}));
    EXPECT_NE(table.where(1).find("line 4"), std::string::npos);
  }

  /// As the program reads what it, or one that was killed, has written.
  TEST_F(CsvInput, OfTheProgramMayEndInTheMiddleOfALine)
  {
    std::ofstream(file_) << "a,b\n1,2\n3,";
    const auto table = read_csv(file_);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->numbers(0), (std::vector<double>{1}));
    std::ofstream(file_) << "a,b\n1,2\n3\n";
    EXPECT_FALSE(read_csv(file_)) << "a whole line that has too few fields";
    EXPECT_FALSE(read_csv(test::temporary("no table")));
    EXPECT_FALSE(read_csv(file_.parent_path())) << "a folder is no table";
  }

  TEST_F(CsvInput, ReadsWordsBesideNumbers)
  {
    const CsvTable table = read("a,name\n1,x\n2,y\n");
    EXPECT_EQ(table.numbers(0), (std::vector<double>{1, 2}));
    EXPECT_THROW(table.numbers(1), InputError);
    EXPECT_FALSE(table.column("b"));
    EXPECT_THROW(table.required_column("b"), InputError);
  }

  TEST_F(CsvInput, ReadsSemicolonsTabsAndDecimalCommas)
  {
    for (const char *text : {"a;b c\n0,5;-1,5e-3\n1;2,25\n", "a\tb c\n0,5\t-1,5e-3\n1\t2,25\t\n", "a,b c\n0.5,-1.5e-3\n1,2.25,\n",
                             "\xEF\xBB\xBF\"a\";\"b c\";\r\n0.5;-1.5e-3;\r\n;;\r\n1;2.25;\r\n"})
      {
        const CsvTable table = read(text);
        EXPECT_EQ(table.header, (std::vector<std::string>{"a", "b c"})) << text;
        EXPECT_EQ(table.numbers(0), (std::vector<double>{0.5, 1})) << text;
        EXPECT_EQ(table.numbers(1), (std::vector<double>{-1.5e-3, 2.25})) << text;
      }
    EXPECT_EQ(read("Zeit [s];Kraft, links\n0,5;2\n").header[1], "Kraft, links");
  }

  TEST_F(CsvInput, ReadsLineEndsAndHeadsOfSpreadsheets)
  {
    for (const char *text : {"t,x\r0,1\r0.1,2\r", "sep=;\r\nt;x\r\n0;1\r\n0,1;2\r\n", "t,x\n# begins\n0,1\n  # goes on\n0.1,2\n"})
      {
        const CsvTable table = read(text);
        EXPECT_EQ(table.header, (std::vector<std::string>{"t", "x"})) << text;
        EXPECT_EQ(table.numbers(0), (std::vector<double>{0, 0.1})) << text;
        EXPECT_EQ(table.numbers(1), (std::vector<double>{1, 2})) << text;
      }
    EXPECT_NE(read("t,x\n# begins\n0,1\n").where(0).find("line 3"), std::string::npos);
  }

  TEST_F(CsvInput, SkipsCommentsAndHeadersInFront)
  {
    EXPECT_EQ(read("sep=;\r\na;b\r\n1;2\r\n").header, (std::vector<std::string>{"a", "b"})) << "as spreadsheets write it";
    const CsvTable commented = read("# recorded\n% by hand\n\nt,x\n0,1\n0.1,\n");
    EXPECT_EQ(commented.header, (std::vector<std::string>{"t", "x"}));
    EXPECT_NE(commented.where(1).find("line 6"), std::string::npos);
    for (const char *separator : {"\t", "   "})
      {
        const std::string between = separator;
        const CsvTable storage = read("Controls, of a model\nversion=1\nnRows=2\nEndHeader\ntime" + between + "soleus_r\n  0.00" + between +
                                      "  0.1\n  0.01" + between + "  0.2\n");
        EXPECT_EQ(storage.header, (std::vector<std::string>{"time", "soleus_r"}));
        EXPECT_EQ(storage.numbers(1), (std::vector<double>{0.1, 0.2}));
        EXPECT_NE(storage.where(0).find("line 6"), std::string::npos);
      }
  }

  TEST_F(CsvInput, AHeaderThatAnnouncesAnotherSizeIsRefused)
  {
    const auto complaint = [this](const std::string &header) -> std::string {
      try
        {
          read(header + "endheader\ntime\tsoleus_r\n0.00\t0.1\n0.01\t0.2\n0.02\t0.3\n");
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "";
    };
    for (const char *right : {"", "nRows=3\nnColumns=2\n", "datarows 3\ndatacolumns 2\n", "nRows = 3\n", "name nRows=7\n"})
      EXPECT_EQ(complaint(right), "") << right;
    for (const char *rows : {"nRows=4\n", "datarows 2\n", "nRows=0\nnColumns=2\n"})
      EXPECT_NE(complaint(rows).find(" rows, there are 3"), std::string::npos) << rows << complaint(rows);
    for (const char *columns : {"nRows=3\nnColumns=1\n", "datacolumns 3\n"})
      EXPECT_NE(complaint(columns).find(" columns, there are 2"), std::string::npos) << columns << complaint(columns);
    EXPECT_NE(complaint("inDegrees=perhaps\n").find("line 1: \"perhaps\" after \"inDegrees\""), std::string::npos);
    EXPECT_NE(complaint("nRows=many\n").find("line 1: \"many\" after \"nRows\""), std::string::npos);
  }

  TEST_F(CsvInput, ALineOfUnitsBelongsToTheNames)
  {
    using Names = std::vector<std::string>;
    for (const char *text : {"t;x;note\nms;%;\n5;50;1\n", "t,x,note\n[ms],(%),\n5,50,1\n"})
      {
        const CsvTable table = read(text);
        EXPECT_EQ(table.header, (Names{"t [ms]", "x [%]", "note"})) << text;
        EXPECT_EQ(table.numbers(0), std::vector<double>{5}) << text;
        EXPECT_NE(table.where(0).find("line 3"), std::string::npos) << text;
      }
    for (const char *text : {"t,x\n-,-\n", "t,x\ns,furlong\n", "t [s],x\ns,m\n", "t,x\ns,1\n"})
      EXPECT_EQ(read(text).rows.size(), 1u) << text;
  }

  TEST_F(CsvInput, AQuotationMarkThatNoneEndsLosesNothing)
  {
    for (const char *text : {"t,x\n0,1\n1,\"2\n2,3\n", "t,\"x\n0,1\n1,2\n", "t,x\n0,1\n\"1\",\"\"2\"\n"})
      EXPECT_THROW(read(text), InputError) << text;
    try
      {
        read("t,x\n0,1\n1,\"2\n2,3\n");
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("line 3: a quotation mark begins there"), std::string::npos) << error.what();
      }
  }

  TEST_F(CsvInput, MarksBetweenThousandsAreNoNumbers)
  {
    for (const char *text : {"t,x\n0,\"1,234.5\"\n", "t;x\n0;1.234,5\n", "t,x\n0,1'234\n", "t,x\n0,12 %\n"})
      {
        const CsvTable table = read(text);
        try
          {
            table.numbers(1);
            ADD_FAILURE() << text;
          }
        catch (const InputError &error)
          {
            EXPECT_NE(std::string(error.what()).find("marks between thousands"), std::string::npos) << error.what();
          }
      }
  }

  TEST_F(CsvInput, WhatMayBeReadInSeveralWaysIsRefused)
  {
    const auto complaint = [this](const std::string &text) -> std::string {
      try
        {
          read(text);
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "accepted";
    };
    EXPECT_NE(complaint("a,b;c\n1;2;3\n").find("separated by commas, semicolons or tabs"), std::string::npos);
    EXPECT_NE(complaint("a,b\n0,5,1,5\n").find("decimal commas"), std::string::npos);
    EXPECT_NE(complaint("a;b\n0,5;1\n1.5;2\n").find("line 2: has a decimal comma, and line 3 a decimal point"), std::string::npos);
    EXPECT_NE(complaint("0.0,1\n0.1,2\n").find("Time [s]"), std::string::npos);
    EXPECT_NE(complaint("0,0;1\n0,1;2\n").find("where the names"), std::string::npos);
  }

  TEST_F(CsvInput, NamesMeanColumnsWithoutUnitsAndCase)
  {
    const CsvTable table = read("Time [ms],length (mm),Force,force [N],x [m],x [mm]\n0,1,2,3,4,5\n");
    EXPECT_EQ(table.required_column("time"), 0u);
    EXPECT_EQ(table.required_column("length [m]"), 1u);
    EXPECT_EQ(table.required_column("Force"), 2u);
    EXPECT_EQ(table.required_column("force"), 3u); // without its unit
    EXPECT_EQ(table.required_column("x [mm]"), 5u);
    EXPECT_THROW(table.required_column("x"), InputError);
    EXPECT_THROW(table.required_column("FORCE"), InputError);
    try
      {
        table.required_column("lenght");
        ADD_FAILURE();
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("nearest valid name: \"length\""), std::string::npos) << error.what();
      }
  }

  TEST(Columns, UnitsAreConverted)
  {
    EXPECT_EQ(split_column_name("lumbar length [mm] ").quantity, "lumbar length");
    EXPECT_EQ(split_column_name("share (%)").unit, "%");
    EXPECT_EQ(split_column_name("plain").unit, "");
    EXPECT_DOUBLE_EQ(*unit_factor("mm", "m"), 1e-3);
    EXPECT_DOUBLE_EQ(*unit_factor("mm/s", "m/s"), 1e-3);
    EXPECT_DOUBLE_EQ(*unit_factor("kN", "N"), 1e3);
    EXPECT_DOUBLE_EQ(*unit_factor("%", "-"), 1e-2);
    EXPECT_DOUBLE_EQ(*unit_factor("%MVC", "-"), 1e-2);
    EXPECT_DOUBLE_EQ(*unit_factor("s", "ms"), 1e3);
    EXPECT_EQ(unit_factor("a.u.", "a.u."), 1.);
    EXPECT_FALSE(unit_factor("N", "m"));
    EXPECT_FALSE(unit_factor("a.u.", "-"));
  }

  TEST_F(CsvInput, WhatIsNoTableIsRefused)
  {
    EXPECT_THROW(read("a,b\n1\n"), InputError);
    EXPECT_THROW(read(""), InputError);
    EXPECT_THROW(read_csv_input("there_is_no_such_file.csv"), InputError);
  }
} // namespace
