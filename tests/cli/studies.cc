// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: every study of input/ is valid, with all its cases. In this process: each start of the program costs half a second.
#include "../support/places.h"

#include <myolines/cli/program.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

TEST(StudiesOfTheRepository, AreValidWithAllTheirCases)
{
  for (const char *variable : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) // set by MPI, which the tests have started
    unsetenv(variable);
  std::size_t n = 0;
  for (const auto &entry : std::filesystem::directory_iterator(myolines::test::source_folder() + "/input/studies"))
    {
      const std::string    file    = entry.path().string();
      const char *const    words[] = {"myolines", "study", file.c_str(), "--list"};
      int                  argc    = 0;
      char               **argv    = nullptr;
      myolines::MpiSession mpi(argc, argv); // which --list does not start
      testing::internal::CaptureStdout();
      const int         code    = myolines::program(4, words, mpi);
      const std::string printed = testing::internal::GetCapturedStdout();
      EXPECT_EQ(code, 0) << file;
      for (std::size_t at = 0; (at = printed.find("\n  run ", at)) != std::string::npos; ++at)
        ++n;
    }
  EXPECT_GT(n, 200u);
}
