#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests do not run: uncovered.py SOURCE_FOLDER COVERAGE_BUILD_FOLDER [--first 10] [--room NAME ...]

The build is that of the preset `coverage`, in which tests have been run:

  cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage -LE architecture
  python3 tests/coverage/uncovered.py . build/coverage

Prints the lines that ran of each room, of the files of methods, conditions, series and profiles, then the functions with the most lines that did not.
Kernels are not counted: they are compiled without it. With --room, of these folders alone.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys

FOLDERS = ("source", "integrators", "boundary", "outputs", "profiles", "include")


class File:
    """How often each line of a file ran, and the names of the functions that have it."""

    def __init__(self):
        self.runs = collections.Counter()
        self.function = {}


def counted(source, build):
    """What gcov counted of our files, by their names from the root. An object that nothing ran has no counts; its lines count as not run."""
    files = collections.defaultdict(File)
    objects = sorted(build.rglob("*.gcno"))
    for first in range(0, len(objects), 16):
        command = ["gcov", "--json-format", "--stdout", "--demangled-names", *map(str, objects[first:first + 16])]
        answer = subprocess.run(command, capture_output=True, text=True, check=False, cwd=build)
        if answer.returncode != 0:
            sys.exit("counts do not belong to the objects; remove these .gcda and run the tests again:\n" + answer.stderr)
        for line in answer.stdout.splitlines():
            for entry in json.loads(line)["files"] if line.startswith("{") else []:
                add(files, entry, source, build)
    return files


def add(files, entry, source, build):
    """Counts of one file from one object. Names begin at the root, as the compiler maps it, or at the folder of the build."""
    name = pathlib.PurePath(entry["file"])
    if name.parts[:1] == ("..",):
        path = (build / name).resolve()
        if not path.is_relative_to(source):
            return
        name = path.relative_to(source)
    if name.parts[0] not in FOLDERS:
        return
    names = {function["name"]: function["demangled_name"] for function in entry["functions"]}
    file = files[str(name)]
    for line in entry["lines"]:
        number = line["line_number"]
        file.runs[number] += line["count"]
        file.function.setdefault(number, names.get(line.get("function_name"), "?"))


def room_of(file):
    parts = pathlib.PurePath(file).parts
    if parts[0] == "source":
        return parts[1] if len(parts) > 2 else parts[0]
    return parts[2] if parts[0] == "include" and len(parts) > 3 else parts[0]


def functions_of(file):
    """Name, and lines that did not run, of each function."""
    missed = {}
    for number, runs in sorted(file.runs.items()):
        if runs == 0:
            missed.setdefault(file.function[number], []).append(number)
    return list(missed.items())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=10, help="functions")
    parser.add_argument("--room", action="append")
    arguments = parser.parse_args()
    rooms, functions = {}, []
    for name, file in counted(arguments.source.resolve(), arguments.build.resolve()).items():
        room = room_of(name)
        if arguments.room and room not in arguments.room:
            continue
        total = rooms.setdefault(room, [0, 0])
        total[0] += sum(runs > 0 for runs in file.runs.values())
        total[1] += len(file.runs)
        functions += [(len(missed), name, missed[0], function) for function, missed in functions_of(file)]
    print("| room | lines | ran | % |\n|---|---|---|---|")
    for room, (ran, lines) in [*sorted(rooms.items()), ("all", [sum(column) for column in zip(*rooms.values())])]:
        print(f"| {room} | {lines} | {ran} | {100 * ran / max(lines, 1):.1f} |")
    print("\n| lines that did not run | from | function |\n|---|---|---|")
    for n_missed, file, first, function in sorted(functions, reverse=True)[:arguments.first]:
        print(f"| {n_missed} | `{file}:{first}` | `{function}` |")


if __name__ == "__main__":
    main()
