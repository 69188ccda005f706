#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes l_body.msh, an L of two legs of 6 cm whose section is a square of 2 cm, to the folder given (default: that of this script)."""
import pathlib
import sys

from structured_mesh import StructuredMesh

LENGTH, WIDTH, TISSUE = 0.06, 0.02, "rubber"
LEG, ACROSS, THICK = 4, 2, 2


def position(i, j, k):
    """Along one leg to the corner, where cells meet along its diagonal, and along the other."""
    from_edge = WIDTH * j / ACROSS
    along = LENGTH - (LENGTH - from_edge) * (i if i <= LEG else 2 * LEG - i) / LEG
    return (from_edge, along, WIDTH * k / THICK) if i <= LEG else (along, from_edge, WIDTH * k / THICK)


def face(axis, side, *_):
    return "skin" if axis else ("end of one leg", "end of the other leg")[side]


def main(folder):
    mesh = StructuredMesh((2 * LEG, ACROSS, THICK), position, lambda *_: TISSUE, face)
    mesh.write(folder / "l_body.msh")
    print(f"l_body.msh: {len(mesh.cells)} hexahedra, {mesh.volume(TISSUE) * 1e6:.3f} cm^3")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
