#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The force of a muscle of split tetrahedra beside that of hexahedra, for doc/meshes.md.

split_mesh.py MYOLINES

The body is the curved one of input/bodies, as the few cells have it that it is made of. Each is cut into six tetrahedra, which the program splits into 24
hexahedra, or into 3 x 3 x 3 hexahedra. Refined, each of these is cut into 2 x 2 x 2 once more; squeezed, every other layer of cells has a tenth of its
thickness. The muscle is held at both ends and activated to one half in 5 steps, without inertia; the force is that on the insertion, along x. The last column
is the difference from the hexahedra of the same body, degree and refinement.
"""
import argparse
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "input", "bodies"))
sys.dont_write_bytecode = True
from make_curved import curved  # noqa: E402
from structured_mesh import StructuredMesh  # noqa: E402

# Cells along and across, degree, refinement, how much is squeezed.
CASES = (((4, 2, 2), 1, 0, 0), ((4, 2, 2), 2, 0, 0), ((4, 2, 2), 2, 1, 0), ((4, 2, 2), 1, 0, 0.9), ((4, 2, 2), 2, 0, 0.9),
         ((6, 3, 3), 1, 0, 0), ((6, 3, 3), 2, 0, 0))
CUTS = 3  # of hexahedra


def cut(body, m, squeeze=0):
    """The curved body of so many cells, each cut in m parts along each edge, and its fibres."""
    base, fibres = curved(body, squeeze)

    def at(values, ijk):
        cell = [min(x // m, body[d] - 1) for d, x in enumerate(ijk)]
        local = [x / m - cell[d] for d, x in enumerate(ijk)]
        total = [0.0, 0.0, 0.0]
        for a in (0, 1):
            for b in (0, 1):
                for c in (0, 1):
                    weight = math.prod(t if side else 1 - t for side, t in zip((a, b, c), local))
                    for d, x in enumerate(values[base.number(cell[0] + a, cell[1] + b, cell[2] + c)]):
                        total[d] += weight * x
        return total

    n = [m * x for x in body]
    mesh = StructuredMesh(n, lambda *ijk: at(base.points, ijk), lambda *ijk: "muscle",
                          lambda axis, side, *ijk: ("origin", "insertion")[side] if axis == 0 else None)
    return mesh, [at(fibres, (i, j, k)) for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1)]


def measure(program, folder, case, tetrahedra):
    """Cells, unknowns, worst scaled Jacobian, force [N], Newton and linear iterations."""
    body, degree, refinement, squeeze = case
    mesh, fibres = cut(body, 1 if tetrahedra else CUTS, squeeze)
    path = os.path.join(folder, "body.vtu")
    mesh.write_vtu(path, fibres, tetrahedra, digits=12)
    settings = {"system/geometry/file": path, "system/geometry/refinement": refinement, "system/fields/table": path, "system/inertia": "quasi-static",
                "system/discretisation/degree": degree, "system/activation/type": "ramp", "integrator/type": "static", "time/end": 0.2, "time/step": 0.04}
    arguments = [os.path.join(ROOT, "input", "bodies", "curved.xml")]
    arguments += [x for key, value in settings.items() for x in ("--set", f"{key}={value}")]
    told = subprocess.run([program, "check", *arguments], check=True, capture_output=True, text=True).stdout
    results = os.path.join(folder, "results")
    subprocess.run([program, "run", *arguments, "--out", results, "--quiet", "--overwrite"], check=True)
    with open(os.path.join(results, "reaction.csv")) as file:
        rows = list(csv.reader(file))
    with open(os.path.join(results, "ledger.json")) as file:
        counts = json.load(file)["counts"]
    worst = float(re.search(r"scaled Jacobian of a cell: (\S+)", told).group(1))
    return [re.search(r"^  cells: (\d+)", told, re.M).group(1), re.search(r"unknowns: (\d+)", told).group(1),
            f"{worst:.2g}", float(rows[-1][1]), str(counts["newton iterations"]),
            str(counts.get("linear iterations", 0))]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    options = parser.parse_args()
    print("| mesh | degree | cells | unknowns | smallest scaled Jacobian | Newton iterations | linear iterations | force [N] | from hexahedra [%] |\n"
          "|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            twin, own = (measure(options.program, folder, case, tetrahedra) for tetrahedra in (False, True))
            words = ", refined" * case[2] + ", squeezed" * (case[3] > 0)
            for name, (cells, unknowns, worst, force, newton, krylov) in (("hexahedra", twin), ("split tetrahedra", own)):
                off = f"{100 * (own[3] / twin[3] - 1):.2f}" if name != "hexahedra" else ""
                print(f"| {name}{words} | {case[1]} | {cells} | {unknowns} | {worst} | {newton} | {krylov} | {force:.5g} | {off} |", flush=True)


if __name__ == "__main__":
    main()
