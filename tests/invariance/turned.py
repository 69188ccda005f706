#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A muscle does not know how it lies: every column of every table of a turned, moved and mirrored muscle is that of the muscle itself.

turned.py PROGRAM WORK_FOLDER [--count N] [--tolerance 1e-9] [--set PATH=VALUE ...] [BODY ...]

Bodies: bipennate, fusiform (the meshes of input/bodies), bar (a small tapered bar with a tendon and a support, written here), split (the same bar of
tetrahedra, in millimetres, with springs and dashpots at its faces), own (the same of two tissues of the scene's own), image (a curved muscle of tetrahedra
in millimetres, with fibre vectors at its points and fat in its cells, as VTK file). Each is run as it lies, then N times
rotated about a random axis, moved by up to its length and, every second time, mirrored; meshes, directions, formulas, loads and markers with it. Scalars
must be equal, and vectors, which are columns whose names differ by x, y and z alone, after they are turned back, to the tolerance times the greatest
value of their column (of the three of a vector). Energies, forces and work densities, which cancel, are compared on the scale of the greatest of the run,
angular momenta on that of the greatest momentum times the length of the body, angles on that of a degree at least. The numbers are drawn with a fixed seed.
Exit code 1 if anything differs.
"""

import argparse
import csv
import math
import os
import pathlib
import random
import re
import subprocess
import sys

sys.dont_write_bytecode = True
from turned_bodies import BODIES, Frame  # noqa: E402

# Solvers to rounding: what is left is what the frame does.
EXACT = ["solver/preconditioner/type=direct", "solver/nonlinear/relative tolerance=1e-12"]


def run(program, folder, mesh, text, frame, settings):
    folder.mkdir(parents=True)
    mesh.write(folder / "body.msh", frame)
    (folder / "scene.xml").write_text(text, encoding="utf-8")
    command = [program, "run", "scene.xml", "--out", "out", "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{folder}: exit code {done.returncode}\n{done.stderr}")


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file))
    return head, [[float(x) if x else math.nan for x in row] for row in rows]


AXIS = re.compile(r"(^|[ _])x( \[|$)")


def vectors(head):
    """Places of the three columns of each vector."""
    found = []
    for i, name in enumerate(head):
        if AXIS.search(name):
            names = [AXIS.sub(lambda m: m.group(1) + axis + m.group(2), name) for axis in "xyz"]
            if all(n in head for n in names):
                found.append([head.index(n) for n in names])
    return found


AXIAL = re.compile(r"Angular momentum|\bmoment\b")  # of which a mirror turns the sense as well


def turned_back(head, rows, frame):
    rows = [list(row) for row in rows]
    for places in vectors(head):
        name = head[places[0]]
        sense = -1 if frame.mirrors() and AXIAL.search(name) else 1
        shift = frame.b if name.startswith("Centre of mass") else [0, 0, 0]
        for row in rows:
            for place, x in zip(places, frame.back([sense * row[p] - b for p, b in zip(places, shift)])):
                row[place] = x
    return rows


CANCELLING = ("[J]", "[N]", "[J/m^3]", "[kg m/s]")


def greatest(tables, length):
    """By unit of what cancels, the greatest value in all tables; of angular momentum, the greatest momentum times the length of the body."""
    scales = dict.fromkeys(CANCELLING, 0.0)
    for head, rows in tables:
        for unit in CANCELLING:
            scales[unit] = max([scales[unit]] + [abs(row[i]) for i, title in enumerate(head) if title.endswith(unit) for row in rows])
    scales["[kg m^2/s]"] = scales.pop("[kg m/s]") * length
    return scales


def compare(name, head, rows, other, scales, tolerance):
    """Lines about what differs."""
    groups = vectors(head)
    together = {place: places for places in groups for place in places}
    problems = []
    if len(rows) != len(other):
        return [f"{name}: {len(other)} rows instead of {len(rows)}"]
    for column, title in enumerate(head):
        if title == "Boundary ID":
            continue
        scale = max((abs(row[c]) for row in rows for c in together.get(column, [column]) if not math.isnan(row[c])), default=0)
        scale = max([scale] + [greatest for unit, greatest in scales.items() if title.endswith(unit)])
        if title.endswith("[deg]"):
            scale = max(scale, 1)
        for number, (row, again) in enumerate(zip(rows, other)):
            a, b = row[column], again[column]
            if math.isnan(a) != math.isnan(b) or abs(a - b) > tolerance * scale + 1e-300:
                problems.append(f"{name}, row {number + 1}, {title}: {a!r} and turned {b!r}, {abs(a - b) / scale if scale else math.nan:.1e} of the greatest")
                break
    return problems


def tables(folder):
    skipped = {"steps.csv"}  # iterations may differ by rounding
    return sorted(path.name for path in (folder / "out").glob("*.csv") if path.name not in skipped)


def check(program, body, work, count, tolerance, settings):
    mesh, make = BODIES[body][0](), BODIES[body][1]
    still = Frame([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 0.0, 0.0])
    run(program, work / "still", mesh, make(still), still, settings)
    names = tables(work / "still")
    scales = greatest((table(work / "still" / "out" / name) for name in names), mesh.size())
    draw = random.Random(f"{body} turned")
    problems = []
    for turn in range(count):
        frame = Frame.draw(draw, mesh.size(), turn % 2 == 1)
        folder = work / f"turned-{turn}"
        run(program, folder, mesh, make(frame), frame, settings)
        if tables(folder) != names:
            problems.append(f"turn {turn}: other tables")
            continue
        for name in names:
            head, rows = table(work / "still" / "out" / name)
            again, other = table(folder / "out" / name)
            if head != again:
                problems.append(f"turn {turn}, {name}: other columns")
                continue
            problems += [f"turn {turn}, {line}" for line in compare(name, head, rows, turned_back(head, other, frame), scales, tolerance)]
    print(f"{body}: {count} times, {len(names)} tables, {len(problems)} differences beyond {tolerance:g}")
    for line in problems[:20]:
        print("  " + line)
    return not problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("bodies", nargs="*", metavar="BODY")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--tolerance", type=float, default=1e-9)
    parser.add_argument("--default-solvers", action="store_true", help="not solvers to rounding")
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_intermixed_args()
    program = str(options.program.resolve())
    if options.work.exists():
        subprocess.run(["rm", "-rf", str(options.work)], check=True)
    settings = ([] if options.default_solvers else EXACT) + options.set
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    good = [check(program, body, options.work / body, options.count, options.tolerance, settings)
            for body in options.bodies or BODIES]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
