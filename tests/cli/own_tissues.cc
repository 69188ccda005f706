// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: tissues of a scene's own, beyond the three printed ones, stand under their names in everything that the program writes.
#include "program_runner.h"

#include <gtest/gtest.h>

namespace
{
  std::string parameter(const std::string &name, const std::string &type, const std::string &value)
  {
    return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
  }
  std::string list(const std::string &name, const std::string &content)
  {
    return "<ParameterList name=\"" + name + "\">" + content + "</ParameterList>";
  }
  std::string law(const std::string &name, const std::string &type) { return list(name, parameter("type", "string", type)); }

  /// A block of two tissues, one behind the other along x, that is pulled and activated.
  std::string scene()
  {
    const std::string ramp = parameter("type", "string", "smooth step") + parameter("duration", "double", "0.02");
    return list(
        "scene",
        parameter("title", "string", "Two tissues of its own") +
            list("system",
                 parameter("type", "string", "muscle 3d") +
                     list("geometry", parameter("cells x", "int", "4") + parameter("refinement", "int", "0") +
                                          parameter("tissue", "string", "myocardium")) +
                     list("fields", parameter("tissue", "string", "x&lt;0.01 ? 4 : 5")) +
                     list("tissues", list("own", list("myocardium", list("laws", law("wall", "guccione") + law("fluid", "viscosity") +
                                                                                     law("force", "active fibre"))) +
                                                     list("scar", list("laws", law("net", "yeoh") + law("threads", "tendinous fibre"))))) +
                     list("boundary", list("moving end", parameter("face", "string", "x+") + parameter("type", "string", "strain") +
                                                             list("strain", ramp + parameter("amplitude", "double", "0.02"))) +
                                          list("fixed end", parameter("face", "string", "x-") + parameter("type", "string", "fixed"))) +
                     list("activation", ramp + parameter("amplitude", "double", "0.3"))) +
            list("integrator", parameter("type", "string", "backward euler")) +
            list("time", parameter("end", "double", "0.02") + parameter("step", "double", "0.01")) +
            list("output",
                 list("series", parameter("all faces", "bool", "true")) +
                     list("fields",
                          parameter("what", "string",
                                    "displacement, tissue, fibre direction, law stress, stress of myocardium wall, stress of scar net"))));
  }

  std::string first_line(const std::filesystem::path &file)
  {
    const std::string text = contents(file);
    return text.substr(0, text.find('\n'));
  }
} // namespace

TEST(OwnTissues, StandInEveryOutputUnderTheirNames)
{
  const TestFolder folder;
  folder.write("scene.xml", scene());
  const Outcome run = run_program(folder, "run scene.xml --quiet --out out");
  ASSERT_EQ(run.exit_code, 0) << run.err;

  const std::vector<std::string> laws = {"myocardium wall", "myocardium fluid", "myocardium force", "scar net", "scar threads"};
  for (const std::string file : {"force_data-3d.csv", "force_data-3d-001.csv", "energy_data-3d.csv"})
    {
      const std::string header = first_line(folder / "out" / file);
      for (const std::string &name : laws)
        EXPECT_NE(header.find("," + name + " "), std::string::npos) << file << ", " << name;
      EXPECT_EQ(header.find("Muscle"), std::string::npos) << file << ": the body has none";
      EXPECT_EQ(header.find("endon"), std::string::npos) << file;
    }
  const std::string balance = first_line(folder / "out" / "energy_balance.csv");
  for (const std::string stored : {"Stored laws [J]", "Stored myocardium wall [J]", "Stored scar net [J]", "Stored scar threads [J]"})
    EXPECT_NE(balance.find("," + stored), std::string::npos) << balance;
  EXPECT_EQ(balance.find("fluid"), std::string::npos) << "viscosity stores nothing";

  const std::string fields = contents(folder / "out" / "fields-0002.vtu");
  for (const std::string array : {"stress_of_myocardium_wall", "stress_of_scar_net", "law_stress", "tissue"})
    EXPECT_NE(fields.find("\"" + array + "\""), std::string::npos) << array;

  const Outcome check = run_program(folder, "check scene.xml");
  EXPECT_NE(check.out.find("; myocardium: 1.125e-06 m^3; scar: 1.875e-06 m^3\n"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("off  passive fibres and base material"), std::string::npos);
  for (const std::string &name : laws)
    EXPECT_NE(check.out.find("on   " + name + ": "), std::string::npos) << name;

  const Outcome point = run_program(folder, "point scene.xml --out point");
  EXPECT_EQ(point.exit_code, 0) << point.err;
  EXPECT_NE(first_line(folder / "point" / "myocardium_laws_along.csv").find("wall"), std::string::npos);
  EXPECT_NE(first_line(folder / "point" / "scar_laws_across.csv").find("threads"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "point" / "muscle_stretch.csv"));

  const Outcome picture = run_program(folder, "picture out --field tissue --fibres 4");
  ASSERT_EQ(picture.exit_code, 0) << picture.err;
  std::string drawn;
  for (const auto &entry : std::filesystem::directory_iterator(folder / "out" / "pictures"))
    if (entry.path().extension() == ".svg")
      drawn += contents(entry.path());
  for (const std::string name : {">myocardium<", ">scar<"})
    EXPECT_NE(drawn.find(name), std::string::npos) << name;
  EXPECT_EQ(drawn.find(">tendon<"), std::string::npos);
  EXPECT_NE(drawn.find("#4477aa"), std::string::npos) << "a colour of its own";
  EXPECT_EQ(drawn.find("#f1d9a0"), std::string::npos) << "and not that of tendon";

  const Outcome report = run_program(folder, "report out");
  ASSERT_EQ(report.exit_code, 0) << report.err;
  const std::string page = contents(folder / "out" / "report.html");
  for (const std::string name : {"\"name\":\"myocardium\"", "\"name\":\"scar\"", "scar threads"})
    EXPECT_NE(page.find(name), std::string::npos) << name;
}

TEST(OwnTissues, HaveNoFieldsOfLawsThatAreNotThere)
{
  const TestFolder folder;
  folder.write("scene.xml", scene());
  const Outcome wrong = run_program(folder, "run scene.xml --quiet --out out --set \"output/fields/what=stress of scar wall\"");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("stress of scar net"), std::string::npos) << wrong.err;
}
