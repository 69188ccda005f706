#include <myolines/base/error.h>
#include <myolines/base/lanes.h>
#include <myolines/base/names.h>

#include <gtest/gtest.h>

#include <cmath>

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
  } // namespace
} // namespace myolines
