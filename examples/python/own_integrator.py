#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""An integrator of one's own beside those of the library: own_integrator.py FOLDER

The implicit midpoint rule for u and v as one implicit stage, and how its error falls with the step in the rod of thesis chapter 4, beside two
methods that are built in.
"""

import os
import sys

import numpy as np

import myolines

INPUT = os.environ.get("MYOLINES_INPUT", "input")


@myolines.integrator
class Midpoint(myolines.Integrator):
    """v_1 = v_0 + dt a_m, u_1 = u_0 + dt (v_0 + v_1)/2, R = 0 in the middle: a stage to there, and as far again."""

    name = "own midpoint rule"
    summary = "R = 0 in the middle of the step, of second order and without damping."
    order = 2
    second_order_only = True

    def step(self, dt, state):
        t, u, v = state.t, state.u.copy(), state.v.copy()
        # the middle: u_m = u + dt/2 v + dt^2/4 a, v_m = v + dt/2 a
        report = self.solve_stage(t + dt / 2, state, u + dt / 2 * v, v, 0 * v, (dt**2 / 4, dt / 2, 1))
        if report.accepted:
            a = state.a.copy()
            end = self.system.prescribed(t + dt, u + dt * v + dt**2 / 2 * a, v + dt * a, a)
            state.u, state.v, state.a = end
        return report


def error(scene, reference, method, step):
    simulation = myolines.Simulation(scene.with_values({"integrator/type": method, "time/step": step})).advance_to(0.02)
    return np.linalg.norm(simulation.u - reference) / np.linalg.norm(reference)


def main(folder):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    scene = myolines.Scene(os.path.join(INPUT, "rod_neo_hookean.xml"))
    scene.update({"time/boundary rates": "exact", "time/start velocity": "consistent", "time/end": 0.02, "time/control/type": "fixed",
                  "system/profile": {"type": "smooth step", "amplitude": 0.1, "start": 0, "duration": 0.01}, "system/elements": 4,
                  "solver/nonlinear/relative tolerance": 1e-10,
                  "integrator/type": "sdirk3", "time/step": 1e-5})
    reference = myolines.Simulation(scene).advance_to(0.02).u
    steps = [2e-4, 1e-4, 5e-5]
    orders = {}
    for method in ("own midpoint rule", "bdf2", "sdirk2"):
        errors = [error(scene, reference, method, step) for step in steps]
        orders[method] = np.log2(errors[-2] / errors[-1])
        pyplot.loglog(steps, errors, "o-", label=method)
        print(f"{method}: error {errors[-1]:.1e} with {steps[-1]:g} s, order {orders[method]:.1f}")
    pyplot.xlabel("step [s]")
    pyplot.ylabel("relative error of u")
    pyplot.legend()
    pyplot.savefig(folder + "/own_integrator.png")
    return orders


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
