// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/escape.h>
#include <myolines/base/lanes.h>
#include <myolines/base/named_instruction_set.h>
#include <myolines/base/names.h>

#include <gtest/gtest.h>

#include <cerrno>
#include <cmath>
#include <cstdio>

namespace myolines
{
  namespace
  {
    TEST(InputError, SaysWhatWhereExpectedAndHow)
    {
      const InputError error(
          {{"scene.xml: time/step", "is -1", "a number > 0", "try 1e-3"}, {"scene.xml: time/end", "is missing", "", ""}});
      const std::string text = error.what();
      for (const char *part : {"scene.xml: time/step", "is -1", "a number > 0", "try 1e-3", "time/end", "is missing"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
      EXPECT_EQ(error.problems().size(), 2u);
    }

    TEST(Names, NearestIsTheOneWithFewestEdits)
    {
      const std::vector<std::string> names{"length", "width", "height", "refinement"};
      EXPECT_EQ(nearest_name("lenght", names), "length");
      EXPECT_EQ(nearest_name("refinment", names), "refinement");
      EXPECT_EQ(nearest_name("colour", names), "");
      EXPECT_EQ(nearest_hint("lenght", names), "nearest: \"length\"");
      EXPECT_EQ(nearest_hint("colour", names), "");
      EXPECT_EQ(join(names), "length, width, height, refinement");
    }

    TEST(Names, AShellReadsWhatWasMeant)
    {
      for (const std::string word :
           {"plain", "a b", "it's", "{a,b}", "[x]", "~x", "!x", "$(id)", "`id`", "a\nb", "\"", "\\", "", "*", "#", "a=b;c",
            "gr\xc3\xb6\xc3\x9f"
            "e"})
        {
          const std::string command = "printf '%s' " + shell_text({word});
          for (const char *shell : {"sh", "bash"})
            {
              std::FILE *pipe =
                  popen((std::string("exec ") + shell + " -s << 'END_OF_SCRIPT'\n" + command + "\nEND_OF_SCRIPT\n").c_str(), "r");
              ASSERT_NE(pipe, nullptr);
              std::string read;
              for (int c; (c = std::fgetc(pipe)) != EOF;)
                read += static_cast<char>(c);
              pclose(pipe);
              EXPECT_EQ(read, word) << shell << ": " << command;
            }
        }
    }

    TEST(SystemError, HasTheReasonOfTheSystem)
    {
      const SystemError error("write", "a/b.csv", ENOSPC);
      EXPECT_STREQ(error.what(), "cannot write a/b.csv: No space left on device");
      EXPECT_EQ(error.error_number(), ENOSPC);
    }

    TEST(Lanes, ComputeAsDoublesDo)
    {
      using L = Lanes<InstructionSet::baseline>;
      L x(0.), y(2.);
      for (int lane = 0; lane < n_lanes; ++lane)
        x.set(lane, 0.1 * lane - 0.3);
      const L z = select(x < L(0.), sin(x) * y - cbrt(y), cos(x) / y + sqrt(y));
      for (int lane = 0; lane < n_lanes; ++lane)
        {
          const double s = x[lane];
          EXPECT_DOUBLE_EQ(z[lane], s < 0 ? std::sin(s) * 2 - std::cbrt(2.) : std::cos(s) / 2 + std::sqrt(2.));
        }
    }

    TEST(Escaped, IsTextAndNoMarkup)
    {
      EXPECT_EQ(escaped("a < b && \"c\" > 'd'"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; &#39;d&#39;");
      EXPECT_EQ(escaped("\u00b5m\n\t"), "\u00b5m\n\t");
      EXPECT_EQ(escaped("\xC3("), "\uFFFD(") << "the first byte of two";
      EXPECT_EQ(escaped(std::string("\0\x1b", 2)), "\uFFFD\uFFFD") << "XML has no way to write these";
    }

    TEST(InstructionSets, AreNamedIfTheProcessorHasThem)
    {
      EXPECT_EQ(instruction_set_named("baseline"), InstructionSet::baseline);
      const auto complaint = [](const char *word) -> std::string {
        try
          {
            instruction_set_named(word);
          }
        catch (const InputError &error)
          {
            return error.what();
          }
        return "";
      };
      EXPECT_NE(complaint("avx3").find("there is no \"avx3\""), std::string::npos);
      for (const auto &[word, set] :
           {std::pair<const char *, InstructionSet>{"avx2", InstructionSet::avx2}, {"avx512", InstructionSet::avx512}})
        if (set <= widest_instruction_set())
          EXPECT_EQ(instruction_set_named(word), set);
        else
          EXPECT_NE(complaint(word).find(std::string("this processor does not have ") + word), std::string::npos) << complaint(word);
    }
  } // namespace
} // namespace myolines
