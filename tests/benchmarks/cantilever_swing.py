#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far the suddenly loaded cantilever swings with each method, as a table in Markdown.

cantilever_swing.py PROGRAM [--curve FILE.csv]

First row: what Abaqus gives (C3D8, the collection of solids4foam), with another volume function. --curve adds the root mean square distance from a curve,
a table of times [s] and lengths of the displacement of the tip [m]. $MYOLINES_RESULTS, if set, is where the runs are kept: those that are there are not
run again.
"""

import argparse
import csv
import math
import os
import tempfile

from measured_runs import MeasuredRun, measured_run

SCENE = "input/laboratory/cantilever.xml"
METHODS = [("energy momentum", 5e-3), ("newmark", 5e-3), ("bathe", 5e-3), ("tr-bdf2", 5e-3), ("bdf2", 5e-3), ("sdirk2", 5e-3), ("sdirk3", 1e-2),
           ("backward euler", 5e-3)]


def swing(run):
    """Times and lengths of the displacement of the tip."""
    rows = run.rows("displacements-3d.csv")
    return [row[0] for row in rows], [math.hypot(*row[1:4]) for row in rows]


def largest(times, lengths, begin, end):
    return max((x, t) for t, x in zip(times, lengths) if begin <= t <= end)


def at(time, times, lengths):
    i = next(i for i in range(1, len(times)) if times[i] >= time - 1e-12)
    return lengths[i - 1] + (lengths[i] - lengths[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1])


def rms(curve, times, lengths):
    with open(curve, newline="") as file:
        rows = [[float(text) for text in row] for row in list(csv.reader(file))[1:]]
    return math.sqrt(sum((at(t, times, lengths) - x) ** 2 for t, x in rows if t <= times[-1]) / len(rows))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--curve")
    arguments = parser.parse_args()
    more = " rms [m] |" if arguments.curve else ""
    print("| method, step | first maximum | minimum | second maximum | drift of energy [J] | Newton |" + more)
    print("|---" * (6 + bool(arguments.curve)) + "|")
    print("| Abaqus | 2.801 m, 0.318 s | 0.018 m, 0.646 s | 2.800 m, 0.964 s | | |" + (" |" if arguments.curve else ""))
    with tempfile.TemporaryDirectory() as scratch:
        for method, step in METHODS:
            folder = os.path.join(os.environ.get("MYOLINES_RESULTS", scratch), f"cantilever {method}")
            if os.path.exists(os.path.join(folder, "ledger.json")):
                run = MeasuredRun(folder, 0, "", 0)
            else:
                run = measured_run(arguments.program, SCENE, {"integrator/type": method, "time/step": step}, folder)
            name = f"| `{method}`, {1e3 * step:g} ms | "
            if run.reason != "done":
                print(name + f"fails at {run.last_time():.3g} s | | | | |" + (" |" if arguments.curve else ""), flush=True)
                continue
            times, lengths = swing(run)
            first, second = largest(times, lengths, 0, 0.5), largest(times, lengths, 0.8, 1)
            least, when = largest(times, [-x for x in lengths], 0.5, 0.8)
            drift = max((row[8] for row in run.rows("energy_balance.csv")), key=abs)
            cells = [f"{first[0]:.3f} m, {first[1]:.3f} s", f"{-least:.3f} m, {when:.3f} s", f"{second[0]:.3f} m, {second[1]:.3f} s", f"{drift:.2g}",
                     str(run.count("newton iterations"))]
            if arguments.curve:
                cells.append(f"{rms(arguments.curve, times, lengths):.3f}")
            print(name + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
