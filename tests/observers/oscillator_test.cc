// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/outputs.h>
#include <myolines/system/drive.h>

#include "../output/folder.h"

using namespace myolines;

namespace
{
  /// s(t) = t: a support at unit speed.
  class Ramp : public Drive
  {
  public:
    double              value(const double t, Side) const override { return t; }
    double              first_derivative(double, Side) const override { return 1; }
    double              second_derivative(double, Side) const override { return 0; }
    std::vector<double> kinks(double, double) const override { return {}; }
  };

  scene::Node output_scene(const std::string &series)
  {
    return scene::parse_scene("<ParameterList name=\"scene\"><ParameterList name=\"series\">" + series + "</ParameterList></ParameterList>",
                              oscillator_output_schema());
  }

  StepRecord step(const std::size_t number)
  {
    StepRecord record;
    record.number = number;
    return record;
  }
} // namespace

TEST(OscillatorTrajectory, RowsOfTheStatesSeen)
{
  test::Folder           folder;
  WorkLedger             ledger;
  const OscillatorSystem system(OscillatorParameters{}, ledger);
  const auto observers = make_outputs(output_scene("<Parameter name=\"every\" type=\"int\" value=\"2\"/>"), system, folder.path, ledger);

  State state = system.initial_state(0);
  observers[0]->begin(state);
  for (std::size_t n = 1; n <= 5; ++n)
    {
      state.t    = 0.1 * n;
      state.u[0] = 1. / n;
      state.v[0] = -2. * n;
      state.a[0] = 3. * n;
      observers[0]->accepted(state, step(n));
    }
  const std::vector<std::string> lines = folder.lines("trajectory.csv");
  ASSERT_EQ(lines.size(), 4u); // header, start, steps 2 and 4
  EXPECT_EQ(lines[0], "Time [s],Displacement [m],Velocity [m/s],Acceleration [m/s^2]");
  EXPECT_EQ(test::numbers(lines[1])[1], 1); // the default start, u(0) = 1 m
  EXPECT_EQ(test::numbers(lines[2]), (std::vector<double>{0.2, 0.5, -4, 6}));
  EXPECT_EQ(test::numbers(lines[3]), (std::vector<double>{0.4, 0.25, -8, 12}));
}

TEST(OscillatorTrajectory, SupportForceBalancesSpringAndDamper)
{
  test::Folder         folder;
  WorkLedger           ledger;
  OscillatorParameters p;
  p.mass = 2, p.damping = 3, p.stiffness = 5, p.cubic_stiffness = 7;
  p.support = std::make_shared<Ramp>();
  const OscillatorSystem system(p, ledger);
  const auto             observers = make_outputs(output_scene(""), system, folder.path, ledger);

  State state = system.initial_state(0);
  state.t     = 0.5;
  system.prescribed(0.5, Side::left, state);
  state.u[0] = 0.7;
  state.v[0] = -0.4;
  state.a[0] = 0.9;
  observers[0]->accepted(state, step(1));

  const std::vector<double> row = test::numbers(folder.lines("trajectory.csv").at(1));
  ASSERT_EQ(row.size(), 6u);
  EXPECT_EQ(row[4], 0.5);
  const double spring = 5 * (0.7 - 0.5) + 3 * (-0.4 - 1) + 7 * 0.2 * 0.2 * 0.2; // what pulls the mass back to the support
  EXPECT_NEAR(row[5], -spring, 1e-14);
}
