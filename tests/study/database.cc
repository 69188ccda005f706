// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../cli/program_runner.h"

#include <myolines/base/error.h>
#include <myolines/study/database.h>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <random>

#include <sys/resource.h>

using namespace myolines;
using namespace myolines::study;

TEST(StudyDatabase, KeepsOutcomesExactlyAndOnce)
{
  const TestFolder folder;
  study::Outcome   outcome;
  outcome.name         = "step=0.1";
  outcome.status       = "done";
  outcome.scene        = "<a value=\"'\xc3\xa9\"/>\n";
  outcome.cpu_seconds  = 0.1;
  outcome.wall_seconds = 1. / 3;
  {
    Database database(folder / "study.sqlite");
    database.store({outcome});
    outcome.wall_seconds = 2. / 3;
    outcome.cpu_seconds.reset();
    database.store({outcome}); // replaces the row
  }
  const auto known = Database(folder / "study.sqlite").outcomes();
  ASSERT_EQ(known.size(), 1u);
  EXPECT_EQ(known.at("step=0.1").scene, outcome.scene);
  EXPECT_EQ(known.at("step=0.1").wall_seconds, 2. / 3);
  EXPECT_FALSE(known.at("step=0.1").cpu_seconds.has_value());
}

/// All results or those before: a row that is there twice ends the transaction.
TEST(StudyDatabase, AFailedTransactionChangesNothing)
{
  const TestFolder folder;
  Database         database(folder / "study.sqlite");
  database.replace_results({{"a", "error", 1., ""}});
  EXPECT_THROW(database.replace_results({{"b", "error", 1., ""}, {"b", "error", 2., ""}}), std::runtime_error);
  database.replace_results({{"a", "error", 1., ""}}); // still usable
}

TEST(StudyDatabase, RefusesOtherFiles)
{
  const TestFolder folder;
  EXPECT_THROW(
      Database(folder.write("text.sqlite", "This is no database, but it is long enough to be taken for the head of one, or is it?")),
      InputError);
  EXPECT_THROW(Database(folder / "no folder/study.sqlite"), SystemError);
}

namespace
{
  /// Files of this process may not be longer than so many bytes, as on a disk that is full.
  class ShortFiles
  {
  public:
    explicit ShortFiles(const rlim_t bytes)
      : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
      getrlimit(RLIMIT_FSIZE, &before_);
      const rlimit limit{bytes, before_.rlim_max};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~ShortFiles()
    {
      setrlimit(RLIMIT_FSIZE, &before_);
      std::signal(SIGXFSZ, handler_);
    }
    ShortFiles(const ShortFiles &)            = delete;
    ShortFiles &operator=(const ShortFiles &) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
  };
} // namespace

/// In its words, with the file that it refused, though SQLite rolls back before it answers; what was there stays.
TEST(StudyDatabase, TellsWhatTheSystemRefused)
{
  const TestFolder folder;
  const auto       file = folder / "study.sqlite";
  Database         database(file);
  study::Outcome   outcome;
  outcome.name   = "step=0.1";
  outcome.status = "done";
  database.store({outcome});
  try
    {
      const ShortFiles limit(16384);
      outcome.scene = std::string(100000, 's');
      database.store({outcome});
      FAIL();
    }
  catch (const SystemError &error)
    {
      EXPECT_EQ(error.error_number(), EFBIG);
      EXPECT_EQ(std::string(error.what()), "cannot write " + file.string() + ": " + std::strerror(EFBIG));
    }
  EXPECT_EQ(database.outcomes().at("step=0.1").scene, "");
  database.store({outcome});
  EXPECT_EQ(Database(file).outcomes().at("step=0.1").scene, outcome.scene);
}

namespace
{
  /// Changes the database behind its back.
  void execute(const std::filesystem::path &file, const char *sql)
  {
    sqlite3 *handle = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &handle), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(handle);
    sqlite3_close(handle);
  }
} // namespace

TEST(StudyDatabase, RefusesOneThatIsNotAsItWas)
{
  for (const char *sql : {"ALTER TABLE cases DROP COLUMN ledger", "DROP TABLE results", "ALTER TABLE results ADD COLUMN more TEXT",
                          "ALTER TABLE cases RENAME COLUMN status TO state", "PRAGMA user_version = 7"})
    {
      const TestFolder folder;
      const auto       file = folder / "study.sqlite";
      Database{file};
      execute(file, sql);
      EXPECT_THROW(Database{file}, InputError) << sql;
    }
}

TEST(StudyDatabase, RefusesValuesThatWereChanged)
{
  const TestFolder folder;
  const auto       file = folder / "study.sqlite";
  study::Outcome   outcome;
  outcome.name         = "step=0.1";
  outcome.status       = "failed";
  outcome.scene        = std::string(300, 's');
  outcome.cpu_seconds  = 0.1;
  outcome.wall_seconds = 0.2;
  Database(file).store({outcome});
  const std::string whole = contents(file);
  for (const char *sql : {"UPDATE cases SET status = 'done'", "UPDATE cases SET wall_seconds = 0.3", "UPDATE cases SET cpu_seconds = NULL"})
    {
      std::ofstream(file, std::ios::binary) << whole;
      execute(file, sql);
      EXPECT_THROW(Database(file).outcomes(), InputError) << sql;
    }
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i)
    {
      std::string damaged = whole;
      damaged[random() % whole.size()] ^= static_cast<char>(1 << random() % 8);
      std::ofstream(file, std::ios::binary) << damaged;
      try
        {
          for (const auto &[name, found] : Database(file).outcomes())
            EXPECT_TRUE(name == outcome.name && found.status == outcome.status && found.scene == outcome.scene &&
                        found.cpu_seconds == outcome.cpu_seconds && found.wall_seconds == outcome.wall_seconds);
        }
      catch (const InputError &)
        {}
    }
}

TEST(StudyDatabase, RefusesDamagedPages)
{
  const TestFolder folder;
  const auto       file = folder / "study.sqlite";
  {
    Database                    database(file);
    std::vector<study::Outcome> many;
    for (int i = 0; i < 200; ++i)
      {
        study::Outcome outcome;
        outcome.name   = "case " + std::to_string(i);
        outcome.status = "done";
        outcome.scene  = std::string(500, 'x');
        many.push_back(outcome);
      }
    database.store(many);
  }
  std::string whole = contents(file);
  ASSERT_GT(whole.size(), 40960u);
  for (std::size_t page = 1; page < 10; ++page)
    {
      std::string damaged = whole;
      std::fill(damaged.begin() + 4096 * page, damaged.begin() + 4096 * page + 512, '\x7f');
      std::ofstream(file, std::ios::binary) << damaged;
      EXPECT_THROW(Database{file}, InputError) << "page " << page;
    }
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_THROW(Database{file}, InputError) << "cut off";
}
