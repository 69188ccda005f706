#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a step costs under a controller in Python: python_overhead.py FOLDER_OF_THE_PACKAGE

The massless unit, 1000 steps of 1 ms with a kink of the excitation at the beginning of each: by one advance, the kinks given beforehand; by a call of
advance() for each; by a controller that sets the excitation; by one that measures, too. CPU time of the least of 11 alternating rounds.
"""

import os
import sys
import time

import numpy as np

sys.path[:0] = [sys.argv[1], os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python")]
sys.dont_write_bytecode = True

import common  # noqa: E402
import myolines  # noqa: E402

EXCITATION = "system/input/excitation"
TIMES = np.linspace(0, 2, 2001)
VALUES = 0.3 + 0.2 * (-1.0) ** np.arange(2001)


def known_beforehand(simulation):
    simulation.follow(EXCITATION, myolines.samples(TIMES, VALUES, "lines"))
    simulation.advance_to(1)


def in_pieces(simulation):
    simulation.follow(EXCITATION, myolines.samples(TIMES, VALUES, "lines"))
    for t in TIMES[1:1001]:
        simulation.advance_to(t)


def controlled(simulation):
    values = iter(VALUES)
    simulation.advance_to(1, lambda s: s.set(EXCITATION, next(values)))


def measured(simulation):
    values = iter(VALUES)

    def control(s):
        assert s.measure("tendon force/F0") > 0
        s.set(EXCITATION, next(values))

    simulation.advance_to(1, control)


def main():
    ways = {"one advance, all known beforehand": known_beforehand, "advance() for each step": in_pieces, "a controller that sets": controlled,
            "a controller that measures and sets": measured}
    seconds = {name: [] for name in ways}
    for _ in range(11):
        for name, way in ways.items():
            simulation = myolines.Simulation(common.unit())
            begin = time.process_time()
            way(simulation)
            seconds[name].append(time.process_time() - begin)
            assert simulation.steps == 1000
    least = {name: 1e6 * min(values) / 1000 for name, values in seconds.items()}
    base = least["one advance, all known beforehand"]
    print("| 1000 steps of the massless unit | CPU us per step | more than the first |\n|---|---|---|")
    for name, one in least.items():
        print(f"| {name} | {one:.1f} | {one - base:.1f} |")


if __name__ == "__main__":
    main()
