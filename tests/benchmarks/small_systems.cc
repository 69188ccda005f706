// SPDX-License-Identifier: LGPL-2.1-or-later
// What a step of small systems costs: a Neo-Hookean rod of 64 elements and an oscillator, 1e5 steps of sdirk2.
//   benchmark_small_systems [steps]

#include "../rod1d/rod.h"

#include "../integrators/experiment.h"

#include <myolines/system/drive_types.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  double seconds_of(const std::function<void()> &work)
  {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void print(const std::string &what, const double seconds, const WorkLedger &ledger)
  {
    const double stages = ledger.counted("nonlinear solves");
    double       inside = 0;
    for (const auto &[phase, time] : ledger.seconds())
      inside += time;
    std::cout << what << ": " << seconds << " s, " << 1e6 * seconds / stages << " us per stage, "
              << ledger.counted("newton iterations") / stages << " Newton iterations per stage, outside the phases below "
              << 100 * (1 - inside / seconds) << " %\n";
    for (const auto &[phase, time] : ledger.seconds())
      std::cout << "  " << phase << " " << time << " s\n";
  }

  void rod(const unsigned int steps)
  {
    Rod1dParameters p;
    p.n_elements = 64;
    p.material   = RodMaterial::neo_hookean_thesis(1e6, 0.4);
    p.strain     = std::make_shared<SmoothStep>(0.1, 0, 2, 0.5);
    Rod rod(p, "sdirk2", {}, {}, {});
    rod.integrator->start(rod.state);
    const double seconds = seconds_of([&] {
      for (unsigned int i = 0; i < steps; ++i)
        rod.integrator->step(2. / steps, rod.state);
    });
    print("rod, 64 elements, sdirk2", seconds, rod.solvers.ledger);
  }

  void oscillator(const std::string &method, const double cubic, const unsigned int steps)
  {
    OscillatorParameters p;
    p.cubic_stiffness = cubic;
    Experiment run(integrator_entry(method), p, BoundaryRates::exact, {}, {});
    run.integrator->start(run.state);
    const double seconds = seconds_of([&] {
      for (unsigned int i = 0; i < steps; ++i)
        run.integrator->step(10. / steps, run.state);
    });
    print((cubic == 0 ? "linear oscillator, " : "cubic oscillator, ") + method, seconds, run.solvers.ledger);
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int                             steps = argc > 1 ? std::stoul(argv[1]) : 100000;
  rod(steps);
  for (const char *method : {"sdirk2", "newmark", "backward euler"})
    for (const double cubic : {0., 1.})
      oscillator(method, cubic, steps);
}
