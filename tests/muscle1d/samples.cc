// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/complaint.h"
#include "../support/temporary.h"
#include "run.h"

#include <myolines/base/error.h>
#include <myolines/muscle1d/gait.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  struct File
  {
    explicit File(const std::string &text)
      : path(myolines::test::temporary("samples.csv"))
    {
      std::ofstream(path) << text;
    }
    ~File() { std::filesystem::remove(path); }
    const std::filesystem::path path;
  };

  using test::complaint;
} // namespace

// The gait from a file gives what the gait in closed form gives.
TEST(Samples, ofTheGaitMoveTheMuscleAsTheGaitDoes)
{
  std::ostringstream   text;
  const GaitLength     length(0.4122, 0.98, 1, 1.4);
  const GaitExcitation excitation(1.4);
  text.precision(15);
  text << "Time [s],length [m],excitation\n";
  for (double t = -0.1; t < 1.3; t += 0.002 + 0.0005 * std::sin(100 * t))
    text << t << "," << length.value(t, Side::left) << "," << excitation.value(t, Side::left) << "\n";
  const File file(text.str());
  const auto end = [&](const Overrides &input) {
    Overrides settings = unit_settings("mild", "1", "4");
    settings.insert(settings.end(), input.begin(), input.end());
    MuscleRun           run(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)), "ida", tolerances(1e-7, 1e-10, true));
    std::vector<double> result;
    run.go({1}, [&](const State &s) { result = {run.system.muscle_stretch(s.u), run.system.tendon_stretch(s.t, s.u)}; });
    return result;
  };
  const auto closed = end({}), sampled = end({"input/type=file", "input/file=" + file.path.string()});
  EXPECT_NEAR(sampled[0], closed[0], 2e-7);
  EXPECT_NEAR(sampled[1], closed[1], 2e-7);
}

TEST(Samples, thatCannotBeUsedAreRefused)
{
  const auto read = [](const std::string &text, const Overrides &more = {}) {
    const File file(text);
    Overrides  settings{"input/type=file", "input/file=" + file.path.string()};
    settings.insert(settings.end(), more.begin(), more.end());
    return complaint([&] { read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)); });
  };
  const std::string header = "Time [s],length [m],excitation\n";
  EXPECT_EQ(read(header + "0,0.4,0.1\n1,0.41,0.2\n"), "");
  EXPECT_EQ(read("Time [ms],length [mm],excitation [%]\n0,400,10\n1000,410,20\n"), "");
  EXPECT_EQ(read(header + "0.5,0.4,0.1\n1,0.41,-1e-9\n"), "");
  EXPECT_NE(read(header + "0,0.4,0.1\n1,0.41,1.2\n").find("excitation in"), std::string::npos);
  EXPECT_NE(read(header + "0,0.4,10\n1,0.41,43\n").find("percent?"), std::string::npos);
  EXPECT_NE(read(header + "0,0.4,0.1\n1,-0.41,0.2\n").find("from 0.2 to 5 times"), std::string::npos);
  EXPECT_NE(read(header + "0,400,0.1\n1,410,0.2\n").find("millimetres?"), std::string::npos);
  EXPECT_NE(read(header + "0,0.4,0.1\n1,0.41,0.2\n", {"input/interpolation=linear", "input/cut-off frequency=3"}).find("do not smooth"),
            std::string::npos);
}

// Length and excitation as profiles of their own, one of them from a file.
TEST(Samples, moveTheMuscleAsProfilesToo)
{
  const File file("t;u [%]\n-1;20\n0,5;20\n2;20\n");
  const auto parameters = read_muscle_tendon_unit(
      node(muscle_tendon_unit_schema(), {"input/type=profiles", "input/length/value=0.42", "input/excitation/type=file",
                                         "input/excitation/file=" + file.path.string()}));
  EXPECT_EQ(parameters.tendon->unit_length->value(1, Side::left), 0.42);
  EXPECT_NEAR(parameters.activation->value(1, Side::left), parameters.zajac.steady(0.2), 1e-9);
}

// A run that starts inside the samples starts in balance: the same as if the samples were shifted to zero.
TEST(Samples, mayBeginElsewhere)
{
  const auto start = [](const std::string &masses, const double shift) {
    std::ostringstream text;
    text << "Time [s],length [m],excitation\n";
    for (unsigned int i = 0; i <= 100; ++i)
      text << shift + i * 0.01 << "," << 0.42 + 0.005 * std::cos(0.1 * i) << "," << 0.3 + 0.2 * std::sin(0.1 * i) << "\n";
    const File           file(text.str());
    WorkLedger           ledger;
    const Muscle1dSystem system(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(),
                                                             {"masses=" + masses, "input/type=file", "input/file=" + file.path.string()})),
                                ledger);
    const State          state = system.initial_state(shift + 0.3);
    Vector               r(state.u);
    EXPECT_TRUE(system.residual({state.t, Side::right, state.u, state.v, state.a}, r).admissible);
    EXPECT_LT(r.linfty_norm(), 1e-8 * system.parameters().maximum_force);
    return std::pair(system.muscle_stretch(state.u), system.element_stretches(state.u));
  };
  for (const char *masses : {"0", "5"})
    {
      const auto zero = start(masses, 0), late = start(masses, 0.6);
      EXPECT_NEAR(zero.first, late.first, 1e-9);
      for (const double stretch : zero.second)
        EXPECT_NEAR(stretch, zero.first, 1e-12);
    }
}
