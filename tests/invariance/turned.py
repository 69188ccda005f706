#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A muscle does not know how it lies: every column of every table of a turned, moved and mirrored muscle is that of the muscle itself.

turned.py PROGRAM WORK_FOLDER [--count N] [--tolerance 1e-9] [--set PATH=VALUE ...] [BODY ...]

Bodies: bipennate, fusiform (the meshes of input/bodies), bar (a small tapered bar with a tendon, written here), own (the same bar of two tissues of the
scene's own, in tetrahedra and millimetres). Each is run as it lies, then N times
rotated about a random axis, moved by up to its length and, every second time, mirrored; meshes, directions, formulas, loads and markers with it. Scalars
must be equal, and vectors, which are columns whose names differ by x, y and z alone, after they are turned back, to the tolerance times the greatest
value of their column (of the three of a vector). Energies, forces and work densities, which cancel, are compared on the scale of the greatest of the run,
angles on that of a degree at least. The numbers are drawn with a fixed seed. Exit code 1 if anything differs.
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

HERE = pathlib.Path(__file__).resolve().parent
BODIES = HERE.parent.parent / "input" / "bodies"

# Solvers to rounding: what is left is what the frame does.
EXACT = ["solver/preconditioner/type=direct", "solver/nonlinear/relative tolerance=1e-12"]


class Frame:
    """x -> R x + b, R orthogonal."""

    def __init__(self, rotation, shift):
        self.R, self.b = rotation, shift

    @staticmethod
    def draw(numbers, size, mirrored):
        axis = [numbers.gauss(0, 1) for _ in range(3)]
        norm = math.sqrt(sum(x * x for x in axis))
        n = [x / norm for x in axis]
        angle = numbers.uniform(0.2, math.pi)
        c, s = math.cos(angle), math.sin(angle)
        cross = [[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]]
        R = [[(c if i == j else 0) + (1 - c) * n[i] * n[j] + s * cross[i][j] for j in range(3)] for i in range(3)]
        if mirrored:
            R = [[R[i][0], R[i][1], -R[i][2]] for i in range(3)]
        return Frame(R, [numbers.uniform(-size, size) for _ in range(3)])

    def turn(self, v):
        return [sum(self.R[i][j] * v[j] for j in range(3)) for i in range(3)]

    def back(self, v):
        return [sum(self.R[i][j] * v[i] for i in range(3)) for j in range(3)]

    def move(self, x):
        return [y + b for y, b in zip(self.turn(x), self.b)]

    def mirrors(self):
        R = self.R
        det = sum(R[0][i] * (R[1][(i + 1) % 3] * R[2][(i + 2) % 3] - R[1][(i + 2) % 3] * R[2][(i + 1) % 3]) for i in range(3))
        return det < 0

    def formulas(self, three):
        """Those of the turned body for a vector field given by three formulas of x, y, z."""
        old = [" + ".join(f"({self.R[i][j]!r})*({name} - ({self.b[i]!r}))" for i, name in enumerate("xyz")) for j in range(3)]
        moved = [re.sub(r"\b([xyz])\b", lambda m: f"({old['xyz'.index(m.group(1))]})", text) for text in three]
        return [" + ".join(f"({self.R[i][j]!r})*({moved[j]})" for j in range(3)) for i in range(3)]


class Mesh:
    """Of a Gmsh file (2.2, ASCII): lines of names, points [m], elements as (kind, group, vertices); files are written in the unit [m]."""

    def __init__(self, names, points, elements, unit=1.0):
        self.names, self.points, self.elements, self.unit = names, points, elements, unit

    @staticmethod
    def read(path):
        lines = path.read_text(encoding="utf-8").splitlines()

        def section(name):
            return lines[lines.index(f"${name}") + 2:lines.index(f"$End{name}")]

        elements = []
        for line in section("Elements"):
            numbers = [int(word) for word in line.split()]
            elements.append((numbers[1], numbers[3], numbers[3 + numbers[2]:]))
        return Mesh(section("PhysicalNames"), [[float(x) for x in line.split()[1:]] for line in section("Nodes")], elements)

    def size(self):
        return max(max(p[c] for p in self.points) - min(p[c] for p in self.points) for c in range(3))

    def write(self, path, frame):
        with open(path, "w", encoding="utf-8") as out:
            out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(self.names)}\n" + "".join(name + "\n" for name in self.names))
            out.write(f"$EndPhysicalNames\n$Nodes\n{len(self.points)}\n")
            for number, point in enumerate(self.points, 1):
                out.write(f"{number} " + " ".join(repr(x / self.unit) for x in frame.move(point)) + "\n")
            out.write(f"$EndNodes\n$Elements\n{len(self.elements)}\n")
            for number, (kind, group, nodes) in enumerate(self.elements, 1):
                if kind == 5 and frame.mirrors():
                    nodes = nodes[4:] + nodes[:4]
                if kind == 4 and frame.mirrors():
                    nodes = [nodes[1], nodes[0]] + nodes[2:]
                out.write(f"{number} {kind} 2 {group} {group} " + " ".join(map(str, nodes)) + "\n")
            out.write("$EndElements\n")


def bar_mesh():
    """3 x 1 x 1.4 cm, tapered and sheared, four cells along x of which the last is tendon."""
    n = (4, 2, 1)
    points = []
    for k in range(n[2] + 1):
        for j in range(n[1] + 1):
            for i in range(n[0] + 1):
                taper = 1 - 0.1 * i / n[0]
                points.append([0.03 * i / n[0], taper * 0.01 * j / n[1], taper * 0.014 * k / n[2] + 0.002 * i / n[0]])

    def number(i, j, k):
        return 1 + i + (n[0] + 1) * (j + (n[1] + 1) * k)

    elements = []
    for k in range(n[2]):
        for j in range(n[1]):
            for i, group in ((0, 3), (n[0], 4)):
                elements.append((3, group, [number(i, j, k), number(i, j + 1, k), number(i, j + 1, k + 1), number(i, j, k + 1)]))
    for j in range(n[1]):
        for i in range(n[0]):
            elements.append((3, 5, [number(i, j, n[2]), number(i + 1, j, n[2]), number(i + 1, j + 1, n[2]), number(i, j + 1, n[2])]))
    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                floor = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                roof = [node + (n[0] + 1) * (n[1] + 1) for node in floor]
                elements.append((5, 2 if i == n[0] - 1 else 1, floor + roof))
    return Mesh(['3 1 "muscle"', '3 2 "tendon"', '2 3 "origin"', '2 4 "insertion"', '2 5 "top"'], points, elements)


# Hexahedra in six tetrahedra along the diagonal from corner 0 to 6, and their faces in two triangles along the diagonals that these have.
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
TRIANGLES = ((0, 1, 2), (0, 2, 3))


def own_mesh():
    """The bar in tetrahedra and millimetres, its tissues named by the scene."""
    bar = bar_mesh()
    elements = []
    for kind, group, nodes in bar.elements:
        pieces, simplex = (TRIANGLES, 2) if kind == 3 else (TETRAHEDRA, 4)
        elements += [(simplex, group, [nodes[i] for i in piece]) for piece in pieces]
    return Mesh(['3 1 "wall"', '3 2 "sheath"'] + bar.names[2:], bar.points, elements, unit=1e-3)


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{escape(str(value))}"/>'


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")


def section(name, *content):
    return f'<ParameterList name="{name}">' + "".join(content) + "</ParameterList>"


def numbers_text(v):
    return " ".join(repr(x) for x in v)


def three(frame, prefix, texts):
    return "".join(parameter(prefix + axis, "string", text) for axis, text in zip("xyz", frame.formulas(texts)))


def ramp(amplitude, duration):
    return parameter("type", "string", "smooth step") + parameter("amplitude", "double", amplitude) + parameter("duration", "double", duration)


def scene(frame, fibres, tissue, boundary, extra, markers, shape=True, unit="1", fascicles=12):
    activation = section("activation", ramp(0.3, 0.04))
    flags = "".join(parameter(name, "bool", "true") for name in ("all faces", "gearing")) + parameter("shape", "bool", str(shape).lower())
    moved = "; ".join(f"m{i} " + numbers_text(frame.move(x)) for i, x in enumerate(markers))
    return section(
        "scene", parameter("title", "string", "turned"),
        section("system", parameter("type", "string", "muscle 3d"),
                section("geometry", parameter("type", "string", "gmsh"), parameter("file", "string", "body.msh"), parameter("scale", "string", unit)),
                section("discretisation", parameter("degree", "int", 1), parameter("quadrature points", "int", 3)), tissue, fibres,
                section("boundary", *boundary), activation, extra),
        section("integrator", parameter("type", "string", "backward euler")),
        section("time", parameter("end", "double", 0.04), parameter("step", "double", 0.01)),
        section("output", section("series", flags, parameter("fascicles", "int", fascicles), parameter("strain places", "string", "0.25 0.5"),
                                  parameter("markers", "string", moved))))


def tissue_along(frame, kind, direction):
    return section("tissues", section(kind, section("fibre", parameter("direction", "string", numbers_text(frame.turn(direction))))))


def fixed(name, face):
    return section(name, parameter("face", "string", face), parameter("type", "string", "fixed"))


def strain(frame, face, direction=None):
    return section("moving end", parameter("face", "string", face), parameter("type", "string", "strain"),
                   parameter("direction", "string", numbers_text(frame.turn(direction))) if direction else "", section("strain", ramp(0.02, 0.04)))


def bipennate(frame):
    lean = "(25*pi/180)"
    fibres = section("fibres", parameter("type", "string", "formula"),
                     three(frame, "", [f"cos{lean}", "0", f"(z)<0 ? sin{lean} : -sin{lean}"]))
    return scene(frame, fibres, tissue_along(frame, "aponeurosis", [1, 0, 0]), [strain(frame, "insertion", [1, 0, 0]), fixed("origin", "origin")], "",
                 [[0.01, 0.001, 0.005], [0.02, 0, -0.004]])


def fusiform(frame):
    fibres = section("fibres", parameter("type", "string", "laplace"), parameter("from", "string", "proximal end"),
                     parameter("to", "string", "distal end"))
    force = section("body force", three(frame, "", ["0", "-2000*(1+0.1*(x))", "0"]))
    return scene(frame, fibres, tissue_along(frame, "tendon", [1, 0, 0]), [strain(frame, "distal end"), fixed("fixed end", "proximal end")], force,
                 [[0.04, 0.001, 0.002]], shape=False)  # fibres lean to all sides


def along(frame):
    """Fibres of the bar, and its load: what they are and boundary conditions."""
    fibres = section("fibres", parameter("type", "string", "direction"),
                     *(parameter(axis, "double", repr(x)) for axis, x in zip("xyz", frame.turn([math.cos(0.4), 0.1, math.sin(0.4)]))))
    pull = section("weight", parameter("face", "string", "insertion"), parameter("type", "string", "isotonic"), parameter("force", "double", 0.4),
                   section("profile", ramp(1, 0.03)))
    press = section("press", parameter("face", "string", "top"), parameter("type", "string", "follower pressure"), parameter("pressure", "double", 300),
                    section("profile", ramp(1, 0.03)))
    return fibres, [fixed("origin", "origin"), pull, press], [[0.02, 0.004, 0.006]]


def bar(frame):
    fibres, boundary, markers = along(frame)
    return scene(frame, fibres, tissue_along(frame, "tendon", [1, 0, 0]), boundary, "", markers)


def own(frame):
    """All kinds of laws: the wall has its fibres from system/fibres, the sheath a direction of its own."""
    def laws(**kinds):
        return section("laws", *(section(name, parameter("type", "string", kind)) for name, kind in kinds.items()))

    wall = section("wall", laws(net="guccione", muscle="active fibre", fluid="viscosity"))
    sheath = section("sheath", parameter("direction", "string", numbers_text(frame.turn([1, 0, 0.2]))),
                     laws(ground="yeoh", threads="tendinous fibre", oil="fibre viscosity"))
    fibres, boundary, markers = along(frame)
    return scene(frame, fibres, section("tissues", section("own", wall, sheath)), boundary, "", markers, shape=False, unit="mm", fascicles=0)


def mesh_of(body):
    return bar_mesh() if body == "bar" else own_mesh() if body == "own" else Mesh.read(BODIES / f"{body}.msh")


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


def turned_back(head, rows, frame):
    rows = [list(row) for row in rows]
    for places in vectors(head):
        for row in rows:
            for place, x in zip(places, frame.back([row[p] for p in places])):
                row[place] = x
    return rows


CANCELLING = ("[J]", "[N]", "[J/m^3]")


def greatest(tables):
    """By unit of what cancels, the greatest value in all tables."""
    scales = dict.fromkeys(CANCELLING, 0.0)
    for head, rows in tables:
        for unit in CANCELLING:
            scales[unit] = max([scales[unit]] + [abs(row[i]) for i, title in enumerate(head) if title.endswith(unit) for row in rows])
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
    mesh, make = mesh_of(body), {"bipennate": bipennate, "fusiform": fusiform, "bar": bar, "own": own}[body]
    still = Frame([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 0.0, 0.0])
    run(program, work / "still", mesh, make(still), still, settings)
    names = tables(work / "still")
    scales = greatest(table(work / "still" / "out" / name) for name in names)
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
            for body in options.bodies or ("bar", "own", "bipennate", "fusiform")]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
