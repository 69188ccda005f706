# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes that are a bent box of N[0] x N[1] x N[2] hexahedra, or six times as many tetrahedra, and their files: Gmsh (2.2, ASCII) and VTK (XML, ASCII)."""
import math

# Corners of a cell, and those of its faces by axis and side.
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
AROUND = [(0, 0), (1, 0), (1, 1), (0, 1)]
# Tetrahedra of a cell, all along its longest diagonal, so that those of neighbours fit.
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


ROUNDNESS = 0.75


def rounded_section(u, v):
    """The square [-1, 1]^2 with rounded corners."""
    return u * math.sqrt(1 - ROUNDNESS * v * v / 2), v * math.sqrt(1 - ROUNDNESS * u * u / 2)


class StructuredMesh:
    """position(i, j, k): place of a node [m]; tissue(i, j, k): name of the tissue of a cell; face(axis, side, i, j, k): name of the boundary face of a cell
    at the low (side 0) or high end of an axis."""

    def __init__(self, n, position, tissue, face):
        self.n = n
        self.points = [position(i, j, k) for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1)]
        self.cells, self.faces = [], []
        for k in range(n[2]):
            for j in range(n[1]):
                for i in range(n[0]):
                    at = (i, j, k)
                    self.cells.append((tissue(*at), [self.number(i + a, j + b, k + c) for a, b, c in CORNERS]))
                    for axis in range(3):
                        for side in (0, 1):
                            if at[axis] == (n[axis] - 1 if side else 0):
                                self.faces.append((face(axis, side, *at), self.corners_of_face(at, axis, side)))

    def number(self, i, j, k):
        return i + (self.n[0] + 1) * (j + (self.n[1] + 1) * k)

    def corners_of_face(self, at, axis, side):
        corners = []
        for pair in AROUND:
            node = list(at)
            node[axis] += side
            for other, shift in zip([d for d in range(3) if d != axis], pair):
                node[other] += shift
            corners.append(self.number(*node))
        return corners

    def volume(self, tissue):
        """Integral of the trilinear map's determinant over the cells of a tissue, exact with two Gauss points per direction."""
        g = [0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3)]
        return sum(self.jacobian(cell, (x, y, z)) / 8 for name, cell in self.cells if name == tissue for x in g for y in g for z in g)

    def jacobian(self, cell, at):
        J = [[0.0] * 3 for _ in range(3)]
        for node, corner in zip(cell, CORNERS):
            for d in range(3):
                slope = 1.0
                for e in range(3):
                    slope *= (1 if corner[e] else -1) if e == d else at[e] if corner[e] else 1 - at[e]
                for a in range(3):
                    J[a][d] += slope * self.points[node][a]
        return (J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) - J[0][1] * (J[1][0] * J[2][2] - J[1][2] * J[2][0])
                + J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0]))

    def write(self, path):
        groups = {(2, name): None for name, _ in self.faces} | {(3, name): None for name, _ in self.cells}
        for number, key in enumerate(groups, 1):
            groups[key] = number
        elements = [(3, groups[2, name], nodes) for name, nodes in self.faces] + [(5, groups[3, name], nodes) for name, nodes in self.cells]
        with open(path, "w") as out:
            out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(groups)}\n")
            for (dimension, name), number in groups.items():
                out.write(f'{dimension} {number} "{name}"\n')
            out.write(f"$EndPhysicalNames\n$Nodes\n{len(self.points)}\n")
            for n, x in enumerate(self.points, 1):
                out.write(f"{n} {x[0]:.9g} {x[1]:.9g} {x[2]:.9g}\n")
            out.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
            for n, (kind, group, nodes) in enumerate(elements, 1):
                out.write(f"{n} {kind} 2 {group} {group} " + " ".join(str(v + 1) for v in nodes) + "\n")
            out.write("$EndElements\n")

    def write_vtu(self, path, fibres=None, tetrahedra=False, digits=7, cell_fields=None):
        """fibres: a vector for each point, the array "fibre". cell_fields: arrays by name, a number for each hexahedron; faces have zeros there. Faces and
        cells have the array "group", whose names are told as well."""
        groups = {}
        for dimension, elements in ((2, self.faces), (3, self.cells)):
            for name, _ in elements:
                groups.setdefault((dimension, name), len(groups) + 1)
        elements = []  # type of VTK, group, points
        for dimension, named in ((3, self.cells), (2, self.faces)):
            for name, nodes in named:
                if name is None:
                    continue
                number = groups[dimension, name]
                if not tetrahedra:
                    elements.append((12 if dimension == 3 else 9, number, nodes))
                elif dimension == 3:
                    elements += [(10, number, [nodes[v] for v in part]) for part in TETRAHEDRA]
                else:
                    elements += [(5, number, [nodes[v] for v in part]) for part in ((0, 1, 2), (0, 2, 3))]
        names = [f"{dimension} {number} {name}" for (dimension, name), number in groups.items() if name is not None]
        ends = [0]
        for _, _, nodes in elements:
            ends.append(ends[-1] + len(nodes))

        def array(kind, name, rows, components=1):
            return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">\n' + "\n".join(rows) + "\n</DataArray>\n")

        def vectors(rows):
            return [" ".join(f"{x:.{digits}g}" for x in row) for row in rows]

        with open(path, "w") as out:
            out.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n<UnstructuredGrid>\n<FieldData>\n'
                      f'<Array type="String" Name="names of groups" NumberOfTuples="{len(names)}" format="ascii">\n')
            for name in names:
                out.write(" ".join(str(b) for b in name.encode()) + " 0\n")
            out.write(f'</Array>\n</FieldData>\n<Piece NumberOfPoints="{len(self.points)}" NumberOfCells="{len(elements)}">\n<PointData>\n')
            if fibres:
                out.write(array("Float64", "fibre", vectors(fibres), 3))
            out.write("</PointData>\n<CellData>\n" + array("Int32", "group", [str(group) for _, group, _ in elements]))
            for name, values in (cell_fields or {}).items():
                rows = [value for value in values for _ in range(6 if tetrahedra else 1)]
                rows += [0] * (len(elements) - len(rows))
                out.write(array("Float64", name, [f"{value:.{digits}g}" for value in rows]))
            out.write("</CellData>\n<Points>\n" + array("Float64", "Points", vectors(self.points), 3) + "</Points>\n<Cells>\n")
            out.write(array("Int32", "connectivity", [" ".join(map(str, nodes)) for _, _, nodes in elements]))
            out.write(array("Int32", "offsets", [str(end) for end in ends[1:]]) + array("UInt8", "types", [str(kind) for kind, _, _ in elements]))
            out.write("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")
