#include "../cli/program_runner.h"

#include <myolines/base/error.h>
#include <myolines/study/database.h>

#include <gtest/gtest.h>

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
  EXPECT_THROW(Database(folder / "no folder/study.sqlite"), InputError);
}
