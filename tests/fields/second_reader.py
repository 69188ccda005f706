#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: programs of others read the fields that runs write, and find in them what they hold, on any number of ranks.

second_reader.py PROGRAM SCENES FOLDER

A block of second degree is run on 1, 2 and 3 ranks, with fields of the body and of its surface, as VTU and as HDF5. VTK reads the one, h5py the other.
Volume and area are those of the block, stretched cells included; units are attributes; and at each corner of a cell all files have the same fields.
Exit code 77 without the packages python3-vtk9 and python3-h5py.
"""
import os
import shutil
import subprocess
import sys

try:
    import h5py
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"skipped: {error} (packages python3-vtk9, python3-h5py)")
    sys.exit(77)

FIELDS = {"displacement": "m", "velocity": "m/s", "stretch": "", "pressure": "Pa", "fibre_direction": "", "stress_xx": "Pa"}
SIZE = (0.03, 0.01, 0.01)
SETTINGS = ["system/geometry/refinement=2", "system/discretisation/degree=2", "system/discretisation/quadrature points=3", "time/end=0.04", "time/step=0.02",
            "solver/nonlinear/relative tolerance=1e-11",
            "output/fields/what=" + ", ".join(name.replace("_", " ") for name in FIELDS)]

problems = []


def require(right, what):
    print(("ok      " if right else "WRONG   ") + what, flush=True)
    if not right:
        problems.append(what)


def read_vtk(folder, number):
    """Points, corners of cells (going round) and fields; units by the attributes of the file."""
    one = os.path.join(folder, f"fields-{number:04d}.vtu")
    reader = vtk.vtkXMLUnstructuredGridReader() if os.path.exists(one) else vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(one if os.path.exists(one) else os.path.join(folder, f"fields_{number:04d}.pvtu"))
    reader.Update()
    grid = reader.GetOutput()
    points, data = vtk_to_numpy(grid.GetPoints().GetData()).astype(float), grid.GetPointData()
    cells = []
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        n = 4 if cell.GetCellDimension() == 2 else 8  # corners come first
        cells.append([cell.GetPointId(v) for v in range(n)])
    fields = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).astype(float) for i in range(data.GetNumberOfArrays())}
    text = b"".join(open(os.path.join(folder, name), "rb").read() for name in os.listdir(folder) if name.endswith(".vtu"))
    units = {name: unit for name, unit in FIELDS.items() if unit and f'units="{unit}"'.encode() in text}
    return points, np.array(cells), fields, units


def read_hdf5(folder, number):
    with h5py.File(os.path.join(folder, "fields-mesh-0000.h5")) as mesh, h5py.File(os.path.join(folder, f"fields-{number:04d}.h5")) as file:
        fields = {name: file[name][...].astype(float) for name in file}
        units = {}
        for name in file:
            unit = file[name].attrs["unit"]
            units[name] = unit.decode() if isinstance(unit, bytes) else str(unit)
        return mesh["nodes"][...].astype(float), mesh["cells"][...].astype(int), fields, {k: u for k, u in units.items() if u}


def area_and_volume(points, cells):
    """Of quadrilaterals; or of hexahedra, by their faces, which cancel inside."""
    faces = cells if cells.shape[1] == 4 else np.concatenate(
        [cells[:, f] for f in ([0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])])
    a, b, c, d = (points[faces[:, v]] for v in range(4))
    area = np.linalg.norm(np.cross(c - a, d - b), axis=1).sum() / 2
    volume = (np.einsum("ij,ij->i", a, np.cross(b, c)) + np.einsum("ij,ij->i", a, np.cross(c, d))).sum() / 6
    return area, volume


def corners(points, cells, fields):
    """For each corner of a cell: the middle of the cell, the corner, and all fields; in an order of their own."""
    middle = points[cells].mean(axis=1)
    rows = []
    for v in range(cells.shape[1]):
        p = cells[:, v]
        rows.append(np.hstack([np.round(middle / 1e-6), np.round(points[p] / 1e-6)] + [fields[name][p].reshape(len(p), -1) for name in sorted(fields)]))
    rows = np.vstack(rows)
    return rows[np.lexsort(rows[:, :6].T)]


def run(program, scene, ranks, part, kind, folder):
    out = os.path.join(folder, f"{kind} {part} {ranks}")
    words = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    words += [program, "run", scene, "--quiet", "--out", out]
    for setting in SETTINGS + [f"output/fields/format={kind}", f"output/fields/surface only={'true' if part == 'surface' else 'false'}"]:
        words += ["--set", setting]
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(words, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}\n{done.stdout}\n{done.stderr}")
    return out


def main(program, scenes, folder):
    program, folder = os.path.abspath(program), os.path.abspath(folder)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    scene = os.path.join(os.path.abspath(scenes), "isometric_block.xml")
    a, b, c = SIZE
    area, volume = 2 * (a * b + b * c + c * a), a * b * c
    for part in ("body", "surface"):
        first, sizes = None, {}
        for kind in ("vtu", "hdf5"):
            for ranks in (1, 2, 3):
                name = f"{part}, {kind}, {ranks} rank{'s' if ranks > 1 else ''}"
                out = run(program, scene, ranks, part, kind, folder)
                sizes[kind] = sum(os.path.getsize(os.path.join(out, file)) for file in os.listdir(out) if file.startswith("fields"))
                points, cells, fields, units = (read_vtk if kind == "vtu" else read_hdf5)(out, 2)
                require(sorted(fields) == sorted(FIELDS), f"{name}: {len(fields)} fields")
                require(units == {k: u for k, u in FIELDS.items() if u}, f"{name}: units {units}")
                if kind == "hdf5":  # parts of cells: every second corner is a corner of one
                    cells = merged(points, cells)
                found = area_and_volume(points, cells)
                require(abs(found[1] - volume) < 1e-5 * volume, f"{name}: volume {found[1]:.9g} m^3 of {volume:.9g}")
                if part == "surface":
                    require(abs(found[0] - area) < 1e-5 * area, f"{name}: area {found[0]:.9g} m^2 of {area:.9g}")
                table = corners(points, cells, fields)
                first = table if first is None else first
                scale = np.abs(first).max(axis=0)
                apart = np.abs(table - first) / np.where(scale > 0, scale, 1) if table.shape == first.shape else np.array([np.inf])
                require(apart.max() < 2e-6, f"{name}: fields differ by {apart.max():.1e} of the greatest")
        print(f"        {part}: {sizes['vtu'] / 1e3:.0f} kB as VTU, {sizes['hdf5'] / 1e3:.0f} kB as HDF5")
    print(f"{len(problems)} problems")
    return 1 if problems else 0


def merged(points, cells):
    """Cells of second degree from the parts that they are cut into: parts come cell by cell, the first index fastest."""
    n = 4 if cells.shape[1] == 4 else 8
    parts = cells.reshape(-1, n, n)
    # the part at corner v of the cell, in the order of parts, and the corner of that part, which goes round
    order = [0, 1, 3, 2] if n == 4 else [0, 1, 3, 2, 4, 5, 7, 6]
    return np.stack([parts[:, order[v], v] for v in range(n)], axis=1)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
