// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/markdown.h>

#include <gtest/gtest.h>

namespace myolines::scene
{
  namespace
  {
    std::string nowhere(const Schema &) { return ""; }

    TEST(Markdown, HasARowForEveryParameterWithUnitValuesDefaultAndExample)
    {
      Schema schema;
      schema.number("length", 0.03, "m", Range::positive(), "Extent along x.")
          .number("force", std::nullopt, "N", Range::closed(2, 4), "Load.")
          .integer("cells", std::nullopt, Range::closed(3, 8), "Number.")
          .boolean("shown", false, "Whether.")
          .choice("kind", "a", {"a", "b"}, "Which.")
          .optional_text("where", "A formula, for example \"x|y\".");
      EXPECT_EQ(markdown(schema, "", nowhere), "| parameter | meaning | unit | values | default | example |\n|---|---|---|---|---|---|\n"
                                               "| `length` | Extent along x. | m | &gt; 0 | `0.03` | `0.03` |\n"
                                               "| `force` | Load. | N | in \\[2, 4\\] | required | `3` |\n"
                                               "| `cells` | Number. |  | integer in \\[3, 8\\] | required | `6` |\n"
                                               "| `shown` | Whether. |  | `true`, `false` | `false` | `false` |\n"
                                               "| `kind` | Which. |  | `a`, `b` | `a` | `a` |\n"
                                               "| `where` | A formula, for example \"x\\|y\". |  | text | none | `x\\|y` |\n\n");
    }

    TEST(Markdown, LeavesCodeInTextsAsItIs)
    {
      EXPECT_EQ(markdown_text("See `plot a_b|c > d` of x_1."), "See `plot a_b\\|c > d` of x\\_1.");
      EXPECT_EQ(markdown_text("One ` alone < two."), "One \\` alone &lt; two.");
    }

    TEST(Markdown, GivesListsTheirPathsAndNamesPagesOfTheirOwn)
    {
      Schema inner("Inner."), other("Other."), outer, linear("Linear.");
      inner.number("k", 1, "N/m", Range::any(), "Stiffness.");
      linear.number("c", 2, "-", Range::any(), "Factor.");
      outer.variant("type", "linear", {{"linear", linear}}, "Law.")
          .section("spring", inner)
          .optional_section("load", other)
          .named_sections(inner);
      const std::string text =
          markdown(outer, "system/", [](const Schema &schema) { return schema.doc() == "Other." ? "See there." : ""; });
      for (const std::string line :
           {"**`system/type = linear`** Linear.\n", "**`system/spring/`** Inner.\n",
            "**`system/load/` (optional list)** Other. See there.\n", "**`system/NAME/` (lists with names of your choice)** Inner.\n"})
        EXPECT_NE(text.find(line), std::string::npos) << text;
    }
  } // namespace
} // namespace myolines::scene
