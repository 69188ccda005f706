// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study_files.h"

#include <myolines/base/checksum.h>
#include <myolines/study/processes.h>
#include <myolines/study/runner.h>

#include <gtest/gtest.h>

#include <sys/stat.h>

using namespace myolines::study;
using namespace myolines::testing;

namespace
{
  /// Runs the study with a shell script in the place of the program. Its arguments are those of the command `run`.
  class FakeProgram
  {
  public:
    FakeProgram(const std::string &script, const std::string &more = "")
      : study_(folder_.study(grid("all", listed("step", "time/step", "1 | 2 | 3")), more))
      , cases_(expand(study_))
      , database_(folder_ / "study.sqlite")
    {
      options_.program = folder_.write("fake.sh", "#!/bin/sh\n" + script);
      chmod(options_.program.c_str(), 0755);
      options_.folder      = folder_.path();
      options_.jobs        = 2;
      options_.resolve     = [](const Case &which) { return which.settings.front(); };
      options_.stop_signal = [] { return 0; };
    }

    RunnerReport                                    run() { return run_cases(study_, cases_, database_, options_); }
    std::map<std::string, myolines::study::Outcome> outcomes() const { return database_.outcomes(); }

    RunnerOptions options_;
    StudyFolder   folder_;

  private:
    Study             study_;
    std::vector<Case> cases_;
    Database          database_;
  };
} // namespace

TEST(Runner, EveryWayToEndBecomesARow)
{
  FakeProgram fake("case \"$*\" in\n"
                   "*step=1*) kill -SEGV $$;;\n"
                   "*step=2*) echo 'scene.xml: x: wrong' >&2; echo '  expected: y' >&2; exit 2;;\n"
                   "*) echo \"$*\" > \"$6/arguments\"; exit 0;;\n"
                   "esac\n");
  EXPECT_EQ(fake.run().n_run, 3u);
  const auto outcomes = fake.outcomes();
  EXPECT_EQ(outcomes.at("step=1").status, "crashed");
  EXPECT_NE(outcomes.at("step=1").reason.find("signal 11"), std::string::npos);
  EXPECT_EQ(outcomes.at("step=2").status, "refused");
  EXPECT_EQ(outcomes.at("step=2").reason, "scene.xml: x: wrong; expected: y");
  EXPECT_EQ(outcomes.at("step=3").status, "done");
  const std::string folder = case_folder(fake.folder_.path(), "step=3").string();
  EXPECT_EQ(contents(folder + "/arguments"),
            "run " + (fake.folder_ / "scene.xml").string() + " --set time/step=3 --out " + folder + " --quiet\n");
  EXPECT_GT(outcomes.at("step=3").cpu_seconds.value(), 0);
}

TEST(Runner, KnownCasesAreNotRunAgainUnlessTheyChange)
{
  FakeProgram fake("");
  fake.options_.program =
      fake.folder_.write("counting.sh", "#!/bin/sh\necho \"$*\" >> " + (fake.folder_ / "runs").string() + "\n[ $4 != time/step=2 ]\n");
  chmod(fake.options_.program.c_str(), 0755);
  const auto n_runs = [&] {
    const std::string text = contents(fake.folder_ / "runs");
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(fake.run().n_known, 0u);
  EXPECT_EQ(fake.run().n_known, 3u);
  EXPECT_EQ(n_runs(), 3);
  fake.options_.retry = true;
  EXPECT_EQ(fake.run().n_run, 1u); // the one that did not end well
  fake.options_.retry   = false;
  fake.options_.resolve = [](const Case &which) { return which.settings.front() == "time/step=1" ? "other" : which.settings.front(); };
  EXPECT_EQ(fake.run().n_run, 1u); // its scene is another one now
  std::filesystem::remove_all(case_folder(fake.folder_.path(), "step=3"));
  EXPECT_EQ(fake.run().n_run, 1u); // its results are gone
  EXPECT_EQ(n_runs(), 6);
}

TEST(Runner, CasesAreRunAgainWhenAFileThatTheyReadHasChanged)
{
  FakeProgram       fake("");
  const std::string data = fake.folder_.write("data.csv", "0, 1\n").string(), plugin = fake.folder_.write("mine.so", "one").string();
  const std::string scene    = (fake.folder_ / "scene.xml").string(); // whose lines may be others, as long as it resolves to the same
  const std::string manifest = R"({"inputs": {")" + data + R"(": ")" + myolines::checksum_of_file(data) + R"(", ")" + plugin + R"(": ")" +
                               myolines::checksum_of_file(plugin) + R"(", ")" + scene + R"(": "0"}})";
  fake.options_.program = fake.folder_.write("reading.sh", "#!/bin/sh\necho '" + manifest + "' > \"$6/manifest.json\"\n");
  chmod(fake.options_.program.c_str(), 0755);
  EXPECT_EQ(fake.run().n_run, 3u);
  EXPECT_EQ(fake.run().n_run, 0u);
  fake.folder_.write("data.csv", "0, 2\n");
  EXPECT_EQ(fake.run().n_run, 3u);
  fake.folder_.write("data.csv", "0, 1\n");
  EXPECT_EQ(fake.run().n_run, 0u);
  std::filesystem::create_directory(fake.folder_ / "rebuilt");
  fake.options_.plugins = {fake.folder_.write("rebuilt/mine.so", "another")};
  EXPECT_EQ(fake.run().n_run, 3u);
  std::filesystem::remove(data); // of a file that is gone nothing is known
  fake.options_.plugins.clear();
  EXPECT_EQ(fake.run().n_run, 0u);
}

TEST(Runner, AFolderOfOthersInThePlaceOfACaseIsLeftAlone)
{
  FakeProgram fake("exit 0\n");
  const auto  folder = case_folder(fake.folder_.path(), "step=2");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "thesis.tex") << "mine";
  EXPECT_THROW(fake.run(), myolines::InputError);
  EXPECT_EQ(contents(folder / "thesis.tex"), "mine");
}

TEST(Runner, NoMoreJobsThanThereIsRoomFor)
{
  FakeProgram  fake("exit 0\n");
  unsigned int asked         = 0;
  fake.options_.fitting_jobs = [&asked](const unsigned int jobs) {
    asked = jobs;
    return 1u;
  };
  EXPECT_EQ(fake.run().n_run, 3u);
  EXPECT_EQ(asked, 2u);
  EXPECT_NE(contents(fake.folder_ / "study.log").find("at most 1 at a time"), std::string::npos);
}

TEST(Runner, TimeOutsAndBudgets)
{
  FakeProgram late("case \"$*\" in *step=2*) exec sleep 60;; esac\n", section("budget", parameter("case", "0.3", "double")));
  EXPECT_EQ(late.run().n_run, 3u);
  EXPECT_EQ(late.outcomes().at("step=2").status, "timed out");
  EXPECT_EQ(late.outcomes().at("step=2").reason, "not done after 0.3 s");

  FakeProgram        long_study("exec sleep 60\n", section("budget", parameter("total", "0.3", "double")));
  const RunnerReport report = long_study.run();
  EXPECT_EQ(report.n_open, 3u);
  EXPECT_NE(report.why_open.find("budget"), std::string::npos);
  EXPECT_TRUE(long_study.outcomes().empty()); // what was stopped is no result
}

/// Stopped runs go on from their checkpoint if the study says so and the scene is still the same; their CPU seconds are not known.
TEST(Runner, InterruptedCasesResume)
{
  const std::string script       = "touch \"$6/checkpoint\"; printf %s \"$4\" > \"$6/scene.resolved.xml\"\n"
                                   "echo '{\"program\": \"myolines\", \"exit reason\": \"running\"}' > \"$6/manifest.json\"\n"
                                   "case \"$*\" in *--resume*) exit 0;; *) exec sleep 60;; esac\n";
  const std::string short_budget = section("budget", parameter("total", "0.3", "double"));
  FakeProgram       resumes(script, parameter("interrupted cases", "resume") + short_budget);
  resumes.options_.jobs = 3;
  EXPECT_EQ(resumes.run().n_open, 3u);
  EXPECT_EQ(resumes.run().n_run, 3u);
  EXPECT_FALSE(resumes.outcomes().at("step=1").cpu_seconds.has_value());
  EXPECT_NE(resumes.outcomes().at("step=1").command.find("--resume"), std::string::npos);

  FakeProgram restarts(script, short_budget);
  EXPECT_EQ(restarts.run().n_open, 3u);
  EXPECT_EQ(restarts.run().n_open, 3u);
}

TEST(Runner, AsManyAtATimeAsToldAndStopsAtASignal)
{
  FakeProgram fake("exec sleep 60\n");
  int         looks         = 0;
  fake.options_.jobs        = 1;
  fake.options_.stop_signal = [&looks] { return ++looks > 2 ? 15 : 0; };
  const RunnerReport report = fake.run();
  EXPECT_EQ(report.why_open, "signal 15");
  EXPECT_EQ(report.n_open, 3u);
  EXPECT_TRUE(std::filesystem::exists(case_folder(fake.folder_.path(), "step=1")));
  EXPECT_FALSE(std::filesystem::exists(case_folder(fake.folder_.path(), "step=2")));
}

/// Children neither hear of the MPI job of this process nor outlive it.
TEST(Processes, EnvironmentIsThatOfTheStart)
{
  const StudyFolder folder;
  setenv("MYOLINES_SET_LATER", "1", 1);
  Processes processes;
  processes.start({"/usr/bin/env"}, folder / "environment");
  std::vector<Ended> ended;
  while (ended.empty())
    ended = processes.wait(1);
  EXPECT_EQ(ended.front().exit_code, 0);
  const std::string text = contents(folder / "environment");
  EXPECT_NE(text.find("PATH="), std::string::npos);
  EXPECT_EQ(text.find("MYOLINES_SET_LATER"), std::string::npos);
  EXPECT_EQ(text.find("PMIX_"), std::string::npos);
}
