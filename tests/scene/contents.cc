// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: what a list of a scene holds, and may hold, can be asked for.

#include <myolines/scene/contents.h>
#include <myolines/scene/document.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::scene;

namespace
{
  Schema listed_schema()
  {
    Schema box("A box.");
    box.number("edge", 2, "m", Range::positive(), "Its edge.").optional_number("lid", "m", Range::any(), "Its lid.");
    Schema ball("A ball.");
    ball.number("radius", std::nullopt, "m", Range::positive(), "Its radius.");
    Schema each("A load.");
    each.number("force", 1, "N", Range::any(), "Its force.");
    Schema extra("What need not be there.");
    extra.integer("every", 3, Range::any(), "How often.");
    return Schema("All.")
        .variant("type", "box", {{"box", box}, {"ball", ball}}, "What it is.")
        .section("loads", Schema("Loads.").named_sections(each))
        .optional_section("extra", extra);
  }

  const Item &item(const Contents &contents, const std::string &name)
  {
    for (const Item &one : contents.items)
      if (one.name == name)
        return one;
    throw std::out_of_range(name);
  }
} // namespace

TEST(Contents, TellsValuesDefaultsAndWhatIsAbsent)
{
  const Schema   schema = listed_schema();
  const Node     node   = compose_scene(schema, {{"edge", "5"}, {"loads/left/force", "7"}});
  const Contents root   = contents_of(node, schema, "");
  EXPECT_EQ(item(root, "edge").text, "5");
  EXPECT_TRUE(item(root, "edge").written);
  EXPECT_EQ(item(root, "edge").entry.unit, "m");
  EXPECT_EQ(item(root, "type").text, "box");
  EXPECT_FALSE(item(root, "type").written);
  EXPECT_FALSE(item(root, "lid").present);
  EXPECT_FALSE(item(root, "extra").present);
  EXPECT_EQ(item(contents_of(node, schema, "extra"), "every").text, "3"); // what it would be
  const Contents loads = contents_of(node, schema, "loads");
  EXPECT_TRUE(loads.takes_more);
  EXPECT_TRUE(item(loads, "left").named);
  EXPECT_EQ(item(contents_of(node, schema, "loads/left"), "force").text, "7");
}

TEST(Contents, FollowsTheAlternativeInForce)
{
  const Schema schema = listed_schema();
  const Node   node   = compose_scene(schema, {{"type", "ball"}, {"radius", "1"}});
  EXPECT_EQ(item(contents_of(node, schema, ""), "radius").text, "1");
  EXPECT_THROW(item(contents_of(node, schema, ""), "edge"), std::out_of_range);
}

TEST(Contents, NamesTheNearestList)
{
  const Schema schema = listed_schema();
  try
    {
      contents_of(compose_scene(schema, {}), schema, "laods/left");
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("nearest valid name: \"loads\""), std::string::npos) << error.what();
    }
}

TEST(Contents, ListsAreAddedAsAFileWritesThem)
{
  RawList root;
  add_list(root, "a/b");
  add_list(root, "a");
  ASSERT_EQ(root.lists.size(), 1u);
  ASSERT_EQ(root.lists[0].lists.size(), 1u);
  EXPECT_FALSE(root.lists[0].lists[0].from_override);
}
