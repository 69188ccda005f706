#!/usr/bin/env python3
"""One table of what the isometric block costs: table.py PROGRAM [--refinements 2 3 4] [--ranks 1 2] [--points 3] [--steps 8]

Refinement 5 takes two minutes for 2 steps: --refinements 5 --steps 2. Run it alone on the machine. Columns that are seconds by phase are wall-clock
seconds of rank 0; "CPU" is the whole of all ranks, start-up and outputs included.
"""

import argparse

from block import block, cells, run, unknowns


def row(cost, refinement, points, ranks):
    k = cost.count
    own_cells = cells(refinement) / ranks
    return [refinement, unknowns(refinement), points, ranks,
            f"{1e6 * cost.per('assembly', 'patch assemblies') / own_cells:.1f}",
            f"{1e-6 * unknowns(refinement) * k('tangent actions') / max(cost.second('tangent action'), 1e-9):.1f}",
            f"{cost.per('preconditioner', 'preconditioner set-ups'):.3g}",
            f"{1e3 * cost.per('preconditioner application', 'preconditioner applications'):.3g}",
            f"{k('newton iterations') / cost.accepted:.2f}",
            f"{k('linear iterations') / k('newton iterations'):.1f}",
            f"{cost.cpu / cost.accepted:.3g}", f"{cost.wall / cost.accepted:.3g}", f"{cost.megabytes:.0f}"]


HEADER = ["refinement", "unknowns", "points", "ranks", "element matrices [us/cell]", "tangent action [10^6 unknowns/s]", "set-up [s]",
          "application [ms]", "Newton per step", "Krylov per Newton", "CPU s per step", "wall s per step", "MB per rank"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--refinements", type=int, nargs="+", default=[2, 3, 4])
    arguments.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    arguments.add_argument("--points", type=int, nargs="+", default=[3])
    arguments.add_argument("--steps", type=int, default=8)
    arguments.add_argument("--preconditioner", default="p multigrid")
    given = arguments.parse_args()
    print("| " + " | ".join(HEADER) + " |")
    print("|" + "---|" * len(HEADER))
    for refinement in given.refinements:
        for points in given.points:
            for ranks in given.ranks:
                settings = block(refinement, points, given.steps, solver__preconditioner__type=given.preconditioner)
                cost = run(given.program, settings, ranks)
                print("| " + " | ".join(str(entry) for entry in row(cost, refinement, points, ranks)) + " |", flush=True)


if __name__ == "__main__":
    main()
