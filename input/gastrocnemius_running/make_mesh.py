#!/usr/bin/env python3
"""Writes gastrocnemius.msh (Gmsh 2.2, ASCII): a human medial gastrocnemius of 22 cm and 126.01 cm^3 in 1265 hexahedra, as in thesis 6.6.

Built, not scanned. Length, volume and number of cells are those of the thesis; the rest is a choice: flat rounded cross-sections three times as wide as
thick, whose area grows to a maximum at 0.45 of the length and falls to an eighth of it at the ends, on a centre line that bulges by 5 mm.
The line of action is x; physical surfaces "proximal end" (x = 0), "distal end" (x = 0.22 m) and "skin"; physical volume "muscle".

    make_mesh.py [FILE]
"""
import math
import sys

LENGTH, VOLUME = 0.22, 126.01e-6  # m, m^3
N = (23, 11, 5)  # cells along x, y (width), z (thickness)
FLATNESS, ROUNDNESS, BULGE = 3.0, 0.75, 0.005
ENDS, PEAK = 0.125, 0.45


def area(s):
    """Relative area of the cross-section at s in [0, 1]."""
    warped = s ** (math.log(0.5) / math.log(PEAK))
    return ENDS + (1 - ENDS) * math.sin(math.pi * warped) ** 1.5


def section(u, v):
    """A square [-1, 1]^2 with rounded corners."""
    return u * math.sqrt(1 - ROUNDNESS * v * v / 2), v * math.sqrt(1 - ROUNDNESS * u * u / 2)


def position(i, j, k, scale):
    s = i / N[0]
    y, z = section(2 * j / N[1] - 1, 2 * k / N[2] - 1)
    r = scale * math.sqrt(area(s))
    return LENGTH * s, r * math.sqrt(FLATNESS) * y, r / math.sqrt(FLATNESS) * z + BULGE * math.sin(math.pi * s)


def nodes(scale):
    return [position(i, j, k, scale) for k in range(N[2] + 1) for j in range(N[1] + 1) for i in range(N[0] + 1)]


def number(i, j, k):
    return i + (N[0] + 1) * (j + (N[1] + 1) * k)


def cells():
    for k in range(N[2]):
        for j in range(N[1]):
            for i in range(N[0]):
                low = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                yield low + [n + number(0, 0, 1) for n in low]


def faces():
    """(group, four nodes) of all quadrilaterals at the boundary; groups 1, 2, 3 are proximal end, distal end, skin."""
    for k in range(N[2]):
        for j in range(N[1]):
            for group, i in ((1, 0), (2, N[0])):
                yield group, [number(i, j, k), number(i, j + 1, k), number(i, j + 1, k + 1), number(i, j, k + 1)]
    for i in range(N[0]):
        for k in range(N[2]):
            for j in (0, N[1]):
                yield 3, [number(i, j, k), number(i + 1, j, k), number(i + 1, j, k + 1), number(i, j, k + 1)]
        for j in range(N[1]):
            for k in (0, N[2]):
                yield 3, [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]


def volume(points):
    """Sum over the cells of the integral of the trilinear map's determinant, exact with two Gauss points per direction."""
    g = [0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3)]
    signs = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    total = 0
    for cell in cells():
        for x in g:
            for y in g:
                for z in g:
                    at = (x, y, z)
                    J = [[0.0] * 3 for _ in range(3)]
                    for n, c in zip(cell, signs):
                        for d in range(3):
                            slope = 1.0
                            for e in range(3):
                                factor = at[e] if c[e] else 1 - at[e]
                                slope *= (1 if c[e] else -1) if e == d else factor
                            for a in range(3):
                                J[a][d] += slope * points[n][a]
                    total += (J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) - J[0][1] * (J[1][0] * J[2][2] - J[1][2] * J[2][0])
                              + J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0])) / 8
    return total


def main(path):
    # The volume goes with the square of the scale of the sections.
    scale = math.sqrt(VOLUME / volume(nodes(1.0)))
    points = nodes(scale)
    quads, hexes = list(faces()), list(cells())
    with open(path, "w") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n")
        out.write('2 1 "proximal end"\n2 2 "distal end"\n2 3 "skin"\n3 4 "muscle"\n$EndPhysicalNames\n')
        out.write(f"$Nodes\n{len(points)}\n")
        for n, x in enumerate(points):
            out.write(f"{n + 1} {x[0]:.9g} {x[1]:.9g} {x[2]:.9g}\n")
        out.write(f"$EndNodes\n$Elements\n{len(quads) + len(hexes)}\n")
        for n, (group, face) in enumerate(quads):
            out.write(f"{n + 1} 3 2 {group} {group} " + " ".join(str(v + 1) for v in face) + "\n")
        for n, cell in enumerate(hexes):
            out.write(f"{len(quads) + n + 1} 5 2 4 1 " + " ".join(str(v + 1) for v in cell) + "\n")
        out.write("$EndElements\n")
    widest = max(2 * scale * math.sqrt(FLATNESS * area(i / N[0])) for i in range(N[0] + 1))
    print(f"{path}: {len(hexes)} hexahedra, {volume(points) * 1e6:.2f} cm^3, {widest * 100:.1f} cm wide, {widest / FLATNESS * 100:.1f} cm thick")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "gastrocnemius.msh")
