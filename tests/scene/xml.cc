// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: what the XML parser would tell in words that do not help, or would not survive, is told with its line.

#include <myolines/scene/scene.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::scene;

namespace
{
  std::string told(const std::string &xml)
  {
    try
      {
        parse_scene(xml, Schema("Root.").text("title", "", "Title.").text("formula", "", "Formula."), "test.xml");
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  std::string with_formula(const std::string &formula)
  {
    return "<ParameterList name=\"scene\">\n<Parameter name=\"formula\" type=\"string\" value=\"" + formula + "\"/>\n</ParameterList>\n";
  }
} // namespace

TEST(Xml, BareSignsInFormulasAreToldWithHowToWriteThem)
{
  for (const char *good : {"x &lt; 1", "x > 1", "x > 0 &amp;&amp; y > 0", "&#60; &quot;&apos;&gt;", "x - y"})
    EXPECT_EQ(told(with_formula(good)), "") << good;
  EXPECT_NE(told(with_formula("x < 1")).find("test.xml, line 2: there is a bare < in a value"), std::string::npos);
  EXPECT_NE(told(with_formula("x < 1")).find("write &lt;"), std::string::npos);
  for (const char *bad : {"x > 0 && y > 0", "a & b", "&", "&lt x"})
    {
      EXPECT_EQ(told(with_formula(bad)).find("bare <"), std::string::npos) << "only the first: " << told(with_formula(bad));
      EXPECT_NE(told(with_formula(bad)).find("there is a bare & in a value"), std::string::npos) << bad;
      EXPECT_NE(told(with_formula(bad)).find("write &amp;"), std::string::npos) << bad;
    }
}

TEST(Xml, ReferencesToCharactersAreThoseCharacters)
{
  const Schema schema = Schema("Root.").text("formula", "", "Formula.");
  const auto   read   = [&](const std::string &text) { return parse_scene(with_formula(text), schema, "test.xml").text("formula"); };
  EXPECT_EQ(read("&#65;&#x42;&#60;"), "AB<");
  EXPECT_EQ(read("&#228;&#xE4; &#8364; &#x1F600;"), "\u00e4\u00e4 \u20ac \U0001F600");
  for (const char *bad :
       {"&#; x", "&#xZZ;", "&#0;", "&#1;", "&#xD800;", "&#x110000;", "&#99999999999999999999;", "&nbsp;", "&xxe;", "&a#;"})
    EXPECT_NE(told(with_formula(bad)).find("test.xml, line 2: \"" + std::string(bad).substr(0, 2)), std::string::npos)
        << bad << told(with_formula(bad));
}

TEST(Xml, OverridesHaveNoControlCharactersEither)
{
  const Schema schema = Schema("Root.").text("formula", "", "Formula.");
  EXPECT_NO_THROW(parse_scene(with_formula("x"), schema, "test.xml", ".", {"formula=a\tb\nc"}));
  EXPECT_THROW(parse_scene(with_formula("x"), schema, "test.xml", ".", {std::string("formula=a\x01") + "b"}), InputError);
}

TEST(Xml, WhatIsNoElementIsLeftOut)
{
  const std::string list = "<ParameterList name=\"scene\">\n", end = "</ParameterList>";
  for (const std::string &text :
       {"<!-- a -- b > \" ' -->\n" + list + "<!-- <Parameter name=\"x\" -->\n" + end + "<!-- -->",
        "<?xml version='1.0' encoding='UTF-8'?><?xml-stylesheet href=\"a.xsl\"?>\n" + list + "<?keep > me?>" + end,
        "<!DOCTYPE scene SYSTEM \"scene.dtd\">" + list + end,
        "<!DOCTYPE scene [ <!ENTITY a \"b\"> <!ELEMENT ParameterList ANY> ]>\n" + list + end})
    EXPECT_EQ(told(text), "") << text;
  EXPECT_NE(told("<!DOCTYPE s [ <!ENTITY xxe SYSTEM \"file:///etc/passwd\"> ]>" + with_formula("&xxe;")).find("\"&xxe;\" stands for no"),
            std::string::npos);
  EXPECT_NE(told(list + "\n<!-- a" + end).find("line 3: a comment begins there that has no end"), std::string::npos);
  EXPECT_NE(told(list + "<![CDATA[ a ]]>" + end).find("line 2: there is a CDATA section"), std::string::npos);
  EXPECT_NE(told(with_formula("a\fb")).find("line 2: there is a control character, number 12"), std::string::npos);
  EXPECT_NE(told("<!DOCTYPE scene [").find("line 1: a declaration begins there that has no end"), std::string::npos);
}

TEST(Xml, SignsElsewhereAreNoMatter)
{
  EXPECT_EQ(told("<?xml version=\"1.0\"?>\n<!-- a < b && \"c -->\n<ParameterList name='scene'><Parameter name='title' type='string' "
                 "value='say \"a > b\"'/></ParameterList>"),
            "");
}

TEST(Xml, DeepNestingIsRefusedNotWalked)
{
  const auto nested = [](const int depth) {
    std::string xml = "<ParameterList name=\"scene\">";
    for (int i = 0; i < depth; ++i)
      xml += "<ParameterList name=\"a\">\n";
    for (int i = 0; i < depth; ++i)
      xml += "</ParameterList>";
    return xml + "</ParameterList>";
  };
  EXPECT_NE(told(nested(60)).find("unknown list \"a\""), std::string::npos);
  EXPECT_NE(told(nested(100)).find("more than 64 elements"), std::string::npos);
  EXPECT_NE(told(nested(1000000)).find("more than 64 elements"), std::string::npos);
}

TEST(Xml, WhatIsCutOffIsTold)
{
  const std::string whole = with_formula("x");
  for (std::size_t n = 1; n + 2 < whole.size(); ++n)
    EXPECT_NE(told(whole.substr(0, n)), "") << whole.substr(0, n);
}
