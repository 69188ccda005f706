// SPDX-License-Identifier: LGPL-2.1-or-later
// Smooth curves and those of the user.
#include "../support/temporary.h"

#include <myolines/base/error.h>
#include <myolines/materials/curve_set.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace myolines
{
  namespace
  {
    using Function = curves::Curve<double> (*)(const double &, const curves::FibreCurves *);

    struct Smooth
    {
      Function curve;
      double   begin, end, distance; ///< how far from that of the thesis
    };

    const std::vector<Smooth> all{{&curves::active<double>, 0.1, 2.2, 5e-3},
                                  {&curves::passive<double>, 0.5, 2.4, 1e-4},
                                  {&curves::force_velocity<double>, -1.6, 1.5, 3e-3},
                                  {&curves::tendon<double>, 0.9, 1.4, 3e-4}};

    // Where a second derivative jumps, the second difference of the slope does not shrink with the distance.
    TEST(SmoothCurves, HaveContinuousSecondDerivatives)
    {
      const CurveSet            set  = smooth_curves();
      const curves::FibreCurves user = set.view();
      for (const Smooth &smooth : all)
        for (double x = smooth.begin; x < smooth.end; x += 1e-3) // knots, too
          {
            const double h     = 1e-7;
            const auto   slope = [&](const double s) { return smooth.curve(s, &user).slope; };
            const double jump = (slope(x + h) - 2 * slope(x) + slope(x - h)) / h, third = 1e6;
            EXPECT_LT(std::abs(jump), third * h + 1e-4) << x;
          }
    }

    TEST(SmoothCurves, AreCloseToThoseOfTheThesis)
    {
      const CurveSet            set  = smooth_curves();
      const curves::FibreCurves user = set.view();
      for (const Smooth &smooth : all)
        for (double x = smooth.begin; x < smooth.end; x += 1.7e-4)
          {
            EXPECT_NEAR(smooth.curve(x, &user).value, smooth.curve(x, nullptr).value, smooth.distance) << x;
            const double h = 1e-6, difference = (smooth.curve(x + h, &user).value - smooth.curve(x - h, &user).value) / (2 * h);
            EXPECT_NEAR(smooth.curve(x, &user).slope, difference, 1e-5 * (1 + std::abs(difference))) << x;
          }
      EXPECT_NEAR(curves::force_velocity(0., &user).value, 1, 1e-14);
      EXPECT_NEAR(curves::active(1., &user).value, curves::active(1.).value, 1e-14);
      EXPECT_NEAR(curves::passive(1., &user).value, 0, 1e-14);
    }

    TEST(SmoothCurves, OfLanesAreThoseOfNumbers)
    {
      using T                        = Lanes<InstructionSet::baseline>;
      const CurveSet            set  = smooth_curves();
      const curves::FibreCurves user = set.view();
      T                         x(0.);
      for (int lane = 0; lane < n_lanes; ++lane)
        x.set(lane, 0.3 + 0.23 * lane);
      const curves::Curve<T> lanes = curves::active(x, &user);
      for (int lane = 0; lane < n_lanes; ++lane)
        {
          EXPECT_EQ(lanes.value[lane], curves::active(x[lane], &user).value);
          EXPECT_EQ(lanes.slope[lane], curves::active(x[lane], &user).slope);
        }
    }

    // Energies are integrals of sigma/s from 1 on.
    TEST(SmoothCurves, HaveTheirEnergies)
    {
      const CurveSet            set  = smooth_curves();
      const curves::FibreCurves user = set.view();
      for (const double end : {0.8, 1.0, 1.013, 1.3, 2.6})
        {
          const unsigned int n       = 200000; // midpoint rule
          double             passive = 0, tendon = 0;
          for (unsigned int i = 0; i < n; ++i)
            {
              const double s = 1 + (end - 1) * (i + 0.5) / n, ds = (end - 1) / n;
              passive += curves::passive(s, &user).value / s * ds;
              tendon += curves::tendon(s, &user).value / s * ds;
            }
          EXPECT_NEAR(curves::passive_energy(end, &user), passive, 1e-9) << end;
          EXPECT_NEAR(curves::tendon_energy(end, &user), tendon, 1e-8) << end;
        }
    }

    class Tables : public ::testing::Test
    {
    protected:
      std::filesystem::path folder_ = test::temporary("curve_tables");

      void SetUp() override { std::filesystem::create_directories(folder_); }
      void TearDown() override { std::filesystem::remove_all(folder_); }

      std::shared_ptr<const CurveSet> read(const std::string &name, const std::string &text) const
      {
        std::ofstream(folder_ / "curve.csv") << text;
        std::ofstream(folder_ / "scene.xml") << "<ParameterList name=\"scene\"><Parameter name=\"type\" type=\"string\" value=\"table\"/>"
                                             << "<Parameter name=\"" << name << "\" type=\"string\" value=\"curve.csv\"/></ParameterList>";
        return read_curves(scene::read_scene(folder_ / "scene.xml", curves_schema()));
      }
    };

    TEST_F(Tables, GoThroughTheirPointsWithoutOvershoot)
    {
      const auto set = read("passive", "stretch,stress\n1,0\n1.2,0\n1.3, 0.5\n1.5,2\n\n1.6,2.1\n");
      ASSERT_TRUE(set);
      const curves::FibreCurves user        = set->view();
      const double              points[][2] = {{1, 0}, {1.2, 0}, {1.3, 0.5}, {1.5, 2}, {1.6, 2.1}};
      for (const auto &[s, stress] : points)
        EXPECT_NEAR(curves::passive(s, &user).value, stress, 1e-14);
      for (double s = 1; s < 1.6; s += 1e-3)
        EXPECT_GE(curves::passive(s, &user).slope, -1e-12) << s;
      EXPECT_NEAR(curves::passive(1.1, &user).value, 0, 1e-15);
      const double end = curves::passive(1.6, &user).slope;
      EXPECT_NEAR(curves::passive(2., &user).value, 2.1 + 0.4 * end, 1e-13);
      EXPECT_EQ(curves::active(1.1, &user).value, curves::active(1.1).value); // that of the thesis
    }

    TEST_F(Tables, HoldTheirEndValues)
    {
      const auto                set  = read("force-velocity", "strain rate,stress\n-1,0\n-0.5,0.3\n0,1\n1,1.5\n");
      const curves::FibreCurves user = set->view();
      EXPECT_EQ(curves::force_velocity(-2., &user).value, 0);
      EXPECT_EQ(curves::force_velocity(-2., &user).slope, 0);
      EXPECT_EQ(curves::force_velocity(1.5, &user).value, 1.5);
    }

    TEST_F(Tables, WhatIsWrongIsRefused)
    {
      for (const char *text : {"stretch,stress\n1,0\n1,0.1\n2,1\n3,2\n", "stretch,stress\n1,0\n2,1\n3,2\n", "length,stress\n1,0\n",
                               "stretch,stress\n1,a\n2,1\n3,2\n4,3\n", ""})
        EXPECT_THROW(read("active", text), InputError) << text;
    }
  } // namespace
} // namespace myolines
