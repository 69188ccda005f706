#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the isometric block costs: table.py PROGRAM [--refinements 2 3 4] [--ranks 1] [--points 3] [--steps 8] [--triad BENCHMARK_TRIAD]

Three tables: counts, which do not depend on the machine; seconds and memory; and where the wall-clock time of the first rank goes, in percent of it. Memory per
unknown is what the processes hold beyond that of a block of one cell, at their peak; tangent actions are millions of unknowns a second. --triad measures the memory of the machine beside each run:
20 sums of two vectors by as many processes as there are ranks. Run it alone on the machine.
"""

import argparse
import subprocess

from block import ENVIRONMENT, block, cells, run, unknowns

COUNTS = ["Newton per step", "Krylov per Newton", "set-ups", "residuals per step"]
COSTS = ["CPU per step [s]", "wall clock per step [s]", "set-up [s]", "element matrices [us/cell]", "application [ms]", "tangent action [10^6/s]",
         "memory per rank [MB]", "per unknown [B]", "triad [GB/s]"]
PHASES = [what + " [%]" for what in ("tangent actions", "smoother actions", "Schwarz", "coarse solves", "rest of the linear solves", "set-ups", "residuals", "outputs", "all else")]


def counts(cost):
    k = cost.count
    return [f"{k('newton iterations') / cost.accepted:.2f}", f"{k('linear iterations') / k('newton iterations'):.1f}",
            str(k("preconditioner set-ups")), f"{k('residual evaluations') / cost.accepted:.2f}"]


def costs(cost, refinement, ranks, smallest, triad):
    bytes_per_unknown = 1024 ** 2 * ranks * (cost.megabytes - smallest.megabytes) / unknowns(refinement)
    actions = unknowns(refinement) * cost.count("tangent actions") / max(cost.second("tangent action"), 1e-9)
    return [f"{cost.cpu / cost.accepted:.2g}", f"{cost.wall / cost.accepted:.2g}", f"{cost.per('preconditioner', 'preconditioner set-ups'):.2g}",
            f"{1e6 * cost.per('assembly', 'patch assemblies') / (cells(refinement) / ranks):.0f}",
            f"{1e3 * cost.per('preconditioner application', 'preconditioner applications'):.2g}", f"{1e-6 * actions:.2g}", f"{cost.megabytes:.0f}",
            f"{bytes_per_unknown:.0f}", f"{triad:.1f}" if triad else ""]


def phases(cost):
    """Percent of the wall clock; what other phases contain is taken off them."""
    s = cost.second
    parts = [s("tangent action"), s("smoother action"), s("schwarz"), s("coarse solve")]
    parts += [s("linear solve") - sum(parts), s("preconditioner"), s("residual"), s("output series") + s("checkpoint")]
    return [f"{100 * part / cost.wall:.0f}" for part in parts + [cost.wall - sum(parts)]]


def measured_triad(program, ranks):
    command = (["mpirun", "-np", str(ranks)] if ranks > 1 else []) + [program]
    return float(subprocess.run(command, env=ENVIRONMENT, capture_output=True, check=True, text=True).stdout)


def print_table(heads, rows):
    heads = ["refinement", "unknowns", "points", "ranks"] + heads
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for row in rows:
        print("| " + " | ".join(str(entry) for entry in row) + " |")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--refinements", type=int, nargs="+", default=[2, 3, 4])
    arguments.add_argument("--ranks", type=int, nargs="+", default=[1])
    arguments.add_argument("--points", type=int, nargs="+", default=[3])
    arguments.add_argument("--steps", type=int, default=8)
    arguments.add_argument("--preconditioner", default="p multigrid")
    arguments.add_argument("--triad", metavar="BENCHMARK_TRIAD")
    given = arguments.parse_args()

    def settings(refinement, points):
        return block(refinement, points, given.steps, solver__preconditioner__type=given.preconditioner)

    tables = ([], [], [])
    for points in given.points:
        for ranks in given.ranks:
            smallest = run(given.program, dict(settings(0, points), **{"solver/preconditioner/type": "direct"}), ranks)
            for refinement in given.refinements:
                triad = measured_triad(given.triad, ranks) if given.triad else None
                cost = run(given.program, settings(refinement, points), ranks)
                for table, entries in zip(tables, (counts(cost), costs(cost, refinement, ranks, smallest, triad), phases(cost))):
                    table.append([refinement, unknowns(refinement), points, ranks] + entries)
    print_table(COUNTS, tables[0])
    print()
    print_table(COSTS, tables[1])
    print("\nPercent of the wall clock:\n")
    print_table(PHASES, tables[2])


if __name__ == "__main__":
    main()
