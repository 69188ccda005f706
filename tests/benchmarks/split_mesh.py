#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The force of a muscle of split tetrahedra beside that of hexahedra, for doc/meshes.md.

split_mesh.py MYOLINES

The body is the curved one of input/bodies, as the few cells have it that it is made of. Each is cut into six tetrahedra, which the program splits into 24
hexahedra, or into 3 x 3 x 3 hexahedra. The muscle is held at both ends and activated to one half in 5 steps, without inertia; the force is that on the
insertion, along x. The last column is the difference from the hexahedra of the same body and degree.
"""
import argparse
import csv
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

BODIES = ((4, 2, 2), (6, 3, 3))  # cells along and across
CUTS = 3  # of hexahedra


def cut(body, m):
    """The curved body of so many cells, each cut in m parts along each edge, and its fibres."""
    base, fibres = curved(body)

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


def measure(program, folder, body, tetrahedra, degree):
    """Cells, unknowns, worst scaled Jacobian and force [N]."""
    mesh, fibres = cut(body, 1 if tetrahedra else CUTS)
    path = os.path.join(folder, "body.vtu")
    mesh.write_vtu(path, fibres, tetrahedra, digits=12)
    settings = {"system/geometry/file": path, "system/fields/table": path, "system/inertia": "quasi-static", "system/discretisation/degree": degree,
                "system/activation/type": "ramp", "integrator/type": "static", "time/end": 0.2, "time/step": 0.04}
    arguments = [os.path.join(ROOT, "input", "bodies", "curved.xml")] + [x for key, value in settings.items() for x in ("--set", f"{key}={value}")]
    told = subprocess.run([program, "check", *arguments], check=True, capture_output=True, text=True).stdout
    results = os.path.join(folder, f"{body[0]}-{tetrahedra}-{degree}")
    subprocess.run([program, "run", *arguments, "--out", results, "--quiet"], check=True)
    with open(os.path.join(results, "reaction.csv")) as file:
        rows = list(csv.reader(file))
    return (int(re.search(r"^  cells: (\d+)", told, re.M).group(1)), int(re.search(r"unknowns: (\d+)", told).group(1)),
            float(re.search(r"scaled Jacobian of a cell: (\S+)", told).group(1)), float(rows[-1][1]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    options = parser.parse_args()
    print("| mesh | degree | cells | unknowns | smallest scaled Jacobian | force [N] | from hexahedra [%] |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for body in BODIES:
            for degree in (1, 2):
                twin = measure(options.program, folder, body, False, degree)
                own = measure(options.program, folder, body, True, degree)
                for name, (cells, unknowns, worst, force), off in (("hexahedra", twin, ""), ("split tetrahedra", own, f"{100 * (own[3] / twin[3] - 1):.2f}")):
                    print(f"| {name} | {degree} | {cells} | {unknowns} | {worst:.3g} | {force:.5g} | {off} |", flush=True)


if __name__ == "__main__":
    main()
