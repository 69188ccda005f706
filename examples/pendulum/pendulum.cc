// SPDX-License-Identifier: LGPL-2.1-or-later
// A system of one's own, advanced by the integrators of the library.
//
//     pendulum [INTEGRATOR [STEPS]]      as `myolines list integrators` names them; default: newmark 200
//
// Prints the angle after one period of a pendulum that is let go at 60 degrees. It should be 60 degrees again.

#include "pendulum.h"

#include <myolines/time/error_norm.h>
#include <myolines/time/loop.h>

#include <cstdio>
#include <string>

namespace
{
  using namespace myolines;

  /// All digits, as parameters take them.
  std::string text(const double number)
  {
    char digits[32];
    std::snprintf(digits, sizeof(digits), "%.17g", number);
    return digits;
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                              method = argc > 1 ? argv[1] : "newmark";
  const int                                      steps  = argc > 2 ? std::stoi(argv[2]) : 200;
  const double                                   degree = dealii::numbers::PI / 180;
  try
    {
      using scene::list_of_defaults;
      WorkLedger      ledger;
      const Pendulum  pendulum(60 * degree, ledger);
      LinearSolver    linear(list_of_defaults(LinearSolver::linear_schema(), "linear"),
                             list_of_defaults(LinearSolver::preconditioner_schema(), "preconditioner"), ledger);
      NonlinearSolver nonlinear(list_of_defaults(NonlinearSolver::schema(), "nonlinear", {"relative tolerance=1e-12"}), linear, ledger);

      const IntegratorEntry &entry = integrator_entry(method);
      if (!entry.make)
        throw std::runtime_error(method + " chooses its steps itself: this example takes them as they are given");
      const auto        integrator = make_integrator(entry, list_of_defaults(entry.schema, "integrator"),
                                                     IntegratorContext{pendulum, nonlinear, BoundaryRates::exact, ledger});
      const double      end        = pendulum.period();
      const scene::Node time       = list_of_defaults(time_schema(), "time", {"end=" + text(end), "step=" + text(end / steps)});
      State             state      = pendulum.initial_state(0);
      const auto        control    = make_step_control(time);
      LoopSettings      settings   = loop_settings(time);
      settings.end                 = end;
      run_loop(pendulum, *integrator, *control, settings, state, {}, ledger);
      std::printf("%.6f degrees after %.6f s, %g steps of %s\n", state.u.local_element(0) / degree, state.t,
                  static_cast<double>(ledger.counted("accepted steps")), method.c_str());
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "%s\n", error.what());
      return 1;
    }
}
