// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: strain.csv of a muscle holds strains of parts of the block, whatever it does as a whole.

#include <myolines/fem/node_space.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/observers/outputs.h>

#include "../output/folder.h"

using namespace myolines;

/// u_x = 0.1 X + 0.002, v_x = -2 X + 3: the end x- moves too. The place 0.3 L is no node.
TEST(MuscleStrain, IsThatOfTheMotion)
{
  Muscle3dParameters p;
  p.geometry.size       = {{0.03, 0.01, 0.02}};
  p.geometry.cells      = {{4, 1, 1}};
  p.geometry.refinement = 0;
  p.geometry.distortion = 0.1;
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  State                state = system.initial_state(0);
  const NodeSpace     &space = *system.discretisation().space;
  state.u.zero_out_ghost_values();
  state.v.zero_out_ghost_values();
  for (unsigned int node = 0; node < system.n_unknowns() / 3; ++node)
    {
      const double X    = space.node_position(node)[0];
      state.u(3 * node) = 0.1 * X + 0.002;
      state.v(3 * node) = -2 * X + 3;
    }
  const scene::Node output = scene::parse_scene("<ParameterList name=\"scene\"><ParameterList name=\"series\"><Parameter name=\"strain "
                                                "places\" type=\"string\" value=\"0.3 1\"/></ParameterList></ParameterList>",
                                                muscle3d_output_schema());
  make_outputs(output, system, folder.path, ledger).front()->begin(state);
  const std::vector<std::string> lines = folder.lines("strain.csv");
  EXPECT_EQ(lines.at(0), "Time [s],strain(0.3 L) [-],strain(1 L) [-],strain rate(0.3 L) [1/s],strain rate(1 L) [1/s]");
  const std::vector<double> row = test::numbers(lines.at(1)), expected{0, 0.1, 0.1, -2, -2};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(row.at(i), expected[i], 1e-12) << i;
}
