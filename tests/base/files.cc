// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/temporary.h"

#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/base/scratch_folder.h>

#include <gtest/gtest.h>

#include <cerrno>

namespace myolines
{
  namespace
  {
    template <typename Action>
    int refusal_of(const Action &action)
    {
      try
        {
          action();
        }
      catch (const SystemError &error)
        {
          return error.error_number();
        }
      return 0;
    }

    TEST(ScratchFolder, IsItsOwnAndGoes)
    {
      std::filesystem::path first;
      {
        const ScratchFolder one, other;
        first = one.path();
        EXPECT_NE(first, other.path());
        EXPECT_EQ(std::filesystem::status(first).permissions(), std::filesystem::perms::owner_all);
        write_file(first / "file", "text");
      }
      EXPECT_FALSE(std::filesystem::exists(first));
    }

    TEST(File, WritesReadsAndTellsWhy)
    {
      const auto path = test::temporary("file");
      {
        File file(path, File::Mode::write_anew);
        file.write_at(3, "def", 3);
        file.write_at(0, "abc", 3);
        EXPECT_EQ(file.size(), 6u);
        char there[4] = "";
        EXPECT_TRUE(file.read_at(2, there, 3));
        EXPECT_STREQ(there, "cde");
        EXPECT_FALSE(file.read_at(4, there, 3)) << "the file ends before";
        file.resize(4);
        file.sync();
        file.close();
      }
      File(path, File::Mode::append).write("!");
      EXPECT_EQ(read_file(path), "abcd!");
      EXPECT_EQ(refusal_of([] { read_file("/nowhere/at all"); }), ENOENT);
      EXPECT_EQ(refusal_of([] { File("/dev/full", File::Mode::write).write_at(0, "x", 1); }), ENOSPC);
      EXPECT_EQ(refusal_of([] { write_file("/dev/full", "x"); }), ENOSPC);
      EXPECT_TRUE(std::filesystem::exists("/dev/full"));
    }

    /// A reader never sees half of it, and what has another kind than a file stays what it is.
    TEST(File, IsReplacedInOneMove)
    {
      const auto path = test::temporary("replaced"), link = test::temporary("link");
      write_file(path, "before");
      const File reader(path, File::Mode::read);
      write_file(path, "after");
      char there[7] = "";
      EXPECT_TRUE(reader.read_at(0, there, 6));
      EXPECT_STREQ(there, "before") << "whoever has opened it reads on";
      EXPECT_EQ(read_file(path), "after");
      EXPECT_FALSE(std::filesystem::exists(unfinished(path)));

      std::filesystem::remove(link);
      std::filesystem::create_symlink(path, link);
      write_file(link, "through the link");
      EXPECT_TRUE(std::filesystem::is_symlink(link));
      EXPECT_EQ(read_file(path), "through the link");

      std::filesystem::create_directories(unfinished(path)); // in the way
      EXPECT_EQ(refusal_of([&] { write_file(path, "never"); }), EISDIR);
      EXPECT_EQ(read_file(path), "through the link");
      std::filesystem::remove(unfinished(path));
    }

    TEST(File, KnowsItsHoles)
    {
      const auto path = test::temporary("holes");
      File       file(path, File::Mode::write_anew);
      file.resize(1 << 20);
      file.write_at(1 << 19, "x", 1);
      const auto parts = file.written_parts();
      ASSERT_FALSE(parts.empty());
      EXPECT_LE(parts.back().first, std::size_t(1) << 19);
      EXPECT_GT(parts.back().second, std::size_t(1) << 19);
    }

    /// The check value of the standard, and pieces in any division.
    TEST(Checksum, IsThatOfTheStandard)
    {
      Checksum whole;
      whole.add("123456789");
      EXPECT_EQ(whole.text(), "cbf43926");
      EXPECT_EQ(Checksum().text(), "00000000");
      for (std::size_t n = 0; n <= 9; ++n)
        {
          Checksum first, second;
          first.add(std::string("123456789").substr(0, n));
          second.add(std::string("123456789").substr(n));
          first.add_part(second.value(), 9 - n);
          EXPECT_EQ(first.text(), whole.text()) << n;
        }
      write_file(test::temporary("sum"), "123456789");
      EXPECT_EQ(checksum_of_file(test::temporary("sum")), "cbf43926");
    }

    TEST(Utf8, IsToldFromOtherBytes)
    {
      for (const char *good : {"", "plain", "M\xc3\xbcller", "\xe2\x82\xac", "\xf0\x9f\x92\xaa", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"})
        EXPECT_EQ(first_not_utf8(good), std::string::npos) << good;
      // Latin-1, a lone continuation, cut off, overlong, a surrogate, beyond the last character
      for (const char *bad :
           {"ab\xfc"
            "c",
            "ab\x80", "ab\xc3", "ab\xe2\x82", "ab\xc0\xaf", "ab\xe0\x80\xaf", "ab\xed\xa0\x80", "ab\xf4\x90\x80\x80", "ab\xff"})
        EXPECT_EQ(first_not_utf8(bad), 2u) << bad;
    }
  } // namespace
} // namespace myolines
