// SPDX-License-Identifier: LGPL-2.1-or-later
// What every kind of given function of time must keep, whatever it is: those of the list, and one that is added as a plug-in adds it.
#include "../support/temporary.h"

#include <myolines/system/profiles.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace myolines;

namespace
{
  /// |t - 0.5|, times a factor: a kink in the middle.
  class Vee : public Drive
  {
  public:
    explicit Vee(const double factor)
      : factor_(factor)
    {}
    double value(const double t, Side) const override { return factor_ * std::abs(t - 0.5); }
    double first_derivative(const double t, const Side side) const override
    {
      return (side == Side::right ? t >= 0.5 : t > 0.5) ? factor_ : -factor_;
    }
    double              second_derivative(double, Side) const override { return 0; }
    std::vector<double> kinks(const double t0, const double t1) const override
    {
      return t0 < 0.5 && 0.5 < t1 ? std::vector<double>{0.5} : std::vector<double>{};
    }

  private:
    const double factor_;
  };

  ProfileEntry vee_profile()
  {
    return {"vee",
            {"factor=3"},
            [](const std::string &quantity, const std::string &unit) {
              scene::Schema schema("Down and up again.");
              schema.number("factor", std::nullopt, unit + "/s", scene::Range::any(), "Rate of the " + quantity + ".");
              return schema;
            },
            [](const scene::Node &node, const Driven &) { return std::make_unique<Vee>(node.number("factor")); }};
  }

  std::vector<ProfileEntry> every_profile()
  {
    if (profile_registry().find("vee") == nullptr)
      profile_registry().add(vee_profile());
    return {profile_registry().begin(), profile_registry().end()};
  }

  class EveryProfile : public ::testing::TestWithParam<ProfileEntry>
  {
  protected:
    static constexpr double from_ = -0.3, to_ = 1.3, margin_ = 1e-4;

    /// As a scene makes it from the example of its entry.
    EveryProfile()
    {
      const std::filesystem::path samples = test::temporary("samples.csv");
      std::ofstream(samples) << "time [s],x [-]\n-0.5,0.1\n0,0.2\n0.3,0.9\n0.8,0.4\n1.5,0.7\n";
      std::vector<scene::Setting> settings{{"type", GetParam().name}};
      for (const std::string &setting : GetParam().example)
        {
          const std::size_t equals = setting.find('=');
          const std::string text   = setting.substr(equals + 1);
          settings.push_back({setting.substr(0, equals), text == samples.filename() ? samples.string() : text});
        }
      drive_ = make_drive(scene::compose_scene(drive_schema("strain", "-"), settings));
    }

    std::unique_ptr<Drive> drive_;

    /// Times that are none of its kinks and not beside one.
    std::vector<double> smooth_times() const
    {
      const std::vector<double> kinks = drive_->kinks(from_, to_);
      std::vector<double>       times;
      for (double t = from_ + 1e-3 * M_SQRT2; t < to_; t += 1e-3)
        if (std::none_of(kinks.begin(), kinks.end(), [t](const double kink) { return std::abs(t - kink) < margin_; }))
          times.push_back(t);
      return times;
    }

    /// The largest |second derivative| there, and 1.
    double scale() const
    {
      double most = 1;
      for (const double t : smooth_times())
        most = std::max(most, std::abs(drive_->second_derivative(t)));
      return most;
    }
  };

  TEST_P(EveryProfile, HasTheDerivativesOfItsValue)
  {
    const double h = 1e-6, tolerance = 1e-3 * scale();
    for (const double t : smooth_times())
      {
        ASSERT_NEAR(drive_->first_derivative(t), (drive_->value(t + h) - drive_->value(t - h)) / (2 * h), tolerance) << t;
        ASSERT_NEAR(drive_->second_derivative(t), (drive_->first_derivative(t + h) - drive_->first_derivative(t - h)) / (2 * h), tolerance)
            << t;
      }
  }

  TEST_P(EveryProfile, HasTwoSidesAtKinksAlone)
  {
    const auto jump = [this](const double t) {
      return std::max({std::abs(drive_->value(t, Side::right) - drive_->value(t, Side::left)),
                       std::abs(drive_->first_derivative(t, Side::right) - drive_->first_derivative(t, Side::left)),
                       std::abs(drive_->second_derivative(t, Side::right) - drive_->second_derivative(t, Side::left))});
    };
    for (const double t : smooth_times())
      ASSERT_EQ(jump(t), 0) << t;
    for (const double t : drive_->kinks(from_, to_))
      {
        EXPECT_GT(jump(t), 1e-6) << t;
        for (const Side side : {Side::left, Side::right}) // the limits from that side
          {
            const double away = t + (side == Side::left ? -1e-9 : 1e-9);
            EXPECT_NEAR(drive_->value(t, side), drive_->value(away), 1e-7 * scale()) << t;
            EXPECT_NEAR(drive_->first_derivative(t, side), drive_->first_derivative(away), 1e-7 * scale()) << t;
            EXPECT_NEAR(drive_->second_derivative(t, side), drive_->second_derivative(away), 1e-6 * scale()) << t;
          }
      }
  }

  TEST_P(EveryProfile, HasItsKinksInTheOpenInterval)
  {
    const std::vector<double> kinks = drive_->kinks(from_, to_);
    EXPECT_TRUE(std::is_sorted(kinks.begin(), kinks.end()));
    for (const double kink : kinks)
      {
        EXPECT_EQ(drive_->kinks(kink - 0.01, kink + 0.01), (std::vector<double>{kink}));
        EXPECT_TRUE(drive_->kinks(kink, kink + 0.01).empty());
        EXPECT_TRUE(drive_->kinks(kink - 0.01, kink).empty());
      }
  }

  TEST_P(EveryProfile, IsNotZero)
  {
    EXPECT_FALSE(drive_->identically_zero());
    const std::vector<double> times = smooth_times();
    EXPECT_TRUE(std::any_of(times.begin(), times.end(), [this](const double t) { return std::abs(drive_->value(t)) > 0.01; }));
  }

  std::string test_name(const ::testing::TestParamInfo<ProfileEntry> &info)
  {
    std::string name = info.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }

  INSTANTIATE_TEST_SUITE_P(All, EveryProfile, ::testing::ValuesIn(every_profile()), test_name);
} // namespace

TEST(Profiles, OfScenesAreThoseOfTheList)
{
  const std::vector<ProfileEntry> all    = every_profile();
  const scene::Schema             schema = drive_schema("force", "N");
  ASSERT_EQ(schema.variant()->alternatives.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(schema.variant()->alternatives[i].first, all[i].name);
  EXPECT_THROW(profile_registry().add(vee_profile()), std::logic_error);
}
