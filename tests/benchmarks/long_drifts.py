#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drifts of energy and momenta of free passive bodies over 10,000 steps of `energy momentum`, as a table in Markdown.

long_drifts.py PROGRAM

$MYOLINES_RESULTS, if set, is where the runs are kept: those that are there are not run again.
"""

import csv
import math
import os
import sys
import tempfile

from measured_runs import measured_run

SCENE = "input/laboratory/tumbling_body.xml"
BAR = {"time/end": 10, "time/step": 1e-3, "system/geometry/type": "block", "system/geometry/length": 0.06, "system/geometry/width": 0.01,
       "system/geometry/height": 0.01, "system/geometry/tissue": "rubber", "system/geometry/refinement": 1,
       "system/tissues/own/rubber/bulk modulus": 1e8}
RUNS = [("the L of `tumbling_body.xml`, kappa/mu = 100, 5 ms", "long_L", {"time/end": 50}),
        ("a bar of 6 x 1 x 1 cm in its place, kappa/mu = 5000, 1 ms", "long_bar", BAR)]


def columns(folder, name, starts):
    """Columns of a table whose heads begin so."""
    with open(os.path.join(folder, name), newline="") as file:
        head, *rows = csv.reader(file)
    return [[float(row[i]) for row in rows] for i, text in enumerate(head) if text.startswith(starts)]


def drift(folder, starts):
    """Largest change of a vector over its length at the start."""
    vectors = list(zip(*columns(folder, "momenta.csv", starts)))
    return max(math.dist(vector, vectors[0]) for vector in vectors) / math.hypot(*vectors[0])


def main():
    print("| body | steps | energy | momentum | angular momentum |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for name, place, settings in RUNS:
            folder = os.path.join(os.environ.get("MYOLINES_RESULTS", scratch), place)
            if not os.path.exists(os.path.join(folder, "ledger.json")):
                measured_run(sys.argv[1], SCENE, settings, folder)
            [kinetic], [balance] = columns(folder, "energy_balance.csv", "Kinetic"), columns(folder, "energy_balance.csv", "Balance drift")
            energy = max(map(abs, balance)) / kinetic[0]
            print(f"| {name} | {len(balance) - 1} | {energy:.1e} | {drift(folder, 'Momentum'):.1e} | {drift(folder, 'Angular'):.1e} |")


if __name__ == "__main__":
    main()
