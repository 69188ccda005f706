// SPDX-License-Identifier: LGPL-2.1-or-later
// K = dR/du, C = dR/dv and M = dR/da of a scene, as K.mtx, C.mtx and M.mtx (MatrixMarket) in the present folder.
//
//     matrices SCENE.xml [FOLDER]      at its initial state, or at the last state that a run of it has kept in FOLDER

#include <myolines/cli/experiment.h>
#include <myolines/cli/guarded.h>
#include <myolines/cli/mpi_session.h>
#include <myolines/output/matrix_market.h>

#include <iostream>

int main(int argc, char *argv[])
{
  using namespace myolines;
  MpiSession mpi(argc, argv);
  mpi.start();
  return static_cast<int>(guarded(
      [&] {
        const scene::Node         scene = read_whole_scene(argv[1]);
        WorkLedger                ledger;
        const AssembledSystem     assembled     = make_system(scene, ledger);
        const SemiDiscreteSystem &system        = *assembled.system;
        const State               state         = argc > 2 ? CheckpointReader(checkpoint_file(argv[2])).read(system).state
                                                           : system.initial_state(scene.section("time").number("start"));
        const auto                linearisation = system.make_linearisation();
        system.linearise({state.t, Side::left, state.u, state.v, state.a}, *linearisation);
        write_matrix_market(linearisation->sparse(stage_weights(1, 0, 0)), system.constraints(), "K.mtx");
        write_matrix_market(linearisation->sparse(stage_weights(0, 1, 0)), system.constraints(), "C.mtx");
        write_matrix_market(linearisation->sparse(stage_weights(0, 0, 1)), system.constraints(), "M.mtx");
        std::cout << system.n_unknowns() << " unknowns at t = " << state.t << " s\n";
      },
      std::cerr));
}
