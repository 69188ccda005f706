#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes fusiform.msh and bipennate.msh, two idealised muscle-tendon units, to the folder given (default: that of this script).

fusiform   20 cm long; a belly of 14 cm that swells from 5 mm to 9 mm of radius between two tendons of 3 cm; faces "proximal end", "distal end", "skin".
bipennate  a sheet of aponeurosis, 6 cm by 1 cm by 1 mm, in the middle of two layers of muscle, each 8 mm thick and sheared against the sheet by 25 degrees, along
           which the fibres run; faces "origin" (both outer surfaces), "insertion" (distal end of the sheet), "proximal end", "skin".
"""
import math
import pathlib
import sys

from structured_mesh import StructuredMesh, rounded_section


def fusiform():
    length, tendon, thin, thick, n, n_tendon = 0.20, 0.03, 0.005, 0.009, (22, 4, 4), 4

    def along(i):
        belly = n[0] - 2 * n_tendon
        if i <= n_tendon:
            return tendon * i / n_tendon
        if i >= n[0] - n_tendon:
            return length - tendon * (n[0] - i) / n_tendon
        return tendon + (length - 2 * tendon) * (i - n_tendon) / belly

    def position(i, j, k):
        x = along(i)
        swollen = min(max((x - tendon) / (length - 2 * tendon), 0), 1)
        r = thin + (thick - thin) * math.sin(math.pi * swollen) ** 2
        y, z = rounded_section(2 * j / n[1] - 1, 2 * k / n[2] - 1)
        return x, r * y, r * z

    def tissue(i, _j, _k):
        return "tendon" if i < n_tendon or i >= n[0] - n_tendon else "muscle"

    def face(axis, side, *_):
        return "skin" if axis else ("distal end" if side else "proximal end")

    return StructuredMesh(n, position, tissue, face)


def bipennate(n=(12, 3, 9)):
    """Across: layers of muscle as many as below, one of the sheet, as many above."""
    length, width, sheet, layer, angle = 0.06, 0.01, 0.001, 0.008, math.radians(25)
    n_layer = n[2] // 2

    def height(k):
        middle = n[2] // 2
        if k <= middle:
            return -sheet / 2 - layer * (middle - k) / n_layer
        return sheet / 2 + layer * (k - middle - 1) / n_layer

    def position(i, j, k):
        z = height(k)
        return length * i / n[0] - max(abs(z) - sheet / 2, 0) / math.tan(angle), width * (j / n[1] - 0.5), z

    def tissue(_i, _j, k):
        return "aponeurosis" if k == n[2] // 2 else "muscle"

    def face(axis, side, _i, _j, k):
        if axis == 2:
            return "origin"
        if axis == 0 and side == 1 and k == n[2] // 2:
            return "insertion"
        return "proximal end" if axis == 0 and side == 0 else "skin"

    return StructuredMesh(n, position, tissue, face)


def main(folder):
    for name, mesh in (("fusiform", fusiform()), ("bipennate", bipennate())):
        mesh.write(folder / f"{name}.msh")
        volumes = ", ".join(f"{tissue} {mesh.volume(tissue) * 1e6:.3f} cm^3" for tissue in sorted({t for t, _ in mesh.cells}))
        print(f"{name}.msh: {len(mesh.cells)} hexahedra, {volumes}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
