#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two builds, or two settings of one, by ratio: compare.py A B [--pairs 5] [--set PATH=VALUE ...] [--set-a ...] [--set-b ...] [--each "PATH=V1|V2" ...]

A and B are programs. Every pair runs A and B one after the other, in turns first, so that a slow spell of the machine meets both. Prints CPU
seconds A/B: the median over the pairs, the smallest and the largest, and counts of the ledger that differ.

With --each, once or more, all combinations of such values are run, and a table has a row for each value of the first one: Newton and Krylov iterations
and CPU seconds A -> B without the start of the programs, the better of the pairs, and at last the sum of the seconds of all runs.
"""

import argparse
import itertools
import statistics

from block import SCENE, block, run


def overrides(texts):
    return dict(text.split("=", 1) for text in texts)


def run_pairs(sides, pairs, scene):
    """What the pairs cost: [pair][side]."""
    costs = []
    for pair in range(pairs):
        costs.append([None, None])
        for side in (0, 1) if pair % 2 == 0 else (1, 0):
            costs[-1][side] = run(sides[side][0], sides[side][1], scene=scene)
    return costs


def print_ratio(costs):
    ratios = [a.cpu / b.cpu for a, b in costs]
    for pair, (a, b) in enumerate(costs):
        print(f"pair {pair + 1}: A {a.cpu:.2f} s, B {b.cpu:.2f} s, ratio {ratios[pair]:.3f}")
    print(f"CPU seconds A/B: median {statistics.median(ratios):.3f}, from {min(ratios):.3f} to {max(ratios):.3f}")
    a, b = costs[-1][0].counts, costs[-1][1].counts
    different = [f"  {what}: {a.get(what, 0)} / {b.get(what, 0)}" for what in sorted(a.keys() | b.keys()) if a.get(what, 0) != b.get(what, 0)]
    print("ledger: " + ("counts are equal" if not different else "counts A / B differ:\n" + "\n".join(different)))


def print_table(axes, sides, pairs, scene):
    (path, values), *others = axes
    print(f"| {path} | Newton | Krylov | CPU [s] |\n|---|---|---|---|")
    total = [0.0, 0.0]
    for value in values:
        newton, krylov, cpu = [0, 0], [0, 0], [0.0, 0.0]
        for combination in itertools.product(*([(other, choice) for choice in choices] for other, choices in others)):
            settings = dict([(path, value), *combination])
            costs = run_pairs([(program, {**settings, **given}) for program, given in sides], pairs, scene) # what is given may depend on a type
            for side in (0, 1):
                newton[side] += costs[0][side].count("newton iterations")
                krylov[side] += costs[0][side].count("linear iterations")
                cpu[side] += min(pair[side].second("CPU of the run") for pair in costs)
        total = [total[side] + cpu[side] for side in (0, 1)]
        print(f"| {value} | {newton[0]} -> {newton[1]} | {krylov[0]} -> {krylov[1]} | {cpu[0]:.2f} -> {cpu[1]:.2f} |", flush=True)
    print(f"| all | | | {total[0]:.2f} -> {total[1]:.2f} |\n\nB/A: {total[1] / total[0]:.3f}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("a")
    arguments.add_argument("b")
    arguments.add_argument("--scene", default=SCENE, help="without it: the isometric block at refinement 3, 3 points")
    arguments.add_argument("--pairs", type=int, default=5)
    arguments.add_argument("--each", action="append", default=[], metavar="PATH=V1|V2")
    for option in ("--set", "--set-a", "--set-b"):
        arguments.add_argument(option, action="append", default=[], metavar="PATH=VALUE")
    given = arguments.parse_args()
    common = dict(block(3) if given.scene == SCENE else {}, **overrides(given.set))
    sides = [(given.a, dict(common, **overrides(given.set_a))), (given.b, dict(common, **overrides(given.set_b)))]
    if given.each:
        print_table([(path, values.split("|")) for path, values in overrides(given.each).items()], sides, given.pairs, given.scene)
    else:
        print_ratio(run_pairs(sides, given.pairs, given.scene))


if __name__ == "__main__":
    main()
