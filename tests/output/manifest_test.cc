#include <myolines/output/outputs.h>
#include <myolines/output/text_file.h>

#include "folder.h"

#include <nlohmann/json.hpp>

#include <regex>

using namespace myolines;

TEST(Manifest, NamesWhatMadeTheRun)
{
  test::Folder      folder;
  const std::string started = iso8601_now();
  write_manifest(folder.path, "myolines run \"a scene.xml\"", started, "", "done");

  const nlohmann::json manifest = nlohmann::json::parse(folder.text("manifest.json"));
  EXPECT_EQ(manifest.at("program"), "myolines");
  EXPECT_TRUE(std::regex_match(manifest.at("version").get<std::string>(), std::regex("\\d+\\.\\d+\\.\\d+")));
  EXPECT_TRUE(manifest.contains("git hash"));
  EXPECT_EQ(manifest.at("command line"), "myolines run \"a scene.xml\"");
  EXPECT_EQ(manifest.at("exit reason"), "done");
  EXPECT_EQ(manifest.at("ranks"), 1);
  for (const char *library : {"deal.II", "Trilinos"})
    EXPECT_TRUE(std::regex_search(manifest.at("libraries").at(library).get<std::string>(), std::regex("^\\d+\\.\\d+"))) << library;
  EXPECT_FALSE(manifest.at("libraries").at("MPI").get<std::string>().empty());
  EXPECT_TRUE(manifest.at("host").contains("CPU"));

  const std::regex iso8601("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ");
  EXPECT_EQ(manifest.at("started"), started);
  EXPECT_TRUE(std::regex_match(started, iso8601));
  EXPECT_TRUE(std::regex_match(manifest.at("finished").get<std::string>(), iso8601));
  EXPECT_GE(manifest.at("finished").get<std::string>(), started);
}

TEST(Ledger, CountsAndSeconds)
{
  test::Folder folder;
  WorkLedger   ledger;
  ledger.count("residual evaluations", 12);
  ledger.add_seconds("assembly", 0.25);
  write_ledger(folder.path, ledger);
  const nlohmann::json json = nlohmann::json::parse(folder.text("ledger.json"));
  EXPECT_EQ(json, nlohmann::json::parse(R"({"counts": {"residual evaluations": 12}, "seconds": {"assembly": 0.25}})"));
}

TEST(Ledger, EmptyLedgerIsStillAnObject)
{
  test::Folder folder;
  write_ledger(folder.path, WorkLedger());
  const nlohmann::json json = nlohmann::json::parse(folder.text("ledger.json"));
  EXPECT_TRUE(json.at("counts").is_object());
  EXPECT_TRUE(json.at("seconds").is_object());
}
