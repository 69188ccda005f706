#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes curved.vtu: a curved fusiform muscle as segmented images give it, of tetrahedra, in millimetres, with fibre vectors at its points."""
import math
import os

from structured_mesh import StructuredMesh, rounded_section

LENGTH, RADIUS = 80.0, 150.0  # of the line in its middle and of the circle that this is an arc of [mm]


def place(s, u, v):
    """Place [mm] of the part s of the length, and u, v in [-1, 1] across it."""
    belly = 0.35 + 0.65 * math.sin(math.pi * s)
    across, above = rounded_section(u, v)
    angle, out = (s - 0.5) * LENGTH / RADIUS, RADIUS + 9 * belly * above
    return out * math.sin(angle), 14 * belly * across, out * math.cos(angle) - RADIUS


def fibre(s, u, v, step=1e-6):
    """Unit vector along the lines of equal u and v."""
    low, high = max(s - step, 0), min(s + step, 1)
    vector = [b - a for a, b in zip(place(low, u, v), place(high, u, v))]
    length = math.sqrt(sum(x * x for x in vector))
    return [x / length for x in vector]


def curved(n, squeeze=0):
    """The mesh of n[0] x n[1] x n[2] hexahedra along and across it, and its fibres. Every other layer of cells is thinner by this part, its neighbour thicker."""

    def parameters(i, j, k):
        return (i + squeeze * (i % 2) * (i < n[0])) / n[0], 2 * j / n[1] - 1, 2 * k / n[2] - 1

    mesh = StructuredMesh(n, lambda i, j, k: place(*parameters(i, j, k)), lambda i, j, k: "muscle",
                          lambda axis, side, i, j, k: ("origin", "insertion")[side] if axis == 0 else None)
    return mesh, [fibre(*parameters(i, j, k)) for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1)]


if __name__ == "__main__":
    mesh, fibres = curved((5, 2, 2))
    mesh.write_vtu(os.path.join(os.path.dirname(os.path.abspath(__file__)), "curved.vtu"), fibres, tetrahedra=True)
