#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an implicit stage of a small system costs, as a table: small_systems.py BENCHMARK_SMALL_SYSTEMS [--steps 20000] [--rounds 3]

The fastest of the rounds of each; "outside" is what remains beside residuals, Jacobians and band solves.
"""

import argparse
import re
import subprocess

LINE = re.compile(r"(.*): \S+ s, (\S+) us per stage, (\S+) Newton iterations per stage, outside the phases below (\S+) %")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--steps", type=int, default=20000)
    arguments.add_argument("--rounds", type=int, default=3)
    given = arguments.parse_args()
    best = {}
    for _ in range(given.rounds):
        text = subprocess.run([given.program, str(given.steps)], capture_output=True, text=True, check=True).stdout
        for line in text.splitlines():
            if found := LINE.fullmatch(line):
                system, *numbers = found.groups()
                best[system] = min(best.get(system, [float("inf")]), [float(number) for number in numbers])
    print("| system | Newton per stage | us per stage | outside [%] |\n|---|---|---|---|")
    for system, (microseconds, newton, outside) in best.items():
        print(f"| {system} | {newton:.3g} | {float(f'{microseconds:.2g}'):g} | {outside:.0f} |")


if __name__ == "__main__":
    main()
