#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What tangents by dual numbers cost beside those by hand, in instructions: laws.py BENCHMARK_LAWS [--at-most RATIO]

Runs `benchmark_laws --once` under callgrind and prints, for every law, the instructions for a point of a cell of its stress, of the tangent's action along one
direction and of all moduli, both ways. With --at-most exit code 1 if a ratio is larger. Exit code 77 where there is no valgrind, or no AVX2.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

WORKS = ("stresses", "actions", "all_moduli")


def plain(law):
    """The name of its struct alone: "Yeoh" of "myolines::Yeoh<double>"."""
    return re.sub(r"<.*", "", law).split("::")[-1].strip()


def counted(program):
    """The lines of the program, and its instructions by (work, struct of the law, whether by dual numbers)."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        run = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=" + out, program, "--once"], capture_output=True, text=True, check=False)
        if run.returncode != 0:
            sys.stderr.write(run.stderr)
            raise SystemExit(1)
        told = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", out], capture_output=True, text=True, check=True).stdout
    counts = {}
    for line in told.splitlines():
        found = re.match(r"\s*([\d,]+) .*?\b(" + "|".join(WORKS) + r")<(.*)>\(", line)
        if found:
            dual = re.search(r"ByDualNumbers<(.*)>", found[3])
            counts[found[2], plain(dual[1] if dual else found[3]), bool(dual)] = int(found[1].replace(",", ""))
    return run.stdout.splitlines(), counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--at-most", type=float)
    given = parser.parse_args()
    with open("/proc/cpuinfo", encoding="utf-8") as cpus:
        if shutil.which("valgrind") is None or not re.search(r"\bavx2\b", cpus.read()):
            print("there is no valgrind, or the processor has no AVX2", file=sys.stderr)
            return 77
    lines, counts = counted(given.program)
    print("| law | stress | action by hand | dual | ratio | moduli by hand | dual | ratio |\n|---|---|---|---|---|---|---|---|")
    worst = 0.0
    for name, law, points in (line.split(",") for line in lines):
        row = [name, f"{counts['stresses', plain(law), False] / int(points):.0f}"]
        for work in WORKS[1:]:
            hand, dual = counts.get((work, plain(law), False)), counts[work, plain(law), True]
            row += [f"{hand / int(points):.0f}" if hand else "", f"{dual / int(points):.0f}", f"{dual / hand:.2f}" if hand else ""]
            worst = max(worst, dual / hand if hand else 0)
        print("| " + " | ".join(row) + " |")
    if given.at_most is not None and worst > given.at_most:
        print(f"a tangent by dual numbers takes {worst:.2f} times the instructions of that by hand, more than {given.at_most:g}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
