// SPDX-License-Identifier: LGPL-2.1-or-later
// Quantities whose samples stand in a file.
#include "../support/complaint.h"
#include "../support/temporary.h"

#include <myolines/system/file_drive.h>
#include <myolines/system/zajac.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace myolines;

namespace
{
  class FileDriveTest : public ::testing::Test
  {
  protected:
    using FileSettings = std::vector<scene::Setting>;

    const Driven          number_{"strain", "-"}, excitation_{"excitation", "-", scene::Range::closed(0, 1)};
    std::filesystem::path file_ = test::temporary("file_drive.csv");

    void write(const std::string &text) const { std::ofstream(file_) << text; }

    std::shared_ptr<const Drive> make(const Driven &driven, const FileSettings &more = {}) const
    {
      FileSettings settings{{"type", "file"}, {"file", file_.string()}};
      settings.insert(settings.end(), more.begin(), more.end());
      return make_drive(scene::compose_scene(drive_schema(driven.quantity, driven.unit), settings), driven);
    }

    std::string refusal_of(const Driven &driven, const FileSettings &more = {}) const
    {
      return test::complaint([&] { make(driven, more); });
    }

    /// A muscle at @p level, 30 % of it until 1 s, 1 kHz: a tone of 100 Hz, whose mean absolute value is 2/pi, above an offset.
    void write_emg() const
    {
      std::ostringstream text;
      text << "Time [ms],EMG [mV],trigger\n";
      for (unsigned int i = 0; i <= 2000; ++i)
        text << i << "," << 0.05 + (i < 1000 ? 0.3 : 1) * std::sin(0.2 * M_PI * (i + 0.5)) << ",0\n";
      write(text.str());
    }
  };

  TEST_F(FileDriveTest, ReadsNamesAndUnits)
  {
    write("t;strain [%]\n0;0\n0,5;-5\n1;-10\n");
    const auto drive = make(number_, {{"scale", "2"}, {"shift", "0.25"}});
    EXPECT_NEAR(drive->value(0.75), -0.1, 1e-15);
    EXPECT_NEAR(drive->first_derivative(0.5), -0.2, 1e-14);
    EXPECT_TRUE(drive->kinks(0.25, 1.25).empty());
    EXPECT_EQ(make(number_, {{"interpolation", "lines"}})->kinks(0, 1), (std::vector<double>{0.5}));

    write("time,a,motion\n0,7,0\n1,7,3\n");
    EXPECT_NEAR(make(Driven{"motion", "m"}, {{"column", "Motion"}, {"unit", "mm"}})->value(1), 3e-3, 1e-15);
    EXPECT_NE(refusal_of(number_).find("3 columns"), std::string::npos);
    EXPECT_NE(refusal_of(number_, {{"column", "motoin"}}).find("\"motion\""), std::string::npos);
    EXPECT_NE(refusal_of(number_, {{"column", "motion"}, {"unit", "mm"}}).find("is in \"mm\""), std::string::npos);
    EXPECT_NE(refusal_of(number_, {{"column", "a"}, {"time column", "when"}}).find("\"when\""), std::string::npos);

    write("time,x\n0,1\n1,2\n1,3\n");
    EXPECT_NE(refusal_of(number_).find("line 4"), std::string::npos);
    write("time,x\n0,1\n1,\n2,3\n");
    EXPECT_NE(refusal_of(number_).find("line 3"), std::string::npos);
    write("time,x\n0,1\n");
    EXPECT_NE(refusal_of(number_).find("fewer than two"), std::string::npos);
  }

  TEST_F(FileDriveTest, AnglesAreInDegreesUnlessTheFileSaysRadians)
  {
    const Driven angle{"rotation about z", "degree"}, length{"translation z", "m"};
    const auto   write_motion = [this](const std::string &said, const std::string &name) {
      write("gait\n" + said + "endheader\ntime\t" + name + "\n0\t0\n1\t0.5\n");
    };
    write_motion("inDegrees=no\n", "hip");
    EXPECT_NEAR(make(angle)->value(1), 90 / M_PI, 1e-13);
    EXPECT_EQ(make(angle, {{"unit", "deg"}})->value(1), 0.5);
    EXPECT_EQ(make(length)->value(1), 0.5);
    write_motion("inDegrees=no\n", "hip [deg]");
    EXPECT_EQ(make(angle)->value(1), 0.5);
    for (const char *said : {"inDegrees=yes\n", ""})
      {
        write_motion(said, "hip");
        EXPECT_EQ(make(angle)->value(1), 0.5) << said;
      }
  }

  TEST_F(FileDriveTest, KeepsBounds)
  {
    write("t,u\n0,0\n0.1,-1e-9\n0.2,1.0000001\n0.3,1\n0.4,0\n");
    const auto drive = make(excitation_);
    for (double t = 0; t <= 0.4; t += 0.003)
      {
        EXPECT_GE(drive->value(t), 0);
        EXPECT_LE(drive->value(t), 1);
      }
    EXPECT_LT(make(number_)->value(0.05), 0); // without bounds it is the spline

    write("t,u\n0,10\n1,43\n");
    EXPECT_NE(refusal_of(excitation_).find("percent?"), std::string::npos);
    EXPECT_NE(refusal_of(excitation_).find("numbers from 0 to 1"), std::string::npos);
    EXPECT_NEAR(make(excitation_, {{"unit", "%"}})->value(1), 0.43, 1e-15);
    write("t,u\n0,-0.1\n1,0.2\n");
    EXPECT_NE(refusal_of(excitation_).find("raw EMG?"), std::string::npos);
  }

  // A burst of 0.2 s: the filter swings below zero beside it, and above one in it.
  TEST_F(FileDriveTest, CutsOffWhereTheFilterOvershoots)
  {
    std::ostringstream text;
    text << "t,u\n";
    for (unsigned int i = 0; i <= 1000; ++i)
      text << i * 1e-3 << "," << (i > 400 && i < 600 ? 1 : 0) << "\n";
    write(text.str());
    const auto bounded = make(excitation_, {{"low-pass", "6"}}), free = make(number_, {{"low-pass", "6"}});
    EXPECT_LT(file_of(free.get())->extremes().least, -0.03);
    EXPECT_EQ(file_of(bounded.get())->extremes().least, 0);
    EXPECT_LE(file_of(bounded.get())->extremes().greatest, 1);
    EXPECT_NEAR(bounded->value(0.43), free->value(0.43), 1e-6);
    EXPECT_TRUE(bounded->kinks(0, 1).empty());
    EXPECT_NE(file_of(bounded.get())->note().find("is cut off"), std::string::npos);
    EXPECT_EQ(file_of(free.get())->note(), "");
  }

  TEST_F(FileDriveTest, MakesAnEnvelopeOfEmg)
  {
    write_emg();
    const FileSettings envelope{{"column", "EMG"}, {"rectify", "true"}, {"low-pass", "6"}};
    FileSettings       by_own = envelope, by_mvc = envelope;
    by_own.push_back({"normalise", "maximum"});
    by_mvc.push_back({"normalise", "2"});
    const auto own = make(excitation_, by_own), mvc = make(excitation_, by_mvc);
    // the mean of |sin| at five phases of half a period
    const double mean = (std::sin(0.1 * M_PI) + std::sin(0.3 * M_PI)) * 2 / 5 + 1. / 5;
    EXPECT_NEAR(mvc->value(1.6), mean / 2, 1e-3);
    EXPECT_NEAR(mvc->value(0.4), 0.3 * mean / 2, 1e-3);
    EXPECT_NEAR(own->value(0.4) / own->value(1.6), 0.3, 1e-3);
    EXPECT_NEAR(file_of(own.get())->extremes().greatest, 1, 1e-6);
    EXPECT_NE(refusal_of(excitation_, envelope).find("is in \"mV\""), std::string::npos);
    EXPECT_NE(refusal_of(excitation_, {{"column", "EMG"}, {"normalise", "peak"}}).find("is no maximum"), std::string::npos);
    EXPECT_NE(refusal_of(excitation_, {{"column", "trigger"}, {"normalise", "maximum"}}).find("nothing can be divided"), std::string::npos);
    EXPECT_NE(refusal_of(excitation_, {{"column", "trigger"}, {"low-pass", "6"}, {"interpolation", "lines"}}).find("do not smooth"),
              std::string::npos);

    const ZajacActivation activation(Zajac(), own);
    EXPECT_NEAR(activation.value(0.4, Side::left), Zajac().steady(own->value(0.4)), 1e-3);
    EXPECT_EQ(file_of(&activation), own.get());
  }

  /// With beta = 1 the equation is linear: u = t gives a = t - tau (1 - exp(-t/tau)).
  TEST_F(FileDriveTest, ActivationIsTheSolutionOfItsEquation)
  {
    const Zajac           linear{0.045, 1};
    const ZajacActivation activation(
        linear, make_drive(scene::list_of_defaults(drive_schema("excitation", "-"), "test", {"type=control points", "points=0 0; 1 1"}),
                           excitation_));
    for (const double t : {0.01, 0.1, 0.5})
      {
        const double decay = std::exp(-t / linear.time_constant);
        EXPECT_NEAR(activation.value(t, Side::left), t + linear.time_constant * std::expm1(-t / linear.time_constant), 1e-10) << t;
        EXPECT_NEAR(activation.first_derivative(t, Side::left), 1 - decay, 1e-8) << t;
        EXPECT_NEAR(activation.second_derivative(t, Side::left), decay / linear.time_constant, 1e-6) << t;
      }
    EXPECT_EQ(activation.second_derivative(0, Side::left), 0) << "before the start it is steady";
    EXPECT_NEAR(activation.second_derivative(0, Side::right), 1 / linear.time_constant, 1e-9);
  }

  /// Of the equation that is not linear, by differences.
  TEST_F(FileDriveTest, ActivationHasItsSecondDerivative)
  {
    const ZajacActivation activation(Zajac(), make_drive(scene::list_of_defaults(drive_schema("excitation", "-"), "test",
                                                                                 {"type=control points", "points=0 0.1; 1 0.9"}),
                                                         excitation_));
    const double          h = 1e-5;
    for (const double t : {0.02, 0.1, 0.5, 0.9})
      {
        const double difference =
            (activation.first_derivative(t + h, Side::left) - activation.first_derivative(t - h, Side::left)) / (2 * h);
        EXPECT_NEAR(activation.second_derivative(t, Side::left), difference, 1e-5 * std::abs(difference) + 1e-5) << t;
      }
  }

  /// A ramp of the excitation from the start on, whenever that is; an excitation of samples is followed from the first of them.
  TEST_F(FileDriveTest, ActivationBeginsWhereTheRunDoes)
  {
    const auto at = [this](const double start, const double later) {
      std::ostringstream points;
      points.precision(17);
      points << "points=" << start << " 0.2; " << start + 0.125 << " 1";
      const ZajacActivation activation(
          Zajac(),
          make_drive(scene::list_of_defaults(drive_schema("excitation", "-"), "test", {"type=control points", points.str()}), excitation_));
      activation.begin(start);
      EXPECT_NEAR(activation.value(start, Side::right), Zajac().steady(0.2), 1e-12);
      EXPECT_NEAR(activation.first_derivative(start, Side::right), 0, 1e-9);
      return activation.value(start + later, Side::left);
    };
    for (const double later : {0.0625, 0.25})
      for (const double start : {-5., -0.125, 64., 1048576., 1e10})
        EXPECT_NEAR(at(start, later), at(0, later), start < 1e9 ? 1e-9 : 1e-5) << start;
    write("t,u\n-1,0.2\n0,0.2\n1,0.8\n");
    const ZajacActivation sampled(Zajac(), make(excitation_));
    const double          before = sampled.value(0.5, Side::left);
    sampled.begin(0.25);
    EXPECT_EQ(sampled.value(0.5, Side::left), before);
  }

  TEST_F(FileDriveTest, TellsWhatTimesItKnows)
  {
    write("t,u\n0.6,0.2\n0.7,0.2\n0.9,0.2\n");
    const auto       drive = make(excitation_);
    const FileDrive *file  = file_of(drive.get());
    ASSERT_NE(file, nullptr);
    EXPECT_NO_THROW(file->require(0.6, 0.3 + 0.6));
    EXPECT_NO_THROW(file->require(0.7, 0.8));
    const std::string refusal = test::complaint([&] { file->require(0, 0.8); });
    EXPECT_NE(refusal.find("from 0.6 s to 0.9 s"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("from 0 s to 0.8 s"), std::string::npos) << refusal;
    EXPECT_THROW(file->require(0.6, 0.91), InputError);
    EXPECT_EQ(ZajacActivation(Zajac(), drive).value(0.6, Side::right), Zajac().steady(0.2));
  }

  /// Half a second at 100 Hz whose times are milliseconds, and nobody says so.
  TEST_F(FileDriveTest, TellsWhereTheRunSeesFewSamples)
  {
    const auto note = [this](const std::string &time, const double end, const int last = 50) {
      std::string text = time + ",u\n";
      for (int i = 0; i <= last; ++i)
        text += std::to_string(10 * i) + ",0.2\n";
      write(text);
      const auto drive = make(excitation_);
      return file_of(drive.get())->note_of_times(0, end);
    };
    EXPECT_NE(note("time", 0.5).find("only 1 of the 51 samples"), std::string::npos) << note("time", 0.5);
    EXPECT_NE(note("time", 0.5, 20).find("only 1 of the 21 samples"), std::string::npos) << "the run is between two of them";
    EXPECT_EQ(note("time", 10, 20), "");
    EXPECT_EQ(note("time", 0.5, 5), "") << "a few points, far apart";
    EXPECT_EQ(note("time [ms]", 0.5), "");
    EXPECT_EQ(note("time", 100), "");
  }
} // namespace
