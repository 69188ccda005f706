#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Microseconds per cell of the cell kernels as a table, a column for each instruction set: kernels.py BENCHMARK_KERNELS [--seconds 0.2]

Dynamic, fully active, exact tangent. Empty: the processor lacks the instruction set.
"""

import argparse
import csv
import subprocess
import sys


def measured(program, seconds):
    """{(kernel, degree, points): {instruction set: microseconds per cell}}"""
    command = [program, "--benchmark_format=csv", f"--benchmark_min_time={seconds}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    lines = done.stdout.splitlines()
    start = next((i for i, line in enumerate(lines) if line.startswith("name,")), None)
    if done.returncode != 0 or start is None:
        sys.stderr.write(done.stderr)
        raise SystemExit(f"exit code {done.returncode}: {' '.join(command)}")
    table = {}
    for row in csv.DictReader(lines[start:]):
        kernel, *arguments = row["name"].split("/")
        degree, points, instructions = (int(argument.split(":")[1]) for argument in arguments)
        entry = table.setdefault((kernel.replace("_", " "), degree, points), {})
        if row["error_occurred"] != "true":
            entry[instructions] = 1e6 * float(row["time/cell"])
    return table


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--seconds", type=float, default=0.2, help="of each kernel")
    given = arguments.parse_args()
    print("| kernel | degree | points | baseline [us] | AVX2 [us] | AVX-512 [us] |\n|---|---|---|---|---|---|")
    for (kernel, degree, points), entry in sorted(measured(given.program, given.seconds).items()):
        print(f"| {kernel} | {degree} | {points} | " + " | ".join(f"{float(f'{entry[i]:.2g}'):g}" if i in entry else "" for i in range(3)) + " |")


if __name__ == "__main__":
    main()
