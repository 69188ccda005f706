#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests do not run: uncovered.py SOURCE_FOLDER COVERAGE_BUILD_FOLDER [--first 10] [--room NAME ...]

Needs gcovr. The build is that of the preset `coverage`, in which tests have been run:

  cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage -LE architecture
  python3 tests/coverage/uncovered.py . build/coverage

Prints the lines that ran of each room, of the files of methods, conditions, series and profiles, then the functions with the most lines that did not.
Kernels are not counted: they are compiled without it. With --room, of these folders alone.
"""

import argparse
import json
import pathlib
import subprocess

FOLDERS = ("source", "integrators", "boundary", "outputs", "profiles", "include")


def counted(source, build):
    """The files that gcovr found, as its JSON has them."""
    filters = [word for folder in FOLDERS for word in ("--filter", f"{source}/{folder}/")]
    command = ["gcovr", "--root", source, "--object-directory", build, *filters, "--json", "--gcov-ignore-parse-errors", "--exclude-throw-branches",
               "-j", "1", build]
    return json.loads(subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True, cwd=build).stdout)["files"]


def room_of(file):
    parts = pathlib.PurePath(file).parts
    if parts[0] == "source":
        return parts[1]
    return parts[2] if parts[0] == "include" and len(parts) > 3 else parts[0]


def functions_of(file):
    """Name, and lines that did not run, of each function."""
    starts = sorted((function["lineno"], function["name"]) for function in file.get("functions", []))
    missed = {}
    for line in file["lines"]:
        if line["count"] == 0 and not line.get("gcovr/noncode"):
            before = [(at, name) for at, name in starts if at <= line["line_number"]]
            key = before[-1] if before else (line["line_number"], "?")
            missed.setdefault(key, []).append(line["line_number"])
    return [(name, lines) for (_, name), lines in missed.items()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=10, help="functions")
    parser.add_argument("--room", action="append")
    arguments = parser.parse_args()
    rooms, functions = {}, []
    for file in counted(arguments.source.resolve(), arguments.build.resolve()):
        room = room_of(file["file"])
        if arguments.room and room not in arguments.room:
            continue
        lines = [line for line in file["lines"] if not line.get("gcovr/noncode")]
        ran = sum(line["count"] > 0 for line in lines)
        total = rooms.setdefault(room, [0, 0])
        total[0] += ran
        total[1] += len(lines)
        functions += [(len(missed), file["file"], missed[0], name) for name, missed in functions_of(file)]
    print("| room | lines | ran | % |\n|---|---|---|---|")
    for room, (ran, lines) in [*sorted(rooms.items()), ("all", [sum(column) for column in zip(*rooms.values())])]:
        print(f"| {room} | {lines} | {ran} | {100 * ran / max(lines, 1):.1f} |")
    print("\n| lines that did not run | from | function |\n|---|---|---|")
    for n_missed, file, first, name in sorted(functions, reverse=True)[:arguments.first]:
        print(f"| {n_missed} | `{file}:{first}` | `{name}` |")


if __name__ == "__main__":
    main()
