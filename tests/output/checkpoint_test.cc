// Requirement: a checkpoint gives back every bit, and says so if it cannot.

#include <myolines/base/error.h>
#include <myolines/oscillator/oscillator_system.h>
#include <myolines/output/checkpoint.h>

#include "folder.h"

#include <cmath>
#include <limits>

using namespace myolines;

namespace
{
  constexpr double infinity = std::numeric_limits<double>::infinity();

  struct Sample
  {
    explicit Sample(const double stiffness = 1)
      : system(parameters(stiffness), ledger)
    {
      checkpoint.step  = 12;
      checkpoint.state = system.initial_state(1 / 3.);
      for (Vector *x : {&checkpoint.state.u, &checkpoint.state.v, &checkpoint.state.a})
        {
          (*x)(0) = -0.;
          (*x)(1) = 1e-310 * ++filled;
        }
      checkpoint.control.put("cuts", -infinity);
      checkpoint.outputs.put_numbers("works", {0.1, -0., 1e300});
      checkpoint.integrator.put("history: size", 0.7);
      checkpoint.integrator.put("history: u", checkpoint.state.v);
      checkpoint.ledger.count("accepted steps", 12);
      checkpoint.ledger.add_seconds("residual", 0.25);
      checkpoint.scene           = "<ParameterList name=\"scene\"/>\n";
      checkpoint.ranks           = 3;
      checkpoint.instruction_set = "AVX2";
    }

    static OscillatorParameters parameters(const double stiffness)
    {
      OscillatorParameters parameters;
      parameters.stiffness = stiffness;
      parameters.support   = std::make_shared<Rest>();
      return parameters;
    }

    struct Rest : Drive
    {
      double              value(double, Side) const override { return 0; }
      double              first_derivative(double, Side) const override { return 0; }
      double              second_derivative(double, Side) const override { return 0; }
      std::vector<double> kinks(double, double) const override { return {}; }
    };

    int              filled = 0;
    WorkLedger       ledger;
    OscillatorSystem system;
    Checkpoint       checkpoint;
  };

  void expect_same_bits(const Vector &x, const Vector &y)
  {
    ASSERT_EQ(x.size(), y.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        EXPECT_EQ(x(i), y(i));
        EXPECT_EQ(std::signbit(x(i)), std::signbit(y(i)));
      }
  }

  /// What reading @p file says; "" if it can be read.
  std::string complaint(const std::filesystem::path &file, const SemiDiscreteSystem &system)
  {
    try
      {
        CheckpointReader(file).read(system);
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.problems()[0].where, file.string());
        return error.what();
      }
    return "";
  }
} // namespace

TEST(Checkpoint, GivesBackEveryBit)
{
  test::Folder folder;
  const Sample sample;
  write_checkpoint(folder.path / "checkpoint", sample.checkpoint, sample.system);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1) << "nothing else is left";

  const Checkpoint back = CheckpointReader(folder.path / "checkpoint").read(sample.system);
  EXPECT_EQ(back.step, 12u);
  EXPECT_EQ(back.state.t, 1 / 3.);
  expect_same_bits(back.state.u, sample.checkpoint.state.u);
  expect_same_bits(back.state.v, sample.checkpoint.state.v);
  expect_same_bits(back.state.a, sample.checkpoint.state.a);
  EXPECT_EQ(back.control.number("cuts"), -infinity);
  EXPECT_EQ(back.outputs.numbers("works"), sample.checkpoint.outputs.numbers("works"));
  EXPECT_TRUE(std::signbit(back.outputs.numbers("works")[1]));
  EXPECT_EQ(back.integrator.number("history: size"), 0.7);
  Vector history = back.state.u;
  back.integrator.read("history: u", history);
  expect_same_bits(history, sample.checkpoint.state.v);
  EXPECT_EQ(back.ledger.counts(), sample.checkpoint.ledger.counts());
  EXPECT_EQ(back.ledger.seconds(), sample.checkpoint.ledger.seconds());
  EXPECT_EQ(back.scene, sample.checkpoint.scene);
  EXPECT_EQ(back.ranks, 3u);
  EXPECT_EQ(back.instruction_set, "AVX2");
}

TEST(Checkpoint, GivesAVectorWithoutTheSystem)
{
  test::Folder folder;
  const Sample sample;
  write_checkpoint(folder.path / "checkpoint", sample.checkpoint, sample.system);
  const std::vector<unsigned int> order = sample.system.canonical_order();
  for (const auto &[name, vector] :
       {std::pair<const char *, const Vector *>{"u", &sample.checkpoint.state.u}, {"v", &sample.checkpoint.state.v}})
    {
      const std::vector<double> whole = CheckpointReader(folder.path / "checkpoint").whole(name);
      ASSERT_EQ(whole.size(), order.size());
      for (std::size_t i = 0; i < order.size(); ++i)
        EXPECT_EQ(whole[i], (*vector)(order[i]));
    }
  std::ofstream(folder.path / "short", std::ios::binary) << folder.text("checkpoint").substr(0, folder.text("checkpoint").size() - 60);
  EXPECT_THROW(CheckpointReader(folder.path / "short").whole("a"), InputError);
}

TEST(Checkpoint, TheOldOneStandsUntilTheNewOneIsWhole)
{
  // What a kill while writing leaves: a part of the new file beside the old one.
  test::Folder folder;
  const Sample sample;
  write_checkpoint(folder.path / "checkpoint", sample.checkpoint, sample.system);
  std::ofstream(folder.path / "checkpoint.new") << folder.text("checkpoint").substr(0, 100);
  EXPECT_EQ(CheckpointReader(folder.path / "checkpoint").contents().step, 12u);

  Checkpoint later = sample.checkpoint;
  later.step       = 13;
  write_checkpoint(folder.path / "checkpoint", later, sample.system);
  EXPECT_EQ(CheckpointReader(folder.path / "checkpoint").contents().step, 13u);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "checkpoint.new"));
}

TEST(Checkpoint, WhatCannotBeReadIsNamed)
{
  test::Folder                folder;
  const Sample                sample;
  const std::filesystem::path file = folder.path / "checkpoint";
  EXPECT_NE(complaint(file, sample.system).find("there is no checkpoint"), std::string::npos);

  write_checkpoint(file, sample.checkpoint, sample.system);
  const std::string whole = folder.text("checkpoint");
  const auto        with  = [&](const std::string &text) {
    std::ofstream(file, std::ios::binary) << text;
    return complaint(file, sample.system);
  };
  EXPECT_EQ(with(whole), "");
  EXPECT_NE(with("something else\n").find("not a checkpoint of this version"), std::string::npos);
  EXPECT_NE(with(whole.substr(0, 200)).find("cut off"), std::string::npos);
  EXPECT_NE(with(whole.substr(0, whole.size() - 1)).find("damaged"), std::string::npos);
  std::string scrambled = whole;
  scrambled.replace(whole.find("\"steps\""), 7, "\"stops\"");
  EXPECT_NE(with(scrambled).find("damaged"), std::string::npos);

  OscillatorParameters   alone;
  WorkLedger             ledger;
  const OscillatorSystem smaller(alone, ledger);
  with(whole);
  EXPECT_NE(complaint(file, smaller).find("2 unknowns, the system has 1"), std::string::npos);
}

TEST(Checkpoint, ADiskThatRefusesIsNamed)
{
  test::Folder folder;
  const Sample sample;
  try
    {
      write_checkpoint(folder.path / "missing" / "checkpoint", sample.checkpoint, sample.system);
      FAIL() << "a checkpoint in a missing folder was written";
    }
  catch (const std::runtime_error &error)
    {
      EXPECT_NE(std::string(error.what()).find("missing/checkpoint"), std::string::npos);
    }
}
