// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/manifest.h>
#include <myolines/output/text_file.h>

#include "folder.h"

#include <nlohmann/json.hpp>

#include <regex>

using namespace myolines;

TEST(Manifest, NamesWhatMadeTheRun)
{
  test::Folder       folder;
  const std::string  started = iso8601_now();
  const OutputFolder outputs(folder.path);
  outputs.note("fields-*.vtu");
  outputs.entitle("momenta.csv", "Momenta, and \"more\"");
  EnergyReport energy;
  energy.drift     = -0.25;
  energy.exchanged = 4;
  energy.rise      = {0.1, 0.2, 0.5};
  write_manifest(outputs, {"myolines run \"a scene.xml\"", "a scene.xml", started, "", {{"a scene.xml", "0123abcd"}}, energy}, "done");

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
  EXPECT_EQ(manifest.at("inputs").at("a scene.xml"), "0123abcd");
  EXPECT_EQ(manifest.at("energy").at("drift [J]"), -0.25);
  EXPECT_EQ(manifest.at("energy").at("exchanged [J]"), 4);
  EXPECT_EQ(manifest.at("energy").at("largest gain"), nlohmann::json::parse(R"({"size [J]": 0.5, "from [s]": 0.1, "to [s]": 0.2})"));
  EXPECT_EQ(manifest.at("files"), nlohmann::json::parse(R"(["fields-*.vtu", "manifest.json"])"));
  EXPECT_EQ(read_manifest(folder.path).value().titles.at("momenta.csv"), "Momenta, and \"more\"");
}

TEST(Manifest, OnlyOneOfThisProgramIsTakenForOne)
{
  test::Folder folder;
  EXPECT_FALSE(read_manifest(folder.path).has_value());
  const auto complaint = [&folder](const std::string &text) {
    std::ofstream(folder.path / "manifest.json") << text;
    try
      {
        read_manifest(folder.path);
      }
    catch (const InputError &error)
      {
        return error.problems()[0].where;
      }
    return std::string("taken");
  };
  const std::string file = (folder.path / "manifest.json").string();
  for (const char *other :
       {"", "hello", "[1, 2]", R"({"name": "my web app"})", R"({"exit reason": 5})", R"({"program": "myolines", "exit reason": 5})",
        R"({"program": "myolines", "exit reason": "done", "files": "all"})",
        R"({"program": "myolines", "exit reason": "done", "files": ["../../precious"]})",
        R"({"program": "myolines", "exit reason": "done", "files": ["/etc/passwd"]})"})
    EXPECT_EQ(complaint(other), file) << other;
  EXPECT_EQ(complaint(R"({"program": "myolines", "exit reason": "done", "files": ["a.csv", "states/state-*"]})"), "taken");
  EXPECT_EQ(complaint(R"({"program": "myolines", "exit reason": "done", "files": [], "titles": {"a.csv": 3}})"), "taken");
}

TEST(Manifest, WhatIsAddedLaterIsListed)
{
  test::Folder       folder;
  const OutputFolder outputs(folder.path);
  outputs.note("a.csv");
  write_manifest(outputs, {"run", "scene.xml", "then", "", {}}, "done");
  list_in_manifest(folder.path, {"pictures/a.png"});
  EXPECT_EQ(read_manifest(folder.path)->files, (std::set<std::string>{"a.csv", "manifest.json", "pictures/a.png"}));
  EXPECT_EQ(read_manifest(folder.path)->exit_reason, "done");
}

TEST(Ledger, CountsAndSeconds)
{
  test::Folder folder;
  WorkLedger   ledger;
  ledger.count("residual evaluations", 12);
  ledger.add_seconds("assembly", 0.25);
  write_ledger(OutputFolder(folder.path), ledger);
  const nlohmann::json json = nlohmann::json::parse(folder.text("ledger.json"));
  EXPECT_EQ(json, nlohmann::json::parse(R"({"counts": {"residual evaluations": 12}, "seconds": {"assembly": 0.25}})"));
}

TEST(Ledger, EmptyLedgerIsStillAnObject)
{
  test::Folder folder;
  write_ledger(OutputFolder(folder.path), WorkLedger());
  const nlohmann::json json = nlohmann::json::parse(folder.text("ledger.json"));
  EXPECT_TRUE(json.at("counts").is_object());
  EXPECT_TRUE(json.at("seconds").is_object());
}
