#!/usr/bin/env python3
"""Methods beside boundary rates and events, where a moving end has kinks: boundary_rates.py INTEGRATORS_IN_THE_MUSCLE [--steps 32]

Errors of u in input/kinked_block.xml at refinement 1 with fixed steps, each against 512 steps of SDIRK3 with the same choices. The program is the one that makes the
table of doc/integrators_in_the_muscle.md.
"""

import argparse
import subprocess
import sys

from block import ENVIRONMENT

CHOICES = {"scheme, land": [], "exact, land": ["time/boundary rates=exact"], "exact, restart": ["time/boundary rates=exact", "time/events=restart"],
           "exact, restart, impulse": ["time/boundary rates=exact", "time/events=restart", "time/start velocity=impulse"]}


def column(program, settings, steps):
    """{scheme: error, or "fails"} with the settings."""
    done = subprocess.run([program, "1", "512", "/dev/null", *settings], env=ENVIRONMENT, capture_output=True, text=True, check=False)
    table = [[cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines() if line.startswith("|")]
    if done.returncode not in (0, 1) or not table:  # 1: numbers differ from those of the study, as with other choices they must
        sys.stderr.write(done.stderr)
        raise SystemExit(f"exit code {done.returncode}: {program}")
    place = table[0].index(f"eU n={steps}")
    return {row[0]: row[place].split(" (")[0].strip("*") for row in table[2:]}


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--steps", type=int, default=32)
    given = arguments.parse_args()
    columns = {name: column(given.program, settings, given.steps) for name, settings in CHOICES.items()}
    print("| scheme | " + " | ".join(columns) + " |\n|" + "---|" * (1 + len(columns)))
    for scheme in next(iter(columns.values())):
        print(f"| {scheme} | " + " | ".join(errors[scheme] for errors in columns.values()) + " |")


if __name__ == "__main__":
    main()
