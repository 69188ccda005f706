#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes fat_and_matrix.vtu: a muscle in which fat and extracellular matrix vary from cell to cell, as images that tell water from fat give them.

The muscle is 8 cm long, of hexahedra in millimetres. Two streaks of fat run through it, one on each side, and grow towards the insertion; matrix is dense
below the surface and at the ends. Prints the means over the volume.
"""
import math
import os

from structured_mesh import StructuredMesh, rounded_section

N, LENGTH = (10, 4, 4), 80.0  # cells along and across; [mm]


def place(s, u, v):
    """Place [mm] of the part s of the length, and u, v in [-1, 1] across it."""
    belly = 0.7 + 0.3 * math.sin(math.pi * s)
    across, above = rounded_section(u, v)
    return LENGTH * s, 14 * belly * across, 9 * belly * above


def fat(s, u, v):
    streaks = sum(size * math.exp(-((u - at_u) ** 2 + (v - at_v) ** 2) / 0.3) for size, at_u, at_v in ((0.6, 0.6, 0.4), (0.35, -0.6, -0.6)))
    return 0.02 + streaks * (0.3 + 0.7 * s)


def matrix(s, u, v):
    skin = max(abs(u), abs(v)) ** 4
    return 0.05 + 0.15 * skin + 0.15 * (2 * s - 1) ** 4


def body():
    """The mesh, and fractions of its cells by the names of their arrays."""

    def parameters(i, j, k):
        return i / N[0], 2 * j / N[1] - 1, 2 * k / N[2] - 1

    mesh = StructuredMesh(N, lambda i, j, k: place(*parameters(i, j, k)), lambda i, j, k: "muscle",
                          lambda axis, side, i, j, k: ("origin", "insertion")[side] if axis == 0 else None)
    middles = [parameters(i + 0.5, j + 0.5, k + 0.5) for k in range(N[2]) for j in range(N[1]) for i in range(N[0])]
    return mesh, {"fat_fraction": [fat(*at) for at in middles], "matrix_fraction": [matrix(*at) for at in middles]}


def volume(mesh, cell):
    g = [0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3)]
    return sum(mesh.jacobian(cell, (x, y, z)) / 8 for x in g for y in g for z in g)


if __name__ == "__main__":
    mesh, fractions = body()
    volumes = [volume(mesh, cell) for _, cell in mesh.cells]
    for name, values in fractions.items():
        mean = sum(v * x for v, x in zip(volumes, values)) / sum(volumes)
        print(f"{name}: {min(values):.3f} to {max(values):.3f}, mean {mean:.4f}")
    mesh.write_vtu(os.path.join(os.path.dirname(os.path.abspath(__file__)), "fat_and_matrix.vtu"), digits=5, cell_fields=fractions)
