#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes gastrocnemius.msh: a human medial gastrocnemius of 22 cm and 126.01 cm^3 in 1265 hexahedra, as in thesis 6.6.

Built, not scanned. Length, volume and number of cells are those of the thesis; the rest is a choice: flat rounded cross-sections three times as wide as
thick, whose area grows to a maximum at 0.45 of the length and falls to an eighth of it at the ends, on a centre line that bulges by 5 mm.
The line of action is x; physical surfaces "proximal end" (x = 0), "distal end" (x = 0.22 m) and "skin"; physical volume "muscle".

    make_mesh.py [FILE]
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bodies"))
from structured_mesh import StructuredMesh, rounded_section

LENGTH, VOLUME = 0.22, 126.01e-6  # m, m^3
N = (23, 11, 5)  # cells along x, y (width), z (thickness)
FLATNESS, BULGE = 3.0, 0.005
ENDS, PEAK = 0.125, 0.45


def area(s):
    """Relative area of the cross-section at s in [0, 1]."""
    warped = s ** (math.log(0.5) / math.log(PEAK))
    return ENDS + (1 - ENDS) * math.sin(math.pi * warped) ** 1.5


def mesh(scale):
    def position(i, j, k):
        s = i / N[0]
        y, z = rounded_section(2 * j / N[1] - 1, 2 * k / N[2] - 1)
        r = scale * math.sqrt(area(s))
        return LENGTH * s, r * math.sqrt(FLATNESS) * y, r / math.sqrt(FLATNESS) * z + BULGE * math.sin(math.pi * s)

    return StructuredMesh(N, position, lambda *_: "muscle", lambda axis, side, *_: "skin" if axis else ("distal end" if side else "proximal end"))


def main(path):
    # The volume goes with the square of the scale of the sections.
    scale = math.sqrt(VOLUME / mesh(1.0).volume("muscle"))
    body = mesh(scale)
    body.write(path)
    widest = max(2 * scale * math.sqrt(FLATNESS * area(i / N[0])) for i in range(N[0] + 1))
    print(f"{path}: {len(body.cells)} hexahedra, {body.volume('muscle') * 1e6:.2f} cm^3, {widest * 100:.1f} cm wide, {widest / FLATNESS * 100:.1f} cm thick")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "gastrocnemius.msh")
