// Tables that a person gives.
#include "../support/temporary.h"

#include <myolines/base/error.h>
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

  TEST_F(CsvInput, ReadsWordsBesideNumbers)
  {
    const CsvTable table = read("a,name\n1,x\n2,y\n");
    EXPECT_EQ(table.numbers(0), (std::vector<double>{1, 2}));
    EXPECT_THROW(table.numbers(1), InputError);
    EXPECT_FALSE(table.column("b"));
    EXPECT_THROW(table.required_column("b"), InputError);
  }

  TEST_F(CsvInput, WhatIsNoTableIsRefused)
  {
    EXPECT_THROW(read("a,b\n1\n"), InputError);
    EXPECT_THROW(read(""), InputError);
    EXPECT_THROW(read_csv_input("there_is_no_such_file.csv"), InputError);
  }
} // namespace
