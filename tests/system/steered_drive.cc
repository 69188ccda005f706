// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: a steered drive follows what it was told, from the instant on at which it was told, and shows every kink.

#include <myolines/base/error.h>
#include <myolines/system/drive_types.h>
#include <myolines/system/steered_drive.h>
#include <myolines/system/zajac.h>

#include <gtest/gtest.h>

using namespace myolines;

namespace
{
  struct Steered
  {
    std::shared_ptr<Steering> steering = std::make_shared<Steering>("system/activation", "scene.xml: system/activation/value",
                                                                    Driven{"activation", "-", scene::Range::closed(0, 1)}, 0.25);
    SteeredDrive              drive{steering};
  };

  std::string refusal_of(const std::function<void()> &what)
  {
    try
      {
        what();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "accepted";
  }
} // namespace

TEST(SteeredDrive, StartsConstantAndJumps)
{
  Steered s;
  EXPECT_EQ(s.drive.value(-5, Side::left), 0.25);
  EXPECT_TRUE(s.drive.kinks(-10, 10).empty());
  EXPECT_FALSE(s.drive.identically_zero()); // nothing skips what may be set later
  s.steering->go_to(1, 2);
  EXPECT_EQ(s.drive.value(2, Side::left), 0.25);
  EXPECT_EQ(s.drive.value(2, Side::right), 1);
  EXPECT_EQ(s.drive.kinks(0, 3), std::vector<double>{2});
  EXPECT_TRUE(s.drive.kinks(2, 3).empty()); // an open interval
  s.steering->go_to(0.5, 2);                // said again at the same instant: the former word is void
  EXPECT_EQ(s.drive.value(2, Side::left), 0.25);
  EXPECT_EQ(s.drive.value(3, Side::left), 0.5);
}

TEST(SteeredDrive, RampsFromWhereItIs)
{
  Steered s;
  s.steering->go_to(1, 1, 2);
  EXPECT_DOUBLE_EQ(s.drive.value(2, Side::left), 0.625);
  EXPECT_DOUBLE_EQ(s.drive.first_derivative(2, Side::left), 0.375);
  EXPECT_EQ(s.drive.first_derivative(1, Side::left), 0);
  EXPECT_EQ(s.drive.kinks(0, 5), (std::vector<double>{1, 3}));
  s.steering->go_to(0, 2, 1); // half way
  EXPECT_DOUBLE_EQ(s.drive.value(2, Side::right), 0.625);
  EXPECT_DOUBLE_EQ(s.drive.first_derivative(2, Side::right), -0.625);
  EXPECT_DOUBLE_EQ(s.drive.first_derivative(2, Side::left), 0.375);
  EXPECT_EQ(s.drive.kinks(0, 5), (std::vector<double>{1, 2, 3})); // that of the former course at 3 is gone, this one has its own
}

TEST(SteeredDrive, ComesBack)
{
  Steered                 s;
  const Steering::Courses before = s.steering->courses();
  s.steering->follow(std::make_shared<Sine>(0.5, 1, 0, 0.5), 1);
  EXPECT_NEAR(s.drive.value(1.25, Side::left), 1, 1e-12);
  s.steering->put_back(before);
  EXPECT_EQ(s.drive.value(1.25, Side::left), 0.25);
}

TEST(SteeredDrive, RefusesWhatIsOutOfRange)
{
  Steered           s;
  const std::string said = refusal_of([&] { s.steering->go_to(1.5, 0); });
  EXPECT_NE(said.find("system/activation"), std::string::npos) << said;
  EXPECT_NE(said.find("1.5 [-] is out of range"), std::string::npos) << said;
  EXPECT_NE(refusal_of([&] { s.steering->go_to(std::nan(""), 0); }), "accepted");
  EXPECT_NE(refusal_of([&] { s.steering->go_to(0.5, 0, -1); }).find("a duration of -1 s"), std::string::npos);
  EXPECT_NE(refusal_of([&] { s.steering->follow(std::make_shared<Sine>(2, 1, 90, 0), 0.25); }), "accepted");
  EXPECT_EQ(s.drive.value(7, Side::left), 0.25); // nothing has changed
}

TEST(SteeredDrive, IsOneOfTheDrivesOfScenes)
{
  const auto drive = make_drive(scene::compose_scene(drive_schema("force", "N"), {{"type", "steered"}, {"value", "-3"}}));
  EXPECT_EQ(drive->value(0, Side::left), -3);
  const auto steering = steering_of(drive.get());
  ASSERT_NE(steering, nullptr);
  EXPECT_EQ(steering_of(make_drive(scene::compose_scene(drive_schema("force", "N"), {})).get()), nullptr);
  const std::shared_ptr<const Drive> shared = make_drive(scene::compose_scene(drive_schema("excitation", "-"), {{"type", "steered"}}));
  EXPECT_NE(refusal_of([&] { ZajacActivation(Zajac{}, shared); }).find("beforehand"), std::string::npos);
}
