#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a second rank gains, against what it gains where memory is the limit: ranks.py PROGRAM TRIAD [--refinement 4] [--steps 2] [--rounds 3]

In every round: the triad on 1 and 2 processes, the block on 1 and 2 ranks. Wall-clock seconds; the machine must do nothing else.
"""

import argparse
import statistics
import subprocess

from block import ENVIRONMENT, block, run


def triad(program, ranks):
    text = subprocess.run(["mpirun", "-np", str(ranks), program], env=ENVIRONMENT, capture_output=True, check=True, text=True).stdout
    return float(text)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("triad")
    arguments.add_argument("--refinement", type=int, default=4)
    arguments.add_argument("--steps", type=int, default=2)
    arguments.add_argument("--rounds", type=int, default=3)
    given = arguments.parse_args()
    settings = block(given.refinement, 3, given.steps, solver__preconditioner__type="p multigrid")
    shares = []
    for _ in range(given.rounds):
        memory = triad(given.triad, 2) / triad(given.triad, 1)
        one, two = run(given.program, settings, 1), run(given.program, settings, 2)
        shares.append(one.wall / two.wall / memory)
        print(f"triad gains {memory:.2f}; block {one.wall:.2f} s, {two.wall:.2f} s, gains {one.wall / two.wall:.2f}; Krylov "
              f"{one.count('linear iterations')}, {two.count('linear iterations')}; share {shares[-1]:.2f}", flush=True)
    print(f"share of the gain of the triad: median {statistics.median(shares):.2f}")


if __name__ == "__main__":
    main()
