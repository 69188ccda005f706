// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/observers/outputs.h>

#include "../output/folder.h"
#include "../support/drives.h"
#include "../support/solvers.h"

using namespace myolines;
using myolines::testing::node;
using myolines::testing::Overrides;
using myolines::testing::sine;

namespace
{
  struct Outputs
  {
    explicit Outputs(const Overrides &settings)
      : system(parameters(), ledger)
      , observers(make_outputs(node(rod1d_output_schema(), settings), system, folder.path, ledger))
      , state(system.initial_state(0))
    {}

    static Rod1dParameters parameters()
    {
      Rod1dParameters p;
      p.n_elements = 2;
      p.degree     = 1;
      p.material   = RodMaterial::linear_elastic(1e6, 0.4);
      p.strain     = sine(0.1, 1);
      return p;
    }

    /// u = X t^3, v = X 3 t^2 at all nodes: what a cubic interpolates exactly.
    void at(const double t, const std::size_t number)
    {
      state.t = t;
      for (unsigned int i = 0; i < state.u.size(); ++i)
        {
          state.u[i] = system.position(i) * t * t * t;
          state.v[i] = system.position(i) * 3 * t * t;
          state.a[i] = 0;
        }
      StepRecord record;
      record.number = number;
      record.t      = t;
      record.dt     = 0.1;
      for (const auto &observer : observers)
        number == 0 ? observer->begin(state) : observer->accepted(state, record);
    }

    test::Folder                           folder;
    WorkLedger                             ledger;
    Rod1dSystem                            system;
    std::vector<std::unique_ptr<Observer>> observers;
    State                                  state;
  };
} // namespace

TEST(RodOutputs, traceAndReactions)
{
  Outputs run({"series/places=0.25 1", "series/every=2"});
  for (std::size_t n = 0; n <= 4; ++n)
    run.at(0.1 * n, n);
  const auto trace = run.folder.lines("trace.csv"), reaction = run.folder.lines("reaction.csv");
  ASSERT_EQ(trace.size(), 4u); // header, start, steps 2 and 4
  EXPECT_EQ(trace[0], "Time [s],u(0.25 L) [m],u(1 L) [m],v(0.25 L) [m/s],v(1 L) [m/s]");
  EXPECT_NEAR(test::numbers(trace[3])[1], 0.025 * 0.064, 1e-16);
  EXPECT_NEAR(test::numbers(trace[3])[4], 0.1 * 0.48, 1e-16);
  // E = 6e5 Pa, strain 0.064, 1e-4 m^2
  EXPECT_EQ(reaction[0], "Time [s],moving end x [N],fixed end x [N]");
  EXPECT_NEAR(test::numbers(reaction[3])[1], 6e5 * 0.064 * 1e-4, 1e-12);
  EXPECT_NEAR(test::numbers(reaction[3])[2], -6e5 * 0.064 * 1e-4, 1e-12);
}

TEST(RodOutputs, nodalStatesAtGivenTimes)
{
  Outputs run({"nodal states/times=0.35 0 0.2 7"});
  for (std::size_t n = 0; n <= 4; ++n)
    run.at(0.1 * n, n);
  const auto lines = run.folder.lines("nodal_states.csv");
  ASSERT_EQ(lines.size(), 1u + 3 * 3) << "three nodes at three times; 7 s is not reached";
  EXPECT_EQ(lines[0], "Time [s],X [m],u [m],v [m/s]");
  EXPECT_EQ(test::numbers(lines[3]), (std::vector<double>{0, 0.1, 0, 0}));
  const auto on_step = test::numbers(lines[6]), between = test::numbers(lines[9]);
  EXPECT_EQ(on_step, (std::vector<double>{0.2, 0.1, 0.1 * 0.2 * 0.2 * 0.2, 0.1 * 3 * 0.2 * 0.2}));
  EXPECT_EQ(between[0], 0.35);
  EXPECT_NEAR(between[2], 0.1 * std::pow(0.35, 3), 1e-17);
  EXPECT_NEAR(between[3], 0.1 * 3 * std::pow(0.35, 2), 1e-15);
}

TEST(RodOutputs, refuseWhatIsNoPlaceAndNoTime)
{
  EXPECT_THROW(Outputs({"series/places=0.5 1.5"}), InputError);
  EXPECT_THROW(Outputs({"series/places=middle"}), InputError);
  EXPECT_THROW(Outputs({"nodal states/times=0.1 soon"}), InputError);
  EXPECT_THROW(Outputs({"nodal states/times= "}), InputError);
}

/// u = X t^3: strain t^3 everywhere, rate 3 t^2; E = 6e5 Pa, 0.1 m long, 1e-4 m^2.
TEST(RodOutputs, strainsAndEnergy)
{
  Outputs run({"series/strain places=0.25 1", "series/energy=true"});
  run.at(0, 0);
  run.at(0.2, 1);
  const auto strain = run.folder.lines("strain.csv"), energy = run.folder.lines("energy.csv");
  EXPECT_EQ(strain.at(0), "Time [s],strain(0.25 L) [-],strain(1 L) [-],strain rate(0.25 L) [1/s],strain rate(1 L) [1/s]");
  const auto row = test::numbers(strain.at(2));
  for (const unsigned int place : {0, 1})
    {
      EXPECT_NEAR(row[1 + place], 0.008, 1e-15);
      EXPECT_NEAR(row[3 + place], 0.12, 1e-14);
    }
  EXPECT_EQ(energy.at(0), "Time [s],Kinetic [J],Stored [J],Total [J]");
  const auto   joule   = test::numbers(energy.at(2));
  const double kinetic = 1060 * 1e-4 * 0.12 * 0.12 * 0.1 * 0.1 * 0.1 / 6, stored = 6e5 / 2 * 0.008 * 0.008 * 1e-5;
  EXPECT_NEAR(joule[1], kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(joule[2], stored, 1e-12 * stored);
  EXPECT_NEAR(joule[3], kinetic + stored, 1e-12 * stored);
  for (const char *bad : {"0", "1.1", "-0.5", "end"})
    EXPECT_THROW(Outputs({std::string("series/strain places=") + bad}), InputError) << bad;
}
