// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/temporary.h"

#include <myolines/scene/document.h>
#include <myolines/scene/scene.h>

#include <gtest/gtest.h>

#include <fstream>

using namespace myolines;
using namespace myolines::scene;

namespace
{
  Schema drive()
  {
    Schema constant("Constant."), sine("Sine.");
    constant.number("value", 0, "-", Range::any(), "Value.");
    sine.number("frequency", std::nullopt, "Hz", Range::positive(), "Frequency.")
        .section("window", Schema("Window.").number("width", 2, "s", Range::positive(), "Width."));
    return Schema("Drive.").variant("type", "constant", {{"constant", constant}, {"sine", sine}}, "Type of drive.");
  }

  Schema root()
  {
    Schema condition("Condition.");
    condition.choice("face", std::nullopt, {"left", "right"}, "Face.").section("strain", drive());
    Schema body("Body.");
    body.number("length", 0.03, "m", Range::positive(), "Length.")
        .integer("degree", 2, Range::closed(1, 3), "Degree.")
        .boolean("dynamic", true, "Inertia.")
        .choice("shape", "block", {"block", "cylinder"}, "Shape.");
    return Schema("Root.")
        .text("title", "untitled", "Title.")
        .optional_number("seed", "-", Range::any(), "Seed.")
        .optional_file("table", "A table.")
        .section("body", body)
        .optional_section("activation", drive())
        .section("boundary", Schema("Conditions.").named_sections(condition));
  }

  std::string parameter(const std::string &name, const std::string &type, const std::string &value)
  {
    return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
  }

  std::string sublist(const std::string &name, const std::string &contents)
  {
    return "<ParameterList name=\"" + name + "\">\n" + contents + "</ParameterList>\n";
  }

  Node read(const std::string &contents, const std::vector<std::string> &overrides = {})
  {
    return parse_scene(sublist("scene", contents), root(), "test.xml", ".", overrides);
  }

  std::vector<InputProblem> problems_of(const std::function<void()> &reading)
  {
    try
      {
        reading();
      }
    catch (const InputError &error)
      {
        return error.problems();
      }
    return {};
  }
} // namespace

TEST(Scene, ATextMayHoldNumbers)
{
  const auto numbers = [](const std::string &text) { return read(parameter("title", "string", text)).numbers("title", "times [s]"); };
  EXPECT_EQ(numbers(" 0.5 -1e-3  2"), (std::vector<double>{0.5, -1e-3, 2}));
  for (const auto &[text, what] : {std::pair("1 two", "\"two\" is not a finite number"), std::pair("1, 2", "\"1,\" is not a finite number"),
                                   std::pair("nan", "\"nan\" is not a finite number"), std::pair(" ", "there is no number")})
    {
      const auto problems = problems_of([&, text = text] { numbers(text); });
      ASSERT_EQ(problems.size(), 1u) << text;
      EXPECT_EQ(problems[0].what, what);
      EXPECT_EQ(problems[0].where, "test.xml: title");
      EXPECT_EQ(problems[0].expected, "times [s]");
    }
}

TEST(Scene, ListsAndFilesAreFoundInside)
{
  const auto folder = test::temporary("scene of files");
  std::filesystem::create_directories(folder);
  for (const char *name : {"a.csv", "b.csv", "c.csv"})
    std::ofstream(folder / name) << "t,u\n0,0\n";
  const Schema with_file = Schema("One.").file("table", "A table.");
  const Schema all       = Schema("All.").optional_file("table", "A table.").section("in", with_file).named_sections(with_file);
  const auto   table     = [](const std::string &name) { return parameter("table", "string", name); };
  std::ofstream(folder / "scene.xml") << sublist("scene", table("a.csv") + sublist("in", table("b.csv")) + sublist("mine", table("c.csv")));
  const Node scene = read_scene(folder / "scene.xml", all);
  EXPECT_EQ(scene.files(), (std::vector<std::filesystem::path>{folder / "a.csv", folder / "b.csv", folder / "c.csv"}));
  EXPECT_EQ(lists_at(folder / "scene.xml", ""), (std::vector<std::string>{"in", "mine"}));
  EXPECT_TRUE(lists_at(folder / "scene.xml", "nowhere").empty());
}

TEST(Scene, ANumberIsATextToo)
{
  EXPECT_EQ(read(parameter("title", "double", "0.5")).text("title"), "0.5");
  EXPECT_FALSE(problems_of([] { read(parameter("title", "bool", "true")); }).empty());
}

TEST(Scene, DefaultsStandWhereNothingIsWritten)
{
  const Node node = read("");
  EXPECT_EQ(node.text("title"), "untitled");
  EXPECT_DOUBLE_EQ(node.section("body").number("length"), 0.03);
  EXPECT_EQ(node.section("body").integer("degree"), 2);
  EXPECT_TRUE(node.section("body").boolean("dynamic"));
  EXPECT_FALSE(node.has("seed"));
  EXPECT_FALSE(node.has("activation"));
  EXPECT_FALSE(node.section("body").written("length"));
  EXPECT_TRUE(node.section("boundary").named().empty());
}

TEST(Scene, ReadsWhatIsWritten)
{
  const Node node = read(parameter("seed", "int", "7") +
                         sublist("body", parameter("length", "double", " 1e-2 ") + parameter("dynamic", "bool", "false")) +
                         sublist("activation", parameter("type", "string", "sine") + parameter("frequency", "double", "3")) +
                         sublist("boundary", sublist("moving end", parameter("face", "string", "right")) +
                                                 sublist("b", parameter("face", "string", "left")) + "<!-- comment -->"));
  EXPECT_EQ(node.number("seed"), 7) << "an int serves where a number is declared";
  EXPECT_EQ(node.section("body").number("length"), 1e-2);
  EXPECT_TRUE(node.section("body").written("length"));
  EXPECT_TRUE(node.written("activation"));
  EXPECT_FALSE(node.section("body").boolean("dynamic"));
  EXPECT_EQ(node.section("activation").number("frequency"), 3);
  EXPECT_EQ(node.section("activation").section("window").number("width"), 2);
  ASSERT_EQ(node.section("boundary").named().size(), 2u);
  EXPECT_EQ(node.section("boundary").named()[0].path(), "boundary/moving end");
  EXPECT_EQ(node.section("boundary").named()[0].section("strain").text("type"), "constant");
  EXPECT_EQ(node.section("boundary").named()[0].where("face"), "test.xml: boundary/moving end/face");
}

TEST(Scene, AskingForWhatIsNotDeclaredIsAProgrammingError)
{
  const Node node = read("");
  EXPECT_THROW(node.number("lenght"), std::logic_error);
  EXPECT_THROW(node.has("lenght"), std::logic_error);
  EXPECT_THROW(node.section("body").number("degree"), std::logic_error);
  EXPECT_THROW(node.section("activation"), std::logic_error);
  EXPECT_THROW(Schema("").number("a", 1, "", {}, "").text("a", "", ""), std::logic_error);
  EXPECT_THROW(Schema("").number("a", -1, "", Range::positive(), ""), std::logic_error);
}

struct Mistake
{
  const char *name;
  std::string contents;
  std::string where, what, expected, hint;
};

class Mistakes : public ::testing::TestWithParam<Mistake>
{
};

TEST_P(Mistakes, AreNamedWithTheirPlaceAndRemedy)
{
  const Mistake &mistake  = GetParam();
  const auto     problems = problems_of([&] { read(mistake.contents); });
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "test.xml: " + mistake.where);
  EXPECT_NE(problems[0].what.find(mistake.what), std::string::npos) << problems[0].what;
  EXPECT_NE(problems[0].expected.find(mistake.expected), std::string::npos) << problems[0].expected;
  EXPECT_NE(problems[0].hint.find(mistake.hint), std::string::npos) << problems[0].hint;
}

const std::string face = parameter("face", "string", "left");

INSTANTIATE_TEST_SUITE_P(
    All, Mistakes,
    ::testing::Values(
        Mistake{"misspelt", sublist("body", parameter("lenght", "double", "1")), "body/lenght", "unknown parameter \"lenght\"", "",
                "\"length\""},
        Mistake{"unknown_list", sublist("bodi", ""), "bodi", "unknown list \"bodi\"", "", "\"body\""},
        Mistake{"unknown_root", parameter("titel", "string", "x"), "titel", "unknown parameter", "", "\"title\""},
        Mistake{"duplicate", sublist("body", parameter("length", "double", "1") + parameter("length", "double", "1")), "body/length",
                "duplicate", "", ""},
        Mistake{"duplicate_list", sublist("body", "") + sublist("body", ""), "body", "duplicate", "", ""},
        Mistake{"duplicate_condition", sublist("boundary", sublist("end", face) + sublist("end", face)), "boundary/end", "duplicate", "",
                ""},
        Mistake{"parameter_as_list", sublist("title", ""), "title", "a parameter, not a list", "a parameter", ""},
        Mistake{"list_as_parameter", parameter("body", "string", "x"), "body", "a list, not a parameter", "a list", ""},
        Mistake{"text_for_number", sublist("body", parameter("length", "double", "abc")), "body/length", "\"abc\" is not a finite number",
                "[m] > 0", ""},
        Mistake{"trailing_text", sublist("body", parameter("length", "double", "1 mm")), "body/length", "\"1 mm\"", "[m] > 0", ""},
        Mistake{"empty_number", sublist("body", parameter("length", "double", "")), "body/length", "\"\" is not a finite number", "", ""},
        Mistake{"nan", sublist("body", parameter("length", "double", "nan")), "body/length", "\"nan\"", "", ""},
        Mistake{"inf", sublist("body", parameter("length", "double", "inf")), "body/length", "\"inf\"", "", ""},
        Mistake{"overflow", sublist("body", parameter("length", "double", "1e999")), "body/length", "\"1e999\"", "", ""},
        Mistake{"zero", sublist("body", parameter("length", "double", "0")), "body/length", "0 is out of range", "> 0", ""},
        Mistake{"integer_range", sublist("body", parameter("degree", "int", "4")), "body/degree", "4 is out of range", "in [1, 3]", ""},
        Mistake{"fraction", sublist("body", parameter("degree", "int", "1.5")), "body/degree", "\"1.5\" is not an integer", "", ""},
        Mistake{"wrong_type", sublist("body", parameter("degree", "double", "2")), "body/degree", "type=\"double\"", "type=\"int\"", ""},
        Mistake{"string_for_number", sublist("body", parameter("length", "string", "1")), "body/length", "type=\"string\"",
                "type=\"double\"", ""},
        Mistake{"boolean", sublist("body", parameter("dynamic", "bool", "yes")), "body/dynamic", "\"yes\"", "true or false", ""},
        Mistake{"choice", sublist("body", parameter("shape", "string", "blok")), "body/shape", "\"blok\"", "block, cylinder", "\"block\""},
        Mistake{"variant", sublist("activation", parameter("type", "string", "sinus") + parameter("frequency", "double", "1")),
                "activation/type", "\"sinus\"", "constant, sine", "\"sine\""},
        Mistake{"other_alternative", sublist("activation", parameter("frequency", "double", "1")), "activation/frequency", "does not apply",
                "", "\"sine\""},
        Mistake{"missing", sublist("activation", parameter("type", "string", "sine")), "activation/frequency", "missing parameter",
                "[Hz] > 0", "Frequency."},
        Mistake{"missing_in_condition", sublist("boundary", sublist("end", "")), "boundary/end/face", "missing parameter", "left, right",
                ""},
        Mistake{"slash_in_name", sublist("boundary", sublist("a/b", face)), "boundary/a/b", "slash", "", ""},
        Mistake{"missing_file", parameter("table", "string", "nowhere.dat"), "table", "there is no file", "relative to the scene", ""},
        Mistake{"folder_for_file", parameter("table", "string", "."), "table", "there is no file", "", ""},
        Mistake{"stray_text", sublist("body", "length = 3"), "body", "stray text \"length = 3\"", "", ""},
        Mistake{"unknown_element", "<Paramter name=\"title\"/>", "root", "<Paramter>", "<Parameter>", ""},
        Mistake{"no_value", "<Parameter name=\"title\" type=\"string\"/>", "title", "without attribute \"value\"", "", ""},
        Mistake{"no_type", "<Parameter name=\"title\" value=\"x\"/>", "title", "without attribute \"type\"", "", ""},
        Mistake{"no_name", "<Parameter type=\"string\" value=\"x\"/>", "root", "without attribute \"name\"", "", ""},
        Mistake{"extra_attribute", "<Parameter name=\"title\" type=\"string\" value=\"x\" unit=\"m\"/>", "title", "unknown attribute",
                "name, type, value", ""},
        Mistake{"element_in_parameter",
                "<Parameter name=\"title\" type=\"string\" value=\"x\"><Parameter name=\"title\" type=\"string\" value=\"x\"/></Parameter>",
                "title", "inside", "", ""}),
    [](const auto &info) { return info.param.name; });

TEST(Scene, AllProblemsAreCollected)
{
  const auto problems = problems_of([] {
    read(parameter("titel", "string", "x") + sublist("body", parameter("length", "double", "-1") + parameter("degree", "int", "x")) +
         sublist("boundary", sublist("end", parameter("face", "string", "up"))));
  });
  EXPECT_EQ(problems.size(), 4u);
}

TEST(Scene, MalformedDocumentsAreRefused)
{
  for (const std::string xml : {"", "text", "<ParameterList name=\"scene\">", "<ParameterList name=\"scene\"></Parameter>",
                                "<ParameterList name=\"scene\"/><a/>", "<ParameterList name=\"study\"/>", "<ParameterList/>", "<scene/>",
                                "<ParameterList name=\"scene\"><Parameter name=\"title\" name=\"b\"/></ParameterList>"})
    EXPECT_EQ(problems_of([&] { parse_scene(xml, root()); }).size(), 1u) << xml;
  EXPECT_EQ(problems_of([] { read_scene("no such scene.xml", root()); }).size(), 1u);
  EXPECT_EQ(problems_of([] { read_scene(".", root()); }).size(), 1u);
}

TEST(Scene, OverridesReplaceAndCreate)
{
  const Node node = read(sublist("boundary", sublist("moving end", face)), {"body/length=2e-2", "title=a=b", "activation/type=sine",
                                                                            "activation/frequency=4", "boundary/moving end/face=right"});
  EXPECT_EQ(node.section("body").number("length"), 2e-2);
  EXPECT_EQ(node.text("title"), "a=b");
  EXPECT_EQ(node.section("activation").number("frequency"), 4);
  EXPECT_EQ(node.section("boundary").named()[0].text("face"), "right");
}

TEST(Scene, WrongOverridesAreRefused)
{
  const std::vector<std::pair<std::string, std::string>> cases{{"body/lenght=1", "\"length\""},
                                                               {"bodi/length=1", "\"body\""},
                                                               {"body/length=abc", "[m] > 0"},
                                                               {"boundary/movng end/face=left", "\"moving end\""},
                                                               {"body/length", "path=value"},
                                                               {"=3", "path=value"},
                                                               {"body=3", "a list"}};
  for (const auto &[text, fragment] : cases)
    {
      const auto problems = problems_of([&, t = text] { read(sublist("boundary", sublist("moving end", face)), {t}); });
      ASSERT_EQ(problems.size(), 1u) << text;
      EXPECT_NE((problems[0].expected + problems[0].hint).find(fragment), std::string::npos)
          << text << ": " << problems[0].expected << problems[0].hint;
    }
}

TEST(Scene, TextSurvivesResolving)
{
  const std::string title  = "\"quotes\" & 'more' <tags> > &amp; \xc3\xa9\n\tnew line";
  const Schema      schema = root();
  const Node        node   = compose_scene(
               schema, {{"title", title}, {"boundary/a & <b>/face", "left"}, {"activation/type", "sine"}, {"activation/frequency", "0.1"}});
  const std::string xml   = resolved_xml(node);
  const Node        again = parse_scene(xml, schema);
  EXPECT_EQ(again.text("title"), title);
  EXPECT_EQ(again.section("boundary").named()[0].name(), "a & <b>");
  EXPECT_EQ(resolved_xml(again), xml);
  EXPECT_EQ(written_xml(parse_scene(written_xml(node), schema)), written_xml(node));
  EXPECT_EQ(written_xml(node).find("length"), std::string::npos);
}

TEST(Scene, FilesAreFoundBesideTheSceneAndResolvedAbsolute)
{
  const std::filesystem::path folder = test::temporary("scene_test");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "table.dat") << "0 0\n";
  std::ofstream(folder / "scene.xml") << sublist("scene", parameter("table", "string", "table.dat"));
  const Node node = read_scene(folder / "scene.xml", root());
  EXPECT_EQ(node.file("table"), folder / "table.dat");
  EXPECT_EQ(parse_scene(resolved_xml(node), root(), "copy", "/").file("table"), folder / "table.dat");
  EXPECT_EQ(peek_text(folder / "scene.xml", "table"), "table.dat");
  EXPECT_EQ(peek_text(folder / "scene.xml", "body/shape"), std::nullopt);
  EXPECT_EQ(peek_text(folder / "scene.xml", "body/shape", {"body/shape=round"}), "round");
  std::filesystem::remove_all(folder);
}

TEST(Scene, TemplateIsACompleteValidScene)
{
  const Schema      schema = root();
  const std::string xml =
      template_xml(schema, {{"boundary/end/face", "left"}, {"boundary/end/strain/type", "sine"}, {"boundary/end/strain/frequency", "2"}});
  const Node node = parse_scene(xml, schema);
  EXPECT_EQ(node.section("boundary").named()[0].section("strain").number("frequency"), 2);
  EXPECT_TRUE(node.section("body").written("degree")) << "defaults are spelt out";
  EXPECT_NE(xml.find("a number [m] > 0; default 0.03. Length."), std::string::npos);
  EXPECT_NE(xml.find("optional list \"activation\""), std::string::npos);
  EXPECT_THROW(template_xml(schema, {{"boundary/end/face", "up"}}), InputError);
}

TEST(Scene, DescriptionNamesEverything)
{
  const std::string text = describe(root());
  for (const std::string word : {"title", "seed", "table", "length", "[m] > 0; default 0.03", "degree", "block, cylinder", "activation/",
                                 "type = sine", "frequency", "window/", "face", "required", "optional"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(Overrides, AnotherAlternativeTakesAwayWhatTheFileHasForTheFormer)
{
  const std::string file = sublist("activation", parameter("type", "string", "sine") + parameter("frequency", "double", "2") +
                                                     sublist("window", parameter("width", "double", "3")));
  const Node        node = read(file, {"activation/type=constant", "activation/value=1"});
  EXPECT_EQ(node.section("activation").number("value"), 1);
  EXPECT_FALSE(node.section("activation").has("frequency"));
  ASSERT_EQ(node.notes().size(), 1u);
  EXPECT_EQ(node.notes()[0], "activation/type is \"constant\" instead of \"sine\": left out of the scene is \"frequency\", \"window\"");
  EXPECT_TRUE(read(file).notes().empty());
  EXPECT_TRUE(read(file, {"activation/type=sine"}).notes().empty());
}

TEST(Overrides, ChoicesThatTheOtherAlternativeHasNotAreTakenAwayToo)
{
  Schema one("One."), other("Other.");
  one.choice("start", "gentle", {"gentle", "own"}, "How.").choice("end", "soft", {"soft", "hard"}, "How.");
  other.choice("start", "short", {"short", "long"}, "How.").choice("end", "soft", {"soft", "hard"}, "How.");
  const Schema      schema = Schema("Scene.").variant("type", std::nullopt, {{"one", one}, {"other", other}}, "Which.");
  const std::string file   = "<ParameterList name=\"scene\">" + parameter("type", "string", "one") + parameter("start", "string", "own") +
                           parameter("end", "string", "hard") + "</ParameterList>";
  const Node node = parse_scene(file, schema, "scene.xml", ".", {"type=other"});
  EXPECT_EQ(node.text("start"), "short");
  EXPECT_EQ(node.text("end"), "hard");
  ASSERT_EQ(node.notes().size(), 1u);
  EXPECT_EQ(node.notes()[0], "type is \"other\" instead of \"one\": left out of the scene is \"start\"");
  EXPECT_EQ(problems_of([&] { parse_scene(file, schema, "scene.xml", ".", {"type=other", "start=own"}); }).size(), 1u);
}

TEST(Overrides, WhatOverridesSayThemselvesIsNotTakenAway)
{
  const std::string file = sublist("activation", parameter("type", "string", "sine") + parameter("frequency", "double", "2"));
  const auto        told = problems_of([&] { read(file, {"activation/type=constant", "activation/window/width=1"}); });
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].what, "\"window\" does not apply here");
  // and a file that is wrong by itself stays wrong
  const std::string wrong = sublist("activation", parameter("type", "string", "constant") + parameter("frequency", "double", "2"));
  EXPECT_EQ(problems_of([&] { read(wrong, {"activation/type=constant"}); }).size(), 1u);
}

TEST(Overrides, RemoveWhatTheFileWrites)
{
  const std::string file = parameter("title", "string", "mine") + sublist("body", parameter("length", "double", "2")) +
                           sublist("activation", parameter("type", "string", "constant"));
  const Node node = read(file, {"~title", "~body/length", "~activation"});
  EXPECT_EQ(node.text("title"), "untitled");
  EXPECT_EQ(node.section("body").number("length"), 0.03);
  EXPECT_FALSE(node.has("activation"));
  EXPECT_EQ(read(file, {"~body/length", "body/length=4"}).section("body").number("length"), 4);
  const auto told = problems_of([&] { read(file, {"~body/width"}); });
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].where, "override: unset \"body/width\"");
}
