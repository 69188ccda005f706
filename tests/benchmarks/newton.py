#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What Newton's method costs where it is hard: newton.py PROGRAM [--cases block kinked one hold slender cook indented] [--quick]

Every accepted step ends at a residual of 1e-8 N, whatever the size of the forces, so that counts can be compared. Columns: Newton iterations, Krylov
iterations, steps (of them cut), cuts of the line search, CPU seconds. A run that does not reach its end shows its exit code. Counts do not depend
on the machine, CPU seconds do. Cook's membrane and the indented block end with the displacement of the corner [m] that is known from elsewhere:
6.88145, 6.90425, 6.91953 mm on 4, 8, 16 cells; -0.2186237 and -0.2196810 mm at refinement 2 and 3 for the usual load. The cantilever ends with
the displacement of its tip; the theory of slender beams has -0.0629 and -5.09 mm under 10 N/m^3.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

from block import ENVIRONMENT, HERE

INPUT = os.path.join(HERE, "..", "..", "input")
TIGHT = {"solver/nonlinear/relative tolerance": 1e-15, "solver/nonlinear/absolute tolerance": 1e-8, "output/checkpoint/every": 1000000}
METHODS = ["backward euler", "bdf2", "tr-bdf2", "sdirk2", "sdirk3", "newmark", "hht alpha", "wbz alpha", "generalized alpha", "wilson theta"]


def run(program, scene, settings, marker=None):
    """One row of a table: the cells that belong to a run. Runs end after ten minutes of CPU time."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        command = [program, "run", scene, "--out", out, "--quiet"]
        for path, value in {**TIGHT, **settings}.items():
            command += ["--set", f"{path}={value}"]
        log = open(os.path.join(folder, "log"), "w")
        process = subprocess.Popen(["bash", "-c", 'ulimit -t 600; exec "$@"', "bash"] + command, stdout=log, stderr=log, env=ENVIRONMENT)
        _, status, usage = os.wait4(process.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        process.returncode = code
        try:
            with open(os.path.join(out, "ledger.json")) as file:
                counts = json.load(file)["counts"]
        except (OSError, ValueError):
            return [f"exit code {code}"]
        row = [counts.get("newton iterations", 0), counts.get("linear iterations", 0),
               f"{counts.get('accepted steps', 0)} ({counts.get('rejected steps', 0)})", counts.get("line search cuts", 0),
               f"{usage.ru_utime + usage.ru_stime:.1f}"]
        if marker and code == 0:
            with open(os.path.join(out, "displacements-3d.csv"), newline="") as file:
                row.append(list(csv.reader(file))[-1][marker])
        return row + ([f"exit code {code}"] if code != 0 else [])


def table(title, names, rows):
    print(f"\n{title}\n\n| {' | '.join(names)} | Newton | Krylov | steps (cut) | line search cuts | CPU s | |\n|{'---|' * (len(names) + 6)}")
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
        sys.stdout.flush()


def block(program, quick):
    for refinement in [2] if quick else [2, 3, 4]:
        for kappa in ["1e6", "1e7", "1e8", "1e9"]:
            yield [refinement, kappa] + run(program, os.path.join(INPUT, "isometric_block.xml"), {
                "system/geometry/refinement": refinement, "system/discretisation/quadrature points": 3, "time/step": 0.025, "time/end": 0.2,
                "integrator/type": "backward euler", "system/tissues/muscle/bulk modulus": kappa})


def kinked(program, quick):
    for kappa in ["1e7"] if quick else ["1e7", "1e8", "1e9"]:
        for method in METHODS:
            for steps in [4, 8, 16]:
                settings = {"system/geometry/refinement": 2, "system/discretisation/quadrature points": 3, "time/step": 0.2 / steps,
                            "integrator/type": method, "system/tissues/muscle/bulk modulus": kappa, "time/control/type": "cut back"}
                if method == "wilson theta":
                    settings["time/boundary rates"] = "exact"
                yield [kappa, method, steps] + run(program, os.path.join(INPUT, "kinked_block.xml"), settings)


def one_step(program, _quick):
    for kappa in ["1e7", "1e8", "1e9"]:
        base = {"system/geometry/refinement": 2, "system/discretisation/quadrature points": 3, "system/tissues/muscle/bulk modulus": kappa,
                "integrator/type": "backward euler"}
        yield ["isometric", kappa] + run(program, os.path.join(INPUT, "isometric_block.xml"), {**base, "time/step": 0.2, "time/end": 0.2})
        yield ["stretch by 20 %", kappa] + run(program, os.path.join(INPUT, "kinked_block.xml"), {
            **base, "time/step": 0.2, "time/end": 0.2, "system/boundary/moving end/strain/points": "0 0; 0.2 0.2"})


def hold(program, quick):
    for step in [0.025] if quick else [0.001, 0.01, 0.025, 0.05]:
        for method in METHODS[:3] if quick else METHODS:
            settings = {"system/geometry/refinement": 1, "system/discretisation/quadrature points": 3, "time/step": step, "time/end": 3,
                        "integrator/type": method, "time/control/type": "cut back"}
            if method == "wilson theta":
                settings["time/boundary rates"] = "exact"
            yield [method, step] + run(program, os.path.join(INPUT, "isometric_block.xml"), settings)


def slender(program, quick):
    for slenderness in [10, 30]:
        for force in [10, 1e4]:
            for refinement in [0] if quick else [0, 1]:
                length = 0.01 * slenderness
                yield [slenderness, force, refinement] + run(program, os.path.join(HERE, "cantilever.xml"), {
                    "system/geometry/length": length, "system/geometry/refinement": refinement, "system/body force/z": -force,
                    "output/series/markers": f"tip {length} 0.005 0.005"}, marker=3)


def cook_mesh(path, n):
    """n x n x 1 hexahedra: corners (0, 0), (48, 44), (48, 60), (0, 44) mm, 1 mm thick."""
    nodes, hexahedra, quadrilaterals = {}, [], []

    def node(i, j, k):
        x, left, right = i / n, (0, 44), (44, 60)
        low, high = left[0] + x * (right[0] - left[0]), left[1] + x * (right[1] - left[1])
        at = (48e-3 * x, 1e-3 * (low + j / n * (high - low)), 1e-3 * k)
        return nodes.setdefault((i, j, k), (len(nodes) + 1, at))[0]

    for i in range(n):
        for j in range(n):
            hexahedra.append([node(i + a, j + b, c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
            for c in (0, 1):
                quadrilaterals.append((4, [node(i + a, j + b, c) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]))
    for j in range(n):
        for tag, i in ((1, 0), (2, n)):
            quadrilaterals.append((tag, [node(i, j, 0), node(i, j + 1, 0), node(i, j + 1, 1), node(i, j, 1)]))
    with open(path, "w") as file:
        file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 1 \"left\"\n2 2 \"right\"\n2 4 \"sides\"\n3 3 \"muscle\"\n"
                   f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        for number, at in sorted(nodes.values()):
            file.write(f"{number} {at[0]!r} {at[1]!r} {at[2]!r}\n")
        file.write(f"$EndNodes\n$Elements\n{len(hexahedra) + len(quadrilaterals)}\n")
        for number, (tag, corners) in enumerate(quadrilaterals, 1):
            file.write(f"{number} 3 2 {tag} {tag} {' '.join(map(str, corners))}\n")
        for number, corners in enumerate(hexahedra, len(quadrilaterals) + 1):
            file.write(f"{number} 5 2 3 3 {' '.join(map(str, corners))}\n")
        file.write("$EndElements\n")


def cook(program, quick):
    for n in [4, 8] if quick else [4, 8, 16, 32]:
        with tempfile.TemporaryDirectory() as folder:
            cook_mesh(os.path.join(folder, "cook.msh"), n)
            scene = os.path.join(folder, "cook.xml")
            with open(os.path.join(HERE, "cook.xml")) as template, open(scene, "w") as file:
                file.write(template.read())
            yield [n] + run(program, scene, {}, marker=2)


def indented(program, quick):
    for refinement in [2] if quick else [2, 3]:
        for load in [20, 40, 60, 80]:
            yield [refinement, load] + run(program, os.path.join(INPUT, "verification", "indented_block.xml"), {
                "system/geometry/refinement": refinement, "system/boundary/indenter/pressure": 4e6 * load,
                "time/control/type": "cut back"}, marker=2)


CASES = {"block": ("Isometric block, backward Euler, 8 steps of 0.025 s", ["refinement", "kappa [Pa]"], block),
         "kinked": ("Kinked block, refinement 2", ["kappa [Pa]", "method", "steps"], kinked),
         "one": ("One step of 0.2 s", ["what", "kappa [Pa]"], one_step),
         "hold": ("Isometric block, fully active, held until 3 s", ["method", "step [s]"], hold),
         "slender": ("Passive cantilever bent by its weight in one step", ["length over height", "N/m^3", "refinement"], slender),
         "cook": ("Cook's membrane, kappa/mu = 5000, five steps", ["cells"], cook),
         "indented": ("Indented block, ten steps", ["refinement", "p/p0"], indented)}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--cases", nargs="+", default=list(CASES), choices=list(CASES))
    arguments.add_argument("--quick", action="store_true", help="the smaller half of each table")
    given = arguments.parse_args()
    for case in given.cases:
        title, names, rows = CASES[case]
        table(title, names, rows(given.program, given.quick))


if __name__ == "__main__":
    main()
