// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: a folder belongs to one run at a time; what a run did not write is never removed or overwritten.

#include <myolines/base/error.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/manifest.h>
#include <myolines/output/run_folder.h>

#include "../support/complaint.h"
#include "folder.h"

#include <sys/wait.h>

using namespace myolines;

namespace
{
  using test::complaint;

  /// A run that writes the table @p name, as the program would.
  void run(const std::filesystem::path &folder, const std::string &scene, const std::string &name, const bool overwrite = false)
  {
    const RunFolder    place(folder);
    const OutputFolder outputs = place.begin(scene, overwrite, {"", scene, "", "", {}});
    outputs.note("fields-*.vtu");
    std::ofstream(folder / "fields-0012.vtu") << "field";
    CsvFile(outputs, name, {"Time [s]"}).row(std::vector<double>{1});
    write_manifest(outputs, {"", scene, "", "", {}}, "done");
  }

  bool is_in(const test::Folder &folder, const std::string &name) { return std::filesystem::exists(folder.path / name); }
} // namespace

TEST(RunFolder, OldResultsOfTheSameSceneGiveWay)
{
  test::Folder folder;
  run(folder.path, "scene", "shape.csv");
  std::filesystem::create_directories(folder.path / "pictures");
  std::ofstream(folder.path / "pictures/shape.png") << "picture";
  std::ofstream(folder.path / "pictures/mine.png") << "picture";
  std::ofstream(folder.path / "notes.txt") << "mine";
  list_in_manifest(folder.path, {"pictures/shape.png"});
  run(folder.path, "scene", "strain.csv");
  EXPECT_FALSE(is_in(folder, "shape.csv"));
  EXPECT_FALSE(is_in(folder, "pictures/shape.png"));
  EXPECT_TRUE(is_in(folder, "strain.csv"));
  EXPECT_TRUE(is_in(folder, "notes.txt"));
  EXPECT_TRUE(is_in(folder, "pictures/mine.png"));
  EXPECT_TRUE(run_is_done(folder.path));
}

TEST(RunFolder, ResultsOfAnotherSceneAreNotRemovedUnasked)
{
  test::Folder folder;
  run(folder.path, "scene", "shape.csv");
  EXPECT_NE(complaint([&] { run(folder.path, "other scene", "shape.csv"); }).find("--overwrite"), std::string::npos);
  EXPECT_TRUE(is_in(folder, "shape.csv"));
  run(folder.path, "other scene", "strain.csv", true);
  EXPECT_FALSE(is_in(folder, "shape.csv"));
}

TEST(RunFolder, OldResultsThatTheRunReadsStay)
{
  test::Folder folder;
  run(folder.path, "scene", "strain.csv");
  const RunFolder place(folder.path);
  for (const bool overwrite : {false, true})
    for (const char *scene : {"scene", "other scene"})
      {
        const RunRecord   record{"", scene, "", "", {{(folder.path / "." / "strain.csv").string(), "checksum"}}, {}};
        const std::string told = complaint([&] { place.begin(scene, overwrite, record); });
        EXPECT_NE(told.find("reads the file strain.csv there"), std::string::npos) << told;
      }
  EXPECT_TRUE(is_in(folder, "strain.csv"));
}

TEST(RunFolder, FilesOfOthersAreLeftAlone)
{
  test::Folder folder;
  for (const char *foreign : {"strain.csv", "fields-0003.vtu", "scene.resolved.xml", "checkpoint", "run.log"})
    {
      std::ofstream(folder.path / foreign) << "mine";
      const std::string told = complaint([&] { run(folder.path, "scene", "strain.csv", true); });
      EXPECT_NE(told.find(foreign), std::string::npos) << told;
      EXPECT_EQ(folder.text(foreign), "mine");
      for (const auto &entry : std::filesystem::directory_iterator(folder.path))
        std::filesystem::remove_all(entry.path());
    }
  std::ofstream(folder.path / "manifest.json") << R"({"name": "my web app"})";
  EXPECT_NE(complaint([&] { run(folder.path, "scene", "strain.csv", true); }).find("manifest.json"), std::string::npos);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1) << "nothing was written there";
}

/// A link with the name of the lock may lead to anything.
TEST(RunFolder, TheLockIsNoLink)
{
  test::Folder folder;
  const auto   results = folder.path / "results";
  std::ofstream(folder.path / "precious.txt") << "mine";
  std::filesystem::create_directories(results);
  std::filesystem::create_symlink(folder.path / "precious.txt", results / "run.lock");
  EXPECT_NE(complaint([&] { run(results, "scene", "strain.csv"); }).find("run.lock"), std::string::npos);
  EXPECT_EQ(folder.text("precious.txt"), "mine");
}

TEST(RunFolder, HasOneRunAtATime)
{
  test::Folder folder;
  {
    const RunFolder first(folder.path);
    EXPECT_NE(complaint([&] { RunFolder second(folder.path); }).find("another run is running here"), std::string::npos);
  }
  EXPECT_EQ(complaint([&] { RunFolder second(folder.path); }), "");
}

TEST(RunFolder, AFolderThatCannotBeWrittenTellsWhatMendsIt)
{
  test::Folder folder;
  const auto   results = folder.path / "results";
  std::filesystem::create_directories(results);
  std::filesystem::permissions(folder.path, std::filesystem::perms(0755));
  std::filesystem::permissions(results, std::filesystem::perms(0555));
  int told[2];
  ASSERT_EQ(pipe(told), 0);
  const pid_t child = fork();
  if (child == 0)
    {
      (void) !setuid(getuid() == 0 ? 65534 : getuid()); // the administrator may write everywhere
      const std::string text = complaint([&] { const FileLock lock(results / "run.lock", FileLock::Kind::exclusive, "another run"); });
      (void) !write(told[1], text.data(), text.size());
      _exit(0);
    }
  close(told[1]);
  std::string text(2000, ' ');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(told[0], text.data(), text.size()))));
  close(told[0]);
  waitpid(child, nullptr, 0);
  EXPECT_NE(text.find("chmod u+w \"" + results.string() + "\""), std::string::npos) << text;
  EXPECT_EQ(text.find("wait"), std::string::npos) << text;
  std::filesystem::permissions(results, std::filesystem::perms(0755));
}

TEST(RunFolder, TheLockOfAKilledRunDoesNotStay)
{
  test::Folder folder;
  int          ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0)
    {
      const FileLock lock(folder.path / "run.lock", FileLock::Kind::exclusive, "another run");
      (void) !write(ready[1], "x", 1);
      pause();
      _exit(0);
    }
  char byte;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_NE(complaint([&] { RunFolder second(folder.path); }), "");
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(complaint([&] { RunFolder second(folder.path); }), "");
}

TEST(RunFolder, APathThatLeavesNoRoomForNamesIsRefused)
{
  std::string path = "/tmp";
  while (path.size() < 4060)
    path += "/" + std::string(200, 'a');
  EXPECT_NE(complaint([&] { RunFolder folder(path); }), "");
}

TEST(OutputFolder, AStarStandsForANumber)
{
  EXPECT_TRUE(matches("fields-0012.vtu", "fields-*.vtu"));
  EXPECT_TRUE(matches("fields_0012.1.vtu", "fields_*.vtu"));
  EXPECT_TRUE(matches("a.csv", "a.csv"));
  EXPECT_FALSE(matches("fields-of-mine.vtu", "fields-*.vtu"));
  EXPECT_FALSE(matches("fields-.vtu", "fields-*.vtu"));
  EXPECT_FALSE(matches("a.csv.old", "a.csv"));
}
