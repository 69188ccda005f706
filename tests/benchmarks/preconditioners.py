#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Krylov iterations per Newton iteration and CPU seconds per step of every preconditioner, over refinement, bulk modulus and state:
preconditioners.py PROGRAM [--refinements 2 3]

The block is stretched by 5 % in 0.1 s (four steps of input/passive_stretch.xml) while it is activated along a ramp: not (passive), to 0.5
(half) or to 1 (full). Newton to its default tolerance, linear solves to 1e-4 (not adapted, so that the counts compare). jacobi at
refinement 3 takes long.
"""

import argparse
import os

from block import HERE, block, run

SCENE = os.path.join(HERE, "..", "..", "input", "passive_stretch.xml")
STATES = {"passive": 0, "half": 0.5, "full": 1}


def settings(refinement, kappa, level, preconditioner):
    return dict(block(refinement, 3, 4),
                **{"system/tissues/muscle/bulk modulus": kappa, "system/activation/type": "control points",
                   "system/activation/points": f"0 0; 0.1 {level}; 1 {level}", "solver/nonlinear/forcing minimum": 1e-4,
                   "solver/nonlinear/forcing maximum": 1e-4, "solver/linear/maximum iterations": 3000,
                   "solver/preconditioner/type": preconditioner})


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--refinements", type=int, nargs="+", default=[2, 3])
    arguments.add_argument("--preconditioners", nargs="+", default=["p multigrid", "ml", "direct", "jacobi"])
    arguments.add_argument("--kappas", nargs="+", default=["1e6", "1e7", "1e8"])
    given = arguments.parse_args()
    heads = ["refinement", "kappa [Pa]", "state"] + given.preconditioners + [f"{name}: CPU [s]" for name in given.preconditioners]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for refinement in given.refinements:
        for kappa in given.kappas:
            for state, level in STATES.items():
                entries, seconds = [], []
                for preconditioner in given.preconditioners:
                    try:
                        cost = run(given.program, settings(refinement, kappa, level, preconditioner), scene=SCENE)
                        krylov = cost.count("linear iterations") / cost.count("newton iterations")
                        entries.append(f"{krylov:.1f}")
                        seconds.append(f"{cost.cpu / cost.accepted:.2g}")
                    except RuntimeError as error:
                        entries.append("fails: " + str(error).split(":")[0])
                        seconds.append("")
                print(f"| {refinement} | {kappa} | {state} | " + " | ".join(entries + seconds) + " |", flush=True)


if __name__ == "__main__":
    main()
