// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/temporary.h"

#include <myolines/algebra/shared_file.h>

#include <gtest/gtest.h>

#include <cerrno>

namespace myolines
{
  namespace
  {
    TEST(SharedFile, IsWhatWasPutAtItsPlaces)
    {
      const auto path = test::temporary("shared");
      std::filesystem::remove(path);
      {
        SharedFile file(path, MPI_COMM_WORLD, SharedFile::Mode::write_anew);
        file.write_pieces({{0, "head"}, {20, "tail"}}, 24);
        file.write(4, std::vector<double>{1, 2});
        file.sync();
        EXPECT_FALSE(std::filesystem::exists(path)) << "half a file has another name";
        file.close();
      }
      EXPECT_FALSE(std::filesystem::exists(unfinished(path)));
      const SharedFile    file(path, MPI_COMM_WORLD, SharedFile::Mode::read);
      std::vector<double> numbers(2);
      std::string         tail(4, ' ');
      EXPECT_TRUE(file.read(4, numbers));
      EXPECT_EQ(numbers, (std::vector<double>{1, 2}));
      EXPECT_TRUE(file.read(20, tail));
      EXPECT_EQ(tail, "tail");
      EXPECT_FALSE(file.read(16, numbers)) << "the file ends before";
      EXPECT_EQ(std::filesystem::file_size(path), 24u);
    }

    TEST(SharedFile, LongPathsAndRefusals)
    {
      auto folder = test::temporary("long");
      while (folder.string().size() < 1000)
        folder /= std::string(200, 'p');
      std::filesystem::create_directories(folder);
      {
        SharedFile file(folder / "file", MPI_COMM_WORLD, SharedFile::Mode::write_anew);
        file.write(0, std::vector<double>{1});
        file.close();
      }
      EXPECT_EQ(std::filesystem::file_size(folder / "file"), 8u);
      try
        {
          SharedFile(folder / "none" / "file", MPI_COMM_WORLD, SharedFile::Mode::write_anew);
          FAIL();
        }
      catch (const SystemError &error)
        {
          EXPECT_EQ(error.error_number(), ENOENT);
          EXPECT_NE(std::string(error.what()).find("none/file.new: No such file or directory"), std::string::npos) << error.what();
        }
    }
  } // namespace
} // namespace myolines
