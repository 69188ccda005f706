# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bodies of turned.py: frames, meshes, and scenes in which all that has a direction turns along."""

import math
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
MESHES = HERE.parent.parent / "input" / "bodies"
sys.path.insert(0, str(MESHES))
sys.dont_write_bytecode = True

from make_curved import curved  # noqa: E402


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

    def __init__(self, names, points, elements, units=1):
        """Points in metres, of which the file has `units` each."""
        self.names, self.points, self.elements, self.units = names, points, elements, units

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
                out.write(f"{number} " + " ".join(repr(self.units * x) for x in frame.move(point)) + "\n")
            out.write(f"$EndNodes\n$Elements\n{len(self.elements)}\n")
            for number, (kind, group, nodes) in enumerate(self.elements, 1):
                if kind == 5 and frame.mirrors():
                    nodes = nodes[4:] + nodes[:4]
                if kind == 4 and frame.mirrors():
                    nodes = [nodes[1], nodes[0]] + nodes[2:]
                out.write(f"{number} {kind} 2 {group} {group} " + " ".join(map(str, nodes)) + "\n")
            out.write("$EndElements\n")


class Image:
    """What images give: tetrahedra in millimetres, fibre vectors at points, fat in cells."""

    CELLS = (4, 1, 1)

    def __init__(self):
        self.mesh, self.fibres = curved(self.CELLS)

    def size(self):
        return 0.08

    def write(self, path, frame):
        mesh, _ = curved(self.CELLS)
        mesh.points = [[1000 * x for x in frame.move([x / 1000 for x in point])] for point in mesh.points]
        fat = [0.02 + 0.1 * (i % 3) for i in range(len(mesh.cells))]
        mesh.write_vtu(path, [frame.turn(fibre) for fibre in self.fibres], tetrahedra=True, digits=17, cell_fields={"fat_fraction": fat})


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
    for k in range(n[2]):
        for i in range(n[0]):
            elements.append((3, 6, [number(i, 0, k), number(i + 1, 0, k), number(i + 1, 0, k + 1), number(i, 0, k + 1)]))
    for j in range(n[1]):
        for i in range(n[0]):
            elements.append((3, 5, [number(i, j, n[2]), number(i + 1, j, n[2]), number(i + 1, j + 1, n[2]), number(i, j + 1, n[2])]))
    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                floor = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                roof = [node + (n[0] + 1) * (n[1] + 1) for node in floor]
                elements.append((5, 2 if i == n[0] - 1 else 1, floor + roof))
    return Mesh(['3 1 "muscle"', '3 2 "tendon"', '2 3 "origin"', '2 4 "insertion"', '2 5 "top"', '2 6 "near side"'], points, elements)


def split_mesh():
    """The bar of six tetrahedra for each hexahedron, about the diagonal from its least to its greatest corner; in millimetres."""
    whole = bar_mesh()
    elements = []
    for kind, group, nodes in whole.elements:
        if kind == 3:
            elements += [(2, group, [nodes[0], nodes[1], nodes[2]]), (2, group, [nodes[0], nodes[2], nodes[3]])]
            continue
        corner = [nodes[0], nodes[1], nodes[3], nodes[2], nodes[4], nodes[5], nodes[7], nodes[6]]  # x fastest
        for first, second, right in ((1, 3, True), (1, 5, False), (2, 3, False), (2, 6, True), (4, 5, True), (4, 6, False)):
            tetrahedron = [corner[0], corner[first], corner[second], corner[7]]
            elements.append((4, group, tetrahedron if right else [tetrahedron[1], tetrahedron[0]] + tetrahedron[2:]))
    return Mesh(whole.names, whole.points, elements, units=1000)


def own_mesh():
    """The bar of tetrahedra, its tissues named by the scene."""
    bar = split_mesh()
    return Mesh(['3 1 "wall"', '3 2 "sheath"'] + bar.names[2:], bar.points, bar.elements, bar.units)


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


def scene(frame, fibres, tissue, boundary, extra, markers, shape=True, scale="m", fascicles=1000):
    activation = section("activation", ramp(0.3, 0.04))
    flags = "".join(parameter(name, "bool", "true") for name in ("all faces", "gearing", "conditions", "momenta")) + parameter("shape", "bool", str(shape).lower())
    moved = "; ".join(f"m{i} " + numbers_text(frame.move(x)) for i, x in enumerate(markers))
    return section(
        "scene", parameter("title", "string", "turned"),
        section("system", parameter("type", "string", "muscle 3d"),
                section("geometry", parameter("type", "string", "mesh"), parameter("file", "string", "body.msh"), parameter("scale", "string", scale)),
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


def leaning(frame):
    return section("fibres", parameter("type", "string", "direction"),
                   *(parameter(axis, "double", repr(x)) for axis, x in zip("xyz", frame.turn([math.cos(0.4), 0.1, math.sin(0.4)]))))


def cushion():
    return section("cushion", parameter("face", "string", "near side"), parameter("type", "string", "viscous support"),
                   *(parameter(f"{way} {what}", "double", value) for way in ("normal", "tangential") for what, value in (("stiffness", 2e5), ("damping", 3e3))))


def loads_along():
    pull = section("weight", parameter("face", "string", "insertion"), parameter("type", "string", "isotonic"), parameter("force", "double", 0.4),
                   section("profile", ramp(1, 0.03)))
    press = section("press", parameter("face", "string", "top"), parameter("type", "string", "follower pressure"), parameter("pressure", "double", 300),
                    section("profile", ramp(1, 0.03)))
    return [fixed("origin", "origin"), pull, press, cushion()]


def bar(frame):
    return scene(frame, leaning(frame), tissue_along(frame, "tendon", [1, 0, 0]), loads_along(), "", [[0.02, 0.004, 0.006]])


def own(frame):
    """All kinds of laws: the wall has its fibres from system/fibres, the sheath a direction of its own."""
    def laws(**kinds):
        return section("laws", *(section(name, parameter("type", "string", kind)) for name, kind in kinds.items()))

    wall = section("wall", laws(net="guccione", muscle="active fibre", fluid="viscosity"))
    sheath = section("sheath", parameter("direction", "string", numbers_text(frame.turn([1, 0, 0.2]))),
                     laws(ground="yeoh", threads="tendinous fibre", oil="fibre viscosity"))
    return scene(frame, leaning(frame), section("tissues", section("own", wall, sheath)), loads_along(), "", [[0.02, 0.004, 0.006]], shape=False,
                 scale="mm", fascicles=0)


def split(frame):
    tendon = section("tendon", parameter("face", "string", "insertion"), parameter("type", "string", "tendon spring"),
                     section("spring", parameter("type", "string", "tendinous"), parameter("force", "double", 20),
                             parameter("slack length", "double", 0.05)),
                     section("motion", parameter("type", "string", "smooth step"), parameter("amplitude", "double", 5e-4),
                             parameter("duration", "double", 0.03)))
    # fascicles through all cells: which tetrahedron's part comes first depends on its orientation
    return scene(frame, leaning(frame), tissue_along(frame, "tendon", [1, 0, 0]), [fixed("origin", "origin"), tendon, cushion()], "",
                 [[0.02, 0.004, 0.006]], scale="mm")


def image(frame):
    fields = section("fields", parameter("table", "string", "body.msh"), parameter("table scale", "string", "mm"))
    return scene(frame, "", "", [strain(frame, "insertion"), fixed("origin", "origin")], fields, [[0.005, 0.001, 0.001]], scale="mm")


BODIES = {"bar": (bar_mesh, bar), "split": (split_mesh, split), "own": (own_mesh, own), "image": (Image, image),
          "bipennate": (lambda: Mesh.read(MESHES / "bipennate.msh"), bipennate), "fusiform": (lambda: Mesh.read(MESHES / "fusiform.msh"), fusiform)}
