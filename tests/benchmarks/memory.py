#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Memory that `check` foretells beside the peak of a run: memory.py PROGRAM [--refinements 3 4] [--steps 2] [--tolerance 0.2]

The isometric block with p multigrid and 3 points on one rank. Beyond the program itself, which is what a block of one cell takes. Rows of `check` in bytes per
unknown. Exit code 1: a foretold sum is off by more than the tolerance.
"""

import argparse
import re
import subprocess
import sys

from block import ENVIRONMENT, SCENE, block, run, unknowns


def foretold(program, settings):
    """Bytes by row of `check`, without the program."""
    command = [program, "check", SCENE] + [part for path, value in settings.items() for part in ("--set", f"{path}={value}")]
    text = subprocess.run(command, env=ENVIRONMENT, capture_output=True, check=True, text=True).stdout
    rows = re.search(r"memory of a rank: about [^(]*\((.*)\)", text).group(1)
    entries = [re.fullmatch(r"(.*) (\S+) GB", row).groups() for row in rows.split(", ")]
    return {what: 1e9 * float(bytes_of) for what, bytes_of in entries if what != "program"}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--refinements", type=int, nargs="+", default=[3, 4])
    arguments.add_argument("--steps", type=int, default=2)
    arguments.add_argument("--tolerance", type=float, default=0.2)
    given = arguments.parse_args()
    smallest = run(given.program, block(0, 3, 1, solver__preconditioner__type="direct")).megabytes
    good, head = True, None
    for refinement in given.refinements:
        settings = block(refinement, 3, given.steps, solver__preconditioner__type="p multigrid")
        rows = foretold(given.program, settings)
        if head is None:
            head = ["refinement", "unknowns"] + [f"{what} [B]" for what in rows] + ["sum [B]", "peak [B]"]
            print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
        peak = 1024 ** 2 * (run(given.program, settings).megabytes - smallest)
        entries = [bytes_of / unknowns(refinement) for bytes_of in list(rows.values()) + [sum(rows.values()), peak]]
        print("| " + " | ".join([str(refinement), str(unknowns(refinement))] + [f"{entry:.0f}" for entry in entries]) + " |", flush=True)
        good = good and abs(sum(rows.values()) / peak - 1) <= given.tolerance
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
