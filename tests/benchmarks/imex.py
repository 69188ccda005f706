#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What becomes of every additive split of the muscle at every step size: imex.py PROGRAM [--refinement 1] [--steps 100 | --end 1e-6]

The block of input/passive_stretch.xml is pulled, passive or activated at once to one half (with and without the force-velocity relation), and
runs by "imex euler", refused splits by force. It takes a number of steps, and an entry is the difference of the force at the moving end from that
of backward Euler with the same steps, relative; or it runs until an end, and the difference is that of the kinetic energy from that of sdirk3 with
the smallest steps. Runs that fail: at which step.
"""

import argparse
import csv
import os
import re
import subprocess
import tempfile

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "input", "passive_stretch.xml")
TANGENT = "tangent at the start of the step"
ACTIVE = ["system/activation/type=constant", "system/activation/value=0.5"]
STATES = {"passive": [], "active, no force-velocity": ACTIVE + ["system/tissues/muscle/fibre/force-velocity=false"], "active": ACTIVE}
SPLITS = [TANGENT, "linear", "volumetric", "passive", "all but active"]
FORCE, KINETIC_ENERGY = "reaction.csv", "energy_balance.csv"


def run(program, settings, out, quantity):
    """Exit code, what it printed, and the force of the moving end [N] or the kinetic energy [J] at the end; none where nothing was written."""
    command = [program, "run", SCENE, "--quiet", "--overwrite", "--out", out]
    for setting in settings:
        command += ["--set", setting]
    ended = subprocess.run(command, capture_output=True, text=True)
    try:
        with open(os.path.join(out, quantity)) as file:
            value = float(list(csv.reader(file))[-1][1])
    except (OSError, IndexError, ValueError):
        value = None
    return ended.returncode, ended.stderr, value


def outcome(program, common, split, dt, end, quantity, expected, folder):
    code, text, value = run(program, common + steps(dt, end) + ["integrator/type=imex euler", f"integrator/split={split}", "integrator/force=true"],
                            os.path.join(folder, "imex"), quantity)
    if code == 3:
        reached = float(re.search(r"The step from t = (\S+) s", text).group(1))
        return f"fails at {round(reached / dt) + 1}"
    if code != 0:
        raise RuntimeError(text)
    difference = abs(value - expected) / abs(expected)
    return f"{difference:.0e}"


def steps(dt, end):
    return [f"time/step={dt}", f"time/end={end!r}", "time/control/type=fixed"]


def expected_value(program, common, method, dt, end, quantity, folder):
    code, text, value = run(program, common + steps(dt, end) + [f"integrator/type={method}"], os.path.join(folder, "expected"), quantity)
    if code != 0:
        raise RuntimeError(text)
    return value


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--refinement", type=int, default=1)
    arguments.add_argument("--steps", type=int, default=100)
    arguments.add_argument("--end", type=float)
    arguments.add_argument("--sizes", nargs="+", default=["1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"])
    arguments.add_argument("--states", nargs="+", choices=STATES, default=list(STATES))
    given = arguments.parse_args()
    sizes = [float(size) for size in given.sizes]
    print("| state | split | " + " | ".join(given.sizes) + " |")
    print("|---|---|" + "---|" * len(sizes))
    with tempfile.TemporaryDirectory() as folder:
        for state in given.states:
            common = STATES[state] + [f"system/geometry/refinement={given.refinement}", "system/discretisation/quadrature points=3"]
            ends = [given.end or given.steps * dt for dt in sizes]
            quantity = KINETIC_ENERGY if given.end else FORCE
            if given.end:
                expected = [expected_value(given.program, common, "sdirk3", min(sizes), given.end, quantity, folder)] * len(sizes)
            else:
                expected = [expected_value(given.program, common, "backward euler", dt, end, quantity, folder) for dt, end in zip(sizes, ends)]
            for split in SPLITS:
                if state == "passive" and split == "all but active":
                    continue
                entries = [outcome(given.program, common, split, dt, end, quantity, value, folder)
                           for dt, end, value in zip(sizes, ends, expected)]
                print(f"| {state} | `{split}` | " + " | ".join(entries) + " |", flush=True)


if __name__ == "__main__":
    main()
