#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damaged input must be refused or read, never crash: fuzz.py SERVER SOURCE_FOLDER SCRATCH_FOLDER [--count N] [--seed S] [--target NAME]...

Each target has seeds (files that are right) and a command that reads one. A seed is changed in one to four places: bytes flipped, pieces removed,
doubled, moved or cut off, words replaced by others that programs stumble over. The command must end with code 0 (read), 2 (refused with
words) or 3 (a solve failed); 1, 4, a signal, more than 20 s or 4 GB is a fault. The input of a fault is kept in SCRATCH_FOLDER/faults. The same seed makes the
same inputs.
"""

import argparse
import pathlib
import random
import re
import shutil
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from command_server import CommandServer  # noqa: E402

AWKWARD = [b"nan", b"inf", b"-inf", b"1e308", b"-1e308", b"1e-320", b"0", b"-1", b"1", b"4294967296", b"-9223372036854775809", b"99999999999999999999",
           b"", b" ", b"\t", b"\n", b"\r\n", b"\0", b"\xef\xbb\xbf", b"\xff\xfe", b"\xc3\x28", b"%s%n", b"../../..", b"/dev/zero", b"$(true)", b"'", b'"', b"<", b">",
           b"&amp;", b"&#0;", b"]]>", b"<!--", b",", b";", b"|", b"{}", b"1,5", b"1.5.2", b"0x10", b"1e", b"--", b"x" * 300]


def separated(data, generator):
    """Begin and end of a word, line or number of the text."""
    marks = [i for i, byte in enumerate(data[:20000]) if byte in b" \t\n,;\"<>=/"]
    if len(marks) < 2:
        return 0, len(data)
    i = generator.randrange(len(marks) - 1)
    return marks[i] + 1, marks[i + 1]


def piece(data, generator, longest=200):
    begin = generator.randrange(len(data) + 1)
    return begin, min(len(data), begin + generator.randint(1, longest))


def mutated(data, others, generator):
    for _ in range(generator.choice([1, 1, 1, 2, 2, 3, 4])):
        kind = generator.randrange(16)
        if kind == 0 and data:
            at = generator.randrange(len(data))
            data = data[:at] + bytes([data[at] ^ 1 << generator.randrange(8)]) + data[at + 1:]
        elif kind == 1 and data:
            at = generator.randrange(len(data))
            data = data[:at] + bytes([generator.randrange(256)]) + data[at + 1:]
        elif kind == 2:
            begin, end = piece(data, generator)
            data = data[:begin] + data[end:]
        elif kind == 3:
            begin, end = piece(data, generator)
            data = data[:end] + data[begin:end] + data[end:]
        elif kind == 4:
            data = data[:generator.randrange(len(data) + 1)]
        elif kind == 5:
            lines = data.split(b"\n")
            i, j = generator.randrange(len(lines)), generator.randrange(len(lines))
            lines[i], lines[j] = lines[j], lines[i]
            data = b"\n".join(lines)
        elif kind == 6:
            lines = data.split(b"\n")
            i = generator.randrange(len(lines))
            lines[i:i + 1] = generator.choice([[], [lines[i]] * 2, [lines[i]] * 50])
            data = b"\n".join(lines)
        elif kind == 7:
            other = generator.choice(others)
            begin, end = piece(other, generator)
            at = generator.randrange(len(data) + 1)
            data = data[:at] + other[begin:end] + data[at:]
        elif kind == 8:
            other = generator.choice(others)
            data = data[:generator.randrange(len(data) + 1)] + other[generator.randrange(len(other) + 1):]
        elif kind <= 13:
            numbers = list(re.finditer(rb"-?\d+(\.\d+)?(e-?\d+)?", data[:50000]))
            if numbers:
                number = generator.choice(numbers)
                value = float(number.group()) if len(number.group()) < 300 else 1.
                other = generator.choice([value + 1, value - 1, -value, 10 * value, value / 10, 1e9 * value, 0, value * value, 1e-9])
                written = repr(other) if b"." in number.group() or abs(other) >= 1e18 else str(int(other))
                data = data[:number.start()] + written.encode() + data[number.end():]
        else:
            begin, end = separated(data, generator)
            data = data[:begin] + generator.choice(AWKWARD) + data[end:]
    return data


def meaning(code):
    if code >= 2000:
        return f"the process ended itself with code {code - 2000}"
    if code >= 1000:
        return "more than 20 s" if code == 1014 else f"signal {code - 1000}"
    return f"exit code {code}"


class Target:
    """Files of a folder, one of which is damaged, and the command that reads it."""

    def __init__(self, name, seeds, command, prepare=None):
        self.name, self.seeds, self.command, self.prepare = name, seeds, command, prepare


def scene_of_a_drive(file):
    return f"""<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="oscillator"/>
    <ParameterList name="force">
      <Parameter name="type" type="string" value="file"/>
      <Parameter name="file" type="string" value="{file}"/>
      <Parameter name="column" type="string" value="emg"/>
      <Parameter name="rectify" type="bool" value="true"/>
      <Parameter name="low-pass" type="double" value="6"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="sdirk2"/></ParameterList>
  <ParameterList name="time"><Parameter name="end" type="double" value="0.4"/><Parameter name="step" type="double" value="0.1"/></ParameterList>
</ParameterList>
"""


def tables():
    rows = [(0.01 * i, ((7 * i) % 11 - 5) / 10) for i in range(60)]
    comma = "time [s],emg,other [N]\n" + "".join(f"{t:.2f},{x:.3f},1\n" for t, x in rows)
    semicolon = "time [s];emg\n" + "".join(f"{t:.2f};{x:.3f}\n".replace(".", ",") for t, x in rows)
    opensim = ("trial\nversion=1\nnRows=60\nnColumns=2\ninDegrees=no\nendheader\ntime\temg\n" + "".join(f"{t:.2f}\t{x:.3f}\n" for t, x in rows))
    return [("comma.csv", comma), ("semicolon.csv", semicolon), ("trial.sto", opensim), ("trial.mot", opensim)]


CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def meshes():
    """Two cubes in a row of 1 cm, in the formats that are read."""
    points = [(0.01 * (x + k), 0.01 * y, 0.01 * z) for k in (0, 1) for x, y, z in CUBE]
    merged = sorted(set((round(x, 9), y, z) for x, y, z in points))
    number = {p: i for i, p in enumerate(merged)}
    cells = [[number[(round(x, 9), y, z)] for x, y, z in points[8 * k:8 * k + 8]] for k in (0, 1)]
    ends = [[cells[0][i] for i in (0, 3, 7, 4)], [cells[1][i] for i in (1, 2, 6, 5)]]
    gmsh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"left\"\n2 2 \"right\"\n3 3 \"body\"\n$EndPhysicalNames\n"
    gmsh2 += f"$Nodes\n{len(merged)}\n" + "".join(f"{i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(merged)) + "$EndNodes\n$Elements\n4\n"
    gmsh2 += "".join(f"{i + 1} 3 2 {i + 1} {i + 1} " + " ".join(str(n + 1) for n in face) + "\n" for i, face in enumerate(ends))
    gmsh2 += "".join(f"{i + 3} 5 2 3 3 " + " ".join(str(n + 1) for n in cell) + "\n" for i, cell in enumerate(cells)) + "$EndElements\n"
    abaqus = "*HEADING\ntwo cubes\n*NODE\n" + "".join(f"{i + 1}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(merged))
    abaqus += "*ELEMENT, TYPE=C3D8, ELSET=body\n" + "".join(f"{i + 1}, " + ", ".join(str(n + 1) for n in cell) + "\n" for i, cell in enumerate(cells))
    abaqus += "*NSET, NSET=left\n" + ", ".join(str(n + 1) for n in ends[0]) + "\n*SURFACE, NAME=right, TYPE=ELEMENT\n2, S4\n"
    legacy = "# vtk DataFile Version 3.0\ntwo cubes\nASCII\nDATASET UNSTRUCTURED_GRID\n" + f"POINTS {len(merged)} double\n"
    legacy += "".join(f"{x} {y} {z}\n" for x, y, z in merged) + "CELLS 2 18\n" + "".join("8 " + " ".join(map(str, cell)) + "\n" for cell in cells)
    legacy += "CELL_TYPES 2\n12\n12\nCELL_DATA 2\nSCALARS tissue int 1\nLOOKUP_TABLE default\n1 1\n"
    return [("cubes.msh", gmsh2), ("cubes.inp", abaqus), ("cubes.vtk", legacy)]


def scene_of_a_mesh(file):
    return f"""<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="muscle 3d"/>
    <ParameterList name="geometry">
      <Parameter name="type" type="string" value="mesh"/>
      <Parameter name="file" type="string" value="{file}"/>
    </ParameterList>
    <ParameterList name="fibres"><Parameter name="type" type="string" value="formula"/><Parameter name="x" type="string" value="1"/></ParameterList>
    <ParameterList name="boundary"/>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="sdirk2"/></ParameterList>
  <ParameterList name="time"><Parameter name="end" type="double" value="0.01"/><Parameter name="step" type="double" value="0.01"/></ParameterList>
</ParameterList>
"""


def targets(source, scratch, server):
    """All of them; files that other commands make are made here."""
    made = scratch / "made"
    made.mkdir(parents=True)

    def must(folder, *words):
        if server.ask(folder, *words) != 0:
            sys.exit(f"the fuzzer cannot make its seeds: {words}: {(folder / 'err.txt').read_text(errors='replace')}")

    scenes = [source / "input" / name for name in ("oscillator.xml", "rod_linear.xml", "one_dimensional/muscle_tendon_unit.xml",
                                                   "one_dimensional/isometric_chain.xml", "isometric_block.xml")]
    small = [scene.read_bytes().replace(b'name="refinement" type="int" value="2"', b'name="refinement" type="int" value="0"') for scene in scenes]
    yield Target("scenes", [("scene.xml", text) for text in small], lambda name: ["check", name])

    studies = sorted((source / "input" / "studies").glob("*.xml"))
    to_inputs = str(source / "input").encode()
    yield Target("studies", [("study.xml", file.read_bytes().replace(b'value="../', b'value="' + to_inputs + b"/")) for file in studies],
                 lambda name: ["study", name, "--list"])

    def with_drive(folder, name):
        (folder / "scene.xml").write_text(scene_of_a_drive(name))

    yield Target("tables", [(name, text.encode()) for name, text in tables()], lambda name: ["check", "scene.xml"], with_drive)

    flexodeal = source / "tests" / "data" / "flexodeal"

    def with_flexodeal(folder, name):
        for file in flexodeal.iterdir():
            if file.name != name:
                shutil.copy(file, folder)

    yield Target("flexodeal", [(file.name, file.read_bytes()) for file in sorted(flexodeal.iterdir())],
                 lambda name: ["import", "flexodeal", "parameters.prm", "strain.dat", "activation.dat", "--markers", "markers.dat", "--out", "new.xml"],
                 with_flexodeal)

    kinds = [(name, text.encode()) for name, text in meshes()]
    for name, text in meshes()[:1]:
        (made / name).write_text(text)
        (made / "scene.xml").write_text(scene_of_a_mesh(name))
    for name in ("written.vtu", "written.msh"):
        must(made, "mesh", "scene.xml", "--out", name)
        kinds.append((name, (made / name).read_bytes()))

    def with_mesh(folder, name):
        (folder / "scene.xml").write_text(scene_of_a_mesh(name))

    yield Target("meshes", kinds, lambda name: ["check", "scene.xml"], with_mesh)

    oscillator = source / "input" / "oscillator.xml"
    run = ["run", oscillator, "--out", "run", "--quiet", "--set", "time/control/type=fixed", "--set", "time/step=0.05"]
    must(made, *run, "--set", "time/end=0.2")
    files = [file for file in sorted((made / "run").rglob("*")) if file.is_file() and "lock" not in file.name]

    def with_run(folder, _):
        shutil.rmtree(folder / "run", ignore_errors=True)
        shutil.copytree(made / "run", folder / "run")

    yield Target("runs", [(str(file.relative_to(made)), file.read_bytes()) for file in files],
                 lambda name: [*run, "--set", "time/end=0.25", "--resume"], with_run)

    shutil.copy(oscillator, made)
    study = """<ParameterList name="study"><Parameter name="scene" type="string" value="oscillator.xml"/><ParameterList name="grids">
      <ParameterList name="all"><ParameterList name="step"><Parameter name="type" type="string" value="list"/>
      <Parameter name="parameter" type="string" value="time/step"/><Parameter name="values" type="string" value="0.1 | 0.05"/>
      </ParameterList></ParameterList></ParameterList></ParameterList>"""
    (made / "study.xml").write_text(study)
    must(made, "study", "study.xml", "--out", "study", "--quiet", "--set", "budget/total=60")

    def with_study(folder, _):
        shutil.rmtree(folder / "study", ignore_errors=True)
        shutil.copytree(made / "study", folder / "study")
        for file in ("study.xml", "oscillator.xml"):
            shutil.copy(made / file, folder)

    yield Target("databases", [("study/study.sqlite", (made / "study" / "study.sqlite").read_bytes())],
                 lambda name: ["study", "study.xml", "--out", "study", "--quiet"], with_study)


def fuzz(target, count, seed, scratch, server):
    """(refused, read, failed solves, faults)."""
    generator = random.Random(f"{target.name} {seed}")
    folder = scratch / "work"
    others = [data for _, data in target.seeds]
    ends = {2: 0, 0: 0, 3: 0}
    faults = []

    def run(name, data):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        if target.prepare:
            target.prepare(folder, name)
        (folder / name).write_bytes(data)
        return server.ask(folder, *target.command(name))

    for name, data in target.seeds:
        if run(name, data) != 0:
            sys.exit(f"{target.name}: the seed {name} is not right: {(folder / 'err.txt').read_text(errors='replace')}")
    for i in range(count):
        name, data = target.seeds[i % len(target.seeds)]
        code = run(name, mutated(data, others, generator))
        if code in ends:
            ends[code] += 1
            continue
        kept = scratch / "faults" / f"{target.name}-{seed}-{i}"
        shutil.copytree(folder, kept)
        faults.append(kept)
        words = " ".join(str(word) for word in target.command(name))
        print(f"FAULT {target.name}: {meaning(code)}; cd {kept} && myolines {words}", flush=True)
        if (folder / "err.txt").exists():
            print((folder / "err.txt").read_text(errors="replace")[:400])
    return ends[2], ends[0], ends[3], faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("server")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=500, help="inputs per target")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--target", action="append", help="only this one; may be repeated")
    arguments = parser.parse_args()
    scratch = arguments.scratch.resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    server = CommandServer(arguments.server)
    n_faults = n_inputs = 0
    for target in targets(arguments.source.resolve(), scratch, server):
        if arguments.target and target.name not in arguments.target:
            continue
        begin = time.time()
        refused, read, failed, faults = fuzz(target, arguments.count, arguments.seed, scratch, server)
        print(f"{target.name}: {arguments.count} inputs, {refused} refused, {read} read, {failed} failed solves, {len(faults)} faults, "
              f"{time.time() - begin:.0f} s", flush=True)
        n_faults += len(faults)
        n_inputs += arguments.count
    server.close()
    print(f"{n_inputs} inputs, {n_faults} faults")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())
