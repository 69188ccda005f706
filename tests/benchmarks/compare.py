#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two builds, or two settings of one, by ratio: compare.py A B [--pairs 5] [--set PATH=VALUE ...] [--set-a ...] [--set-b ...]

A and B are programs. Every pair runs A and B one after the other, in turns first, so that a slow spell of the machine meets both. Prints CPU
seconds A/B: the median over the pairs, the smallest and the largest, and counts of the ledger that differ.
"""

import argparse
import statistics

from block import SCENE, block, run


def overrides(texts):
    return dict(text.split("=", 1) for text in texts)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("a")
    arguments.add_argument("b")
    arguments.add_argument("--scene", default=SCENE, help="without it: the isometric block at refinement 3, 3 points")
    arguments.add_argument("--pairs", type=int, default=5)
    for option in ("--set", "--set-a", "--set-b"):
        arguments.add_argument(option, action="append", default=[], metavar="PATH=VALUE")
    given = arguments.parse_args()
    common = dict(block(3) if given.scene == SCENE else {}, **overrides(given.set))
    sides = [(given.a, dict(common, **overrides(given.set_a))), (given.b, dict(common, **overrides(given.set_b)))]
    ratios, costs = [], [None, None]
    for pair in range(given.pairs):
        for side in (0, 1) if pair % 2 == 0 else (1, 0):
            costs[side] = run(sides[side][0], sides[side][1], scene=given.scene)
        ratios.append(costs[0].cpu / costs[1].cpu)
        print(f"pair {pair + 1}: A {costs[0].cpu:.2f} s, B {costs[1].cpu:.2f} s, ratio {ratios[-1]:.3f}", flush=True)
    print(f"CPU seconds A/B: median {statistics.median(ratios):.3f}, from {min(ratios):.3f} to {max(ratios):.3f}")
    a, b = costs[0].counts, costs[1].counts
    different = [f"  {what}: {a.get(what, 0)} / {b.get(what, 0)}" for what in sorted(a.keys() | b.keys()) if a.get(what, 0) != b.get(what, 0)]
    print("ledger: " + ("counts are equal" if not different else "counts A / B differ:\n" + "\n".join(different)))


if __name__ == "__main__":
    main()
