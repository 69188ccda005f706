// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: a checkpoint gives back every bit, and says so if it cannot.

#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/oscillator/oscillator_system.h>
#include <myolines/output/checkpoint.h>

#include "folder.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

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
      checkpoint.inputs          = {{"/a/muscle.msh", "89abcdef"}};
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
  EXPECT_EQ(back.inputs, sample.checkpoint.inputs);
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
  EXPECT_NE(with("myolines checkpoint 1\n2\n{}").find("format 1, which has no checksums"), std::string::npos);
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

namespace
{
  /// A checkpoint in its parts, to be damaged in one of them.
  struct Parts
  {
    explicit Parts(const std::string &whole)
    {
      const std::size_t first = whole.find('\n') + 1, second = whole.find('\n', first) + 1, size = std::stoul(whole.substr(first));
      line    = whole.substr(0, first);
      length  = whole.substr(first, second - first);
      head    = whole.substr(second, size);
      vectors = whole.substr(second + size);
    }
    std::string text() const { return line + length + head + vectors; }
    std::string line, length, head, vectors;
  };

  using Random = std::mt19937;

  std::size_t below(const std::size_t n, Random &random) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); }

  void flip(std::string &text, Random &random) { text[below(text.size(), random)] ^= static_cast<char>(1 << below(8, random)); }

  void put(std::string &vectors, const std::size_t i, const double x) { std::memcpy(&vectors[i * sizeof x], &x, sizeof x); }

  /// One of the fields of the head, as the program writes it, between its name and the end of its line.
  std::pair<std::size_t, std::size_t> field(const std::string &head, Random &random)
  {
    std::vector<std::size_t> begins;
    for (std::size_t i = head.find("\n "); i != std::string::npos; i = head.find("\n ", i + 1))
      begins.push_back(i + 1);
    const std::size_t begin = begins[below(begins.size(), random)];
    return {begin, head.find('\n', begin) + 1};
  }

  struct Damage
  {
    const char *name;
    void (*inflict)(Parts &, Random &);
  };

  const std::vector<Damage> damages{
      {"cut off", [](Parts &p, Random &r) { p.vectors.resize(below(p.vectors.size(), r)); }},
      {"cut off in the head",
       [](Parts &p, Random &r) {
         p.head.resize(below(p.head.size(), r));
         p.vectors.clear();
       }},
      {"a bit of a vector", [](Parts &p, Random &r) { flip(p.vectors, r); }},
      {"a bit of the head", [](Parts &p, Random &r) { flip(p.head, r); }},
      {"a bit of the first line", [](Parts &p, Random &r) { flip(p.line, r); }},
      {"a bit of the length", [](Parts &p, Random &r) { flip(p.length, r); }},
      {"another length", [](Parts &p, Random &r) { p.length = std::to_string(p.head.size() + 1 + below(1000000, r)) + "\n"; }},
      {"a length beyond all numbers", [](Parts &p, Random &r) { p.length = std::string(20 + below(20, r), '9') + "\n"; }},
      {"a length less", [](Parts &p, Random &r) { p.length = std::to_string(below(p.head.size(), r)) + "\n"; }},
      {"not a number", [](Parts &p, Random &r) { put(p.vectors, below(p.vectors.size() / 8, r), std::nan("")); }},
      {"infinite", [](Parts &p, Random &r) { put(p.vectors, below(p.vectors.size() / 8, r), infinity); }},
      {"zeros", [](Parts &p, Random &r) { std::fill(p.vectors.begin() + below(p.vectors.size() - 8, r) / 8 * 8, p.vectors.end(), '\0'); }},
      {"bytes appended", [](Parts &p, Random &r) { p.vectors += std::string(1 + below(100, r), static_cast<char>(below(256, r))); }},
      {"a byte left out", [](Parts &p, Random &r) { p.vectors.erase(below(p.vectors.size(), r), 1); }},
      {"vectors swapped",
       [](Parts &p, Random &r) {
         const std::size_t size = 16, a = below(4, r), b = (a + 1 + below(3, r)) % 4;
         std::swap_ranges(p.vectors.begin() + a * size, p.vectors.begin() + (a + 1) * size, p.vectors.begin() + b * size);
       }},
      {"numbers swapped",
       [](Parts &p, Random &r) {
         const std::size_t i = below(4, r);
         std::swap_ranges(p.vectors.begin() + 16 * i, p.vectors.begin() + 16 * i + 8, p.vectors.begin() + 16 * i + 8);
       }},
      {"a field left out",
       [](Parts &p, Random &r) {
         const auto [begin, end] = field(p.head, r);
         p.head.erase(begin, end - begin);
         p.length = std::to_string(p.head.size()) + "\n";
       }},
      {"a field twice",
       [](Parts &p, Random &r) {
         const auto [begin, end] = field(p.head, r);
         p.head.insert(begin, p.head.substr(begin, end - begin));
         p.length = std::to_string(p.head.size()) + "\n";
       }},
      {"an empty time",
       [](Parts &p, Random &r) {
         const std::size_t begin = p.head.find("\"time [s]\": \"") + 13, end = p.head.find('"', begin);
         p.head.replace(begin, end - begin, std::string(below(3, r), ' '));
         p.length = std::to_string(p.head.size()) + "\n";
       }},
      {"a page of zeros", // as a file system leaves it after a crash
       [](Parts &p, Random &r) {
         std::string       all   = p.text();
         const std::size_t begin = below(all.size() - 64, r);
         std::fill(all.begin() + begin, all.begin() + begin + 64, '\0');
         p.line = all;
         p.length.clear();
         p.head.clear();
         p.vectors.clear();
       }},
      {"nothing", [](Parts &p, Random &) { p.line = p.length = p.head = p.vectors = ""; }}};

  /// That the program itself would write: the checksum of the head fits.
  std::string sealed(Parts parts)
  {
    Checksum checksum;
    parts.length = std::to_string(parts.head.size()) + "\n";
    checksum.add(parts.length + parts.head);
    parts.line = "myolines checkpoint 2 " + checksum.text() + "\n";
    return parts.text();
  }
} // namespace

TEST(Checkpoint, NoDamageIsAccepted)
{
  test::Folder                folder;
  Sample                      sample;
  const std::filesystem::path file = folder.path / "checkpoint";
  double                      next = 0; // zeros in a vector of zeros would be no damage
  for (Vector *x : {&sample.checkpoint.state.u, &sample.checkpoint.state.v, &sample.checkpoint.state.a})
    for (unsigned int i = 0; i < 2; ++i)
      (*x)(i) = 0.37 + ++next;
  Vector history = sample.checkpoint.state.u;
  history *= 3;
  sample.checkpoint.integrator.put("history: u", history);
  write_checkpoint(file, sample.checkpoint, sample.system);
  const std::string whole = folder.text("checkpoint");
  ASSERT_EQ(complaint(file, sample.system), "");
  for (std::size_t kind = 0; kind < damages.size(); ++kind)
    for (unsigned int seed = 0; seed < 40; ++seed)
      {
        Random random(1000 * static_cast<unsigned int>(kind) + seed);
        Parts  parts(whole);
        damages[kind].inflict(parts, random);
        ASSERT_NE(parts.text(), whole) << damages[kind].name << ", seed " << seed << ": no damage";
        std::ofstream(file, std::ios::binary) << parts.text();
        EXPECT_NE(complaint(file, sample.system), "") << damages[kind].name << ", seed " << seed;
      }
}

TEST(Checkpoint, AHeadThatIsNoneIsRefusedAlthoughItsChecksumFits)
{
  test::Folder                folder;
  const Sample                sample;
  const std::filesystem::path file = folder.path / "checkpoint";
  write_checkpoint(file, sample.checkpoint, sample.system);
  const Parts whole(folder.text("checkpoint"));
  std::ofstream(file, std::ios::binary) << sealed(whole);
  ASSERT_EQ(complaint(file, sample.system), "");
  for (const auto &[from, to] : {std::pair<std::string, std::string>{"\"0.3333333333333333\"", "\"\""},
                                 {"\"0.3333333333333333\"", "\"inf\""},
                                 {"\"0.3333333333333333\"", "\"0.3s\""},
                                 {"\"0.3333333333333333\"", "0.3"},
                                 {"\"-inf\"", "\"nan\""},
                                 {"\"steps\": 12", "\"steps\": \"12\""},
                                 {"\"unknowns\": 2", "\"unknowns\": 3"},
                                 {"\"unknowns\": 2", "\"unknowns\": -2"},
                                 {"\"inputs\"", "\"outputs of others\""}})
    {
      Parts parts = whole;
      ASSERT_NE(parts.head.find(from), std::string::npos) << from << "\n" << parts.head;
      parts.head.replace(parts.head.find(from), from.size(), to);
      std::ofstream(file, std::ios::binary) << sealed(parts);
      EXPECT_NE(complaint(file, sample.system), "") << from << " -> " << to;
    }
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
  catch (const SystemError &error)
    {
      EXPECT_EQ(error.error_number(), ENOENT);
      EXPECT_NE(std::string(error.what()).find("missing/checkpoint"), std::string::npos);
    }
}
