// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/solvers.h"

#include <myolines/rod1d/rod1d_system.h>
#include <myolines/system/drive_types.h>
#include <myolines/time/loop.h>
#include <myolines/time/start.h>

namespace myolines::testing
{
  /// The Neo-Hookean rod of thesis section 4.7, kappa = 1 MPa (errata 18), profiles (4.7.3) to (4.7.5).
  inline Rod1dParameters thesis_rod(const int profile, const unsigned int n_elements = 8)
  {
    Rod1dParameters p;
    p.n_elements = n_elements;
    p.material   = RodMaterial::neo_hookean_thesis(1e6, 0.4);
    if (profile == 1)
      p.strain = std::make_shared<SmoothStep>(0.1, 0, 2, 2 * 0.1 / (0.2 * 2));
    else if (profile == 2)
      p.strain = std::make_shared<PiecewiseDrive>(PiecewiseDrive::lines({{0.1, 0}, {0.6, 0.1}}));
    else
      p.strain = std::make_shared<Sine>(0.1, 1, 0, 0);
    return p;
  }

  /// A rod in the conventions of the thesis: scheme rates, kinks landed on, everything at rest at the start.
  struct Rod
  {
    Rod(Rod1dParameters parameters, const std::string &method, const Overrides &settings = {}, const Overrides &time = {},
        const Overrides &nonlinear = {"relative tolerance=1e-12", "absolute tolerance=1e-12"})
      : solvers(nonlinear)
      , system(std::move(parameters), solvers.ledger)
      , time_settings{"boundary rates=scheme", "start velocity=impulse", "events=land", "control/type=fixed"}
    {
      time_settings.insert(time_settings.end(), time.begin(), time.end());
      const scene::Node any   = time_node(1, 1);
      const auto       &entry = integrator_entry(method);
      integrator =
          entry.make(node(entry.schema, settings), {system, solvers.nonlinear, boundary_rates(any), solvers.ledger, start_velocity(any)});
      state = starting_state(system, 0, boundary_rates(any), start_velocity(any));
    }

    scene::Node time_node(const double end, const double step) const
    {
      std::ostringstream size, until;
      size.precision(17);
      until.precision(17);
      size << "step=" << step;
      until << "end=" << end;
      Overrides all = time_settings;
      all.insert(all.end(), {until.str(), size.str()});
      return node(time_schema(), all);
    }

    void run(const double end, const double step, const std::vector<Observer *> &observers = {})
    {
      const scene::Node time    = time_node(end, step);
      const auto        control = make_step_control(time);
      run_loop(system, *integrator, *control, loop_settings(time), state, observers, solvers.ledger);
    }

    Solvers                     solvers;
    Rod1dSystem                 system;
    Overrides                   time_settings;
    std::unique_ptr<Integrator> integrator;
    State                       state;
  };
} // namespace myolines::testing
