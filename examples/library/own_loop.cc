// SPDX-License-Identifier: LGPL-2.1-or-later
// A scene, advanced by a time loop of one's own: equal steps of the integrator of the scene, with its outputs.
//
//     own_loop SCENE.xml STEPS FOLDER

#include <myolines/cli/experiment.h>
#include <myolines/cli/guarded.h>
#include <myolines/cli/mpi_session.h>

#include <iostream>

int main(int argc, char *argv[])
{
  using namespace myolines;
  MpiSession mpi(argc, argv);
  mpi.start();
  return static_cast<int>(guarded(
      [&] {
        Experiment   experiment(read_whole_scene(argv[1]));
        const auto   outputs = experiment.make_outputs(OutputFolder(argv[3]));
        State        state   = experiment.start();
        const double begin = state.t, end = experiment.settings().end;
        const int    steps = std::stoi(argv[2]);
        for (const auto &output : outputs)
          output->begin(state);
        experiment.integrator().start(state);
        for (int i = 0; i < steps; ++i)
          {
            const double     next = i + 1 == steps ? end : begin + (i + 1) * (end - begin) / steps, dt = next - state.t;
            const StepReport report = experiment.integrator().step(dt, state);
            if (!report.accepted())
              throw SolveError(report.reason);
            state.t = next; // without the rounding of sums
            for (const auto &output : outputs)
              output->accepted(state, {std::size_t(i + 1), state.t, dt, report});
          }
        for (const auto &output : outputs)
          output->last(state), output->end("");
        std::cout << steps << " steps to t = " << state.t << " s, largest displacement " << state.u.linfty_norm() << " m\n";
      },
      std::cerr));
}
