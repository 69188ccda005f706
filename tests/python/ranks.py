# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: the same script on one rank and on several: mpirun -np 2 python3 ranks.py. Prints forces and sums, on the first rank."""

import os
import sys

import numpy as np
from common import block, oscillator

import myolines


def main(folder):
    scene = block().update({"system/geometry/refinement": 2, "system/discretisation/degree": 1, "system/activation": {"type": "steered"}})
    simulation = myolines.Simulation(scene)
    simulation.ramp("system/activation", 1, 0.02)
    simulation.advance(0.03)
    moment = simulation.save()
    simulation.ramp("system/boundary/moving end/strain", 0.02, 0.02)
    simulation.advance(0.03)
    first = simulation.u.copy()
    forces = simulation.measures()["reaction.csv"]
    simulation.restore(moment).ramp("system/boundary/moving end/strain", 0.02, 0.02)
    simulation.advance(0.03)
    assert np.array_equal(simulation.u, first)
    system = simulation.system
    residual = system.residual(simulation.t, simulation.u, simulation.v, simulation.a)
    at = system.linearise(simulation.t, simulation.u, simulation.v, simulation.a)
    solved = at.solve(np.where(system.free, 1.0, 0.0), u=1, v=100, a=1e4, tolerance=1e-10)
    reactions = system.dot(np.where(system.free, 0, residual), np.where(system.free, 0, residual))
    length = system.dot(solved, solved)
    whole = system.gathered(simulation.u)
    steady = myolines.Simulation(oscillator()).advance(1)  # which every rank holds whole
    run = myolines.run(scene, os.path.join(folder, "run"))
    try:
        scene.with_values({"system/geometry/length": -1})
    except myolines.InputError:
        refused = 1
    if myolines.ranks() > 1:
        try:
            at.K  # pylint: disable=pointless-statement
        except myolines.InputError as error:
            assert "several ranks" in str(error)
    if myolines.rank() == 0:
        numbers = [*forces.values(), reactions, *whole[::17], length, steady.u[0], run["steps"].n_rows, refused]
        print("\n".join(f"{number:.6e}" for number in numbers))


if __name__ == "__main__":
    main(sys.argv[1])
