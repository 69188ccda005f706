// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace myolines::test
{
  /// An empty folder of the running test, removed at its end.
  class Folder
  {
  public:
    Folder()
      : path(std::filesystem::path(::testing::TempDir()) /
             ("myolines_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" + std::to_string(getpid())))
    {
      std::filesystem::remove_all(path);
      std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder &)            = delete;
    Folder &operator=(const Folder &) = delete;

    std::string text(const std::string &file) const
    {
      std::ifstream stream(path / file);
      EXPECT_TRUE(stream.good()) << file;
      return std::string(std::istreambuf_iterator<char>(stream), {});
    }

    std::vector<std::string> lines(const std::string &file) const
    {
      std::istringstream       stream(text(file));
      std::vector<std::string> all;
      for (std::string line; std::getline(stream, line);)
        all.push_back(line);
      return all;
    }

    const std::filesystem::path path;
  };

  /// The numbers of a line of a table.
  inline std::vector<double> numbers(const std::string &line)
  {
    std::vector<double> all;
    std::istringstream  stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
      all.push_back(std::stod(cell));
    return all;
  }
} // namespace myolines::test
