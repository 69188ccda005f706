#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fuzzing led by coverage, with libFuzzer: guided.py FUZZ_PROGRAM SOURCE_FOLDER GUIDED_BUILD_FOLDER SCRATCH_FOLDER [--seconds N] [--reader NAME]...

FUZZ_PROGRAM is that of any build, which makes seeds as fuzz.py does; the files of input/ are seeds as well. The program is built with
clang and sanitizers:

  cmake --preset guided && cmake --build --preset guided
  python3 tests/fuzz/guided.py build/release/tests/fuzz_program . build/guided build/guided/found

Each reader gets its seeds and then what libFuzzer makes of them, for so many seconds. What a fault was found with is kept in SCRATCH_FOLDER/faults;
what reaches new lines is kept in SCRATCH_FOLDER/NAME and taken up again by the next call. The exit code is 1 where there is a fault.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import fuzz  # noqa: E402
from command_server import CommandServer  # noqa: E402

LONGEST = 20000  # [bytes] of an input

# Reader: the target of fuzz.py whose seeds it takes, which of these, and which files of the repository.
READERS = {
    "scene": ("scenes", ".*", ["input/**/*.xml"]),
    "table": ("tables", ".*", ["input/**/*.csv", "tests/data/*.csv"]),
    "mesh": ("meshes", ".*", ["input/**/*.msh", "input/**/*.vtu"]),
    "fields": ("meshes", r".*\.vtu", ["input/**/*.vtu"]),
    "prm": ("flexodeal", ".*", []),
    "checkpoint": ("runs", ".*/checkpoint", []),
    "manifest": ("runs", ".*/manifest.json", []),
    "formula": (None, "", []),
}

# Words that stand for themselves; libFuzzer puts them into inputs.
WORDS = {
    "scene": ["<ParameterList name=\"", "<Parameter name=\"", "</ParameterList>", "/>", "<!--", "-->", "&lt;", "&#65;", "<?xml", "<![CDATA[", "]]>",
              "name=\"scene\"", "number", "integer", "boolean", "text", "list", "optional", "named", "type", "first", "second", "formula", "value=\""],
    "table": ["endheader", "nRows=", "nColumns=", "inDegrees=yes", "sep=;", "time [ms]", "\"\"", "\r\n", "\t", "%", "#"],
    "mesh": ["$MeshFormat", "4.1 1 8", "$Entities", "$Nodes", "$Elements", "$PhysicalNames", "$Periodic", "$Comments", "*NODE", "*ELEMENT", "TYPE=C3D",
             "*NSET", "*ELSET", "*SURFACE", "GENERATE", "*INCLUDE", "*PART", "*INSTANCE", "*END", "BINARY", "DATASET", "CELL_TYPES", "SCALARS", "FIELD",
             "POINT_DATA", "OFFSETS vtktypeint64", "CONNECTIVITY", "<DataArray", "format=\"binary\"", "format=\"appended\"", "encoding=\"base64\"",
             "encoding=\"raw\"", "header_type=\"UInt64\"", "compressor=\"vtkZLibDataCompressor\"", "BigEndian", "<AppendedData", "NumberOfComponents=\"3\""],
    "prm": ["subsection", "set", "end", "include", "\\\n", "="],
    "formula": ["sin(", "if(", "pow(", "atan2(", "?", ":", "&&", "||", "<=", "rint(", "erfc(", "rand(", "pi", "^"],
}
WORDS["fields"] = WORDS["mesh"]
FORMULAS = ["sin(2*pi*t)", "x < 0.1 ? 1 : 2", "exp(-x^2)*sqrt(y)", "rint(z) + pow(x,2) && t >= 1"]

# The schema of guided.cc, filled in.
SCENE = """<ParameterList name="scene">
  <Parameter name="number" type="double" value="0.5"/>
  <Parameter name="text" type="string" value="some &amp; text"/>
  <ParameterList name="list"><Parameter name="word" type="string" value="b"/></ParameterList>
  <ParameterList name="optional"><Parameter name="x" type="double" value="2"/></ParameterList>
  <ParameterList name="named"><ParameterList name="one"><Parameter name="formula" type="string" value="x"/></ParameterList></ParameterList>
  <Parameter name="type" type="string" value="second"/>
  <Parameter name="y" type="double" value="1e3"/>
</ParameterList>
"""

# One step of a block whose fields are written with curved cells, compressed.
BLOCK = ["--set", "system/geometry/refinement=0", "--set", "time/end=0.01", "--set", "time/step=0.01", "--set", "output/fields/every=1"]


def write_seeds(readers, source, build, scratch, fuzz_program):
    for reader in readers:
        (scratch / reader).mkdir(parents=True, exist_ok=True)

    def keep(reader, name, data):
        if reader in readers and len(data) <= LONGEST:
            (scratch / reader / f"seed-{name}").write_bytes(data)

    server = CommandServer(fuzz_program)
    origins = {READERS[reader][0] for reader in readers} - {None}
    for target in fuzz.targets(source, scratch / "made_by", server):
        for reader in readers:
            origin, pattern, _ = READERS[reader]
            for i, (name, data) in enumerate(target.seeds):
                if target.name == origin and re.fullmatch(pattern, name):
                    keep(reader, f"{origin}-{i}", data)
        origins.discard(target.name)
        if not origins:
            break
    shutil.rmtree(scratch / "block", ignore_errors=True)
    if server.ask(scratch, "run", source / "input" / "isometric_block.xml", "--out", "block", "--quiet", *BLOCK) != 0:
        sys.exit((scratch / "err.txt").read_text(errors="replace"))
    server.close()
    for file in (scratch / "block").glob("*.vtu"):
        keep("fields", file.name, file.read_bytes())
        keep("mesh", file.name, file.read_bytes())
    for name in ("checkpoint", "manifest.json"):
        if (scratch / "block" / name).exists():
            keep(name.split(".", maxsplit=1)[0], "block", (scratch / "block" / name).read_bytes())
    for reader in readers:
        for pattern in READERS[reader][2]:
            for file in source.glob(pattern):
                keep(reader, file.name, file.read_bytes())
    if "mesh" in readers:
        (scratch / "gmsh").mkdir(exist_ok=True)
        subprocess.run([build / "tests" / "guided_seeds", scratch / "gmsh"], check=True)
        for file in (scratch / "gmsh").iterdir():
            keep("mesh", file.name, file.read_bytes())
    keep("scene", "all-kinds", SCENE.encode())
    for i, text in enumerate(FORMULAS):
        keep("formula", str(i), text.encode())


def write_words(reader, file):
    def escaped(word):
        return "".join(c if c.isprintable() and c not in '"\\' else f"\\x{ord(c):02x}" for c in word)

    file.write_text("".join(f'"{escaped(word)}"\n' for word in WORDS.get(reader, [])))


def run(program, reader, scratch, seconds):
    """(inputs, edges reached, faults)."""
    faults = scratch / "faults"
    faults.mkdir(exist_ok=True)
    before = set(faults.iterdir())
    words = scratch / f"{reader}.dict"
    write_words(reader, words)
    leaks = "detect_leaks=0:" + os.environ.get("ASAN_OPTIONS", "")  # MPI keeps memory until a process ends
    command = [program, scratch / reader, f"-max_total_time={seconds}", "-timeout=10", "-rss_limit_mb=2048", f"-artifact_prefix={faults}/{reader}-",
               f"-max_len={200 if reader == 'formula' else LONGEST}", "-seed=1", "-print_final_stats=1", "-detect_leaks=0"]
    if reader in WORDS:
        command.append(f"-dict={words}")
    log = scratch / f"{reader}.log"
    with log.open("w") as stream:
        ended = subprocess.run([str(word) for word in command], stdout=stream, stderr=subprocess.STDOUT, check=False,
                               env={**os.environ, "MYOLINES_READER": reader, "ASAN_OPTIONS": leaks})
    text = log.read_text(errors="replace")
    covered = re.findall(r"cov: (\d+)", text)
    executed = re.findall(r"number_of_executed_units:\s*(\d+)", text)
    found = sorted(set(faults.iterdir()) - before)
    if not covered or (ended.returncode != 0 and not found):
        sys.exit(f"{reader} does not run, see {log}")
    return int(executed[-1]) if executed else 0, int(covered[-1]), found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fuzz_program")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=180, help="for each reader")
    parser.add_argument("--reader", action="append", choices=list(READERS), help="only this one; may be repeated")
    arguments = parser.parse_args()
    scratch, build = arguments.scratch.resolve(), arguments.build.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    readers = arguments.reader or list(READERS)
    write_seeds(readers, arguments.source.resolve(), build, scratch, arguments.fuzz_program)
    n_faults = 0
    for reader in readers:
        inputs, covered, faults = run(build / "tests" / "guided", reader, scratch, arguments.seconds)
        n_faults += len(faults)
        print(f"{reader}: {inputs} inputs, {covered} edges reached, {len(faults)} faults", flush=True)
        for fault in faults:
            print(f"  {fault}")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())
