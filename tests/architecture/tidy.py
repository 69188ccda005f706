#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks through the sources with the checks of .clang-tidy.

tidy.py ROOT SCRATCH [ROOM ...]            all rooms, or those named; findings as clang-tidy prints them; exit code 1 if there is any
tidy.py --self-test ROOT SCRATCH           plants mistakes of some kinds in a file of its own, expects each to be found

Needs clang-tidy 14 and clang 14, as .clang-format does; exit code 77 where they are not installed. All sources of a room are read at once, as a unity build
reads them, behind one precompiled header: headers of deal.II are read once and not 200 times.
"""

import collections
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

TIDY, CLANG = "clang-tidy-14", "clang++-14"
# Files of methods use the same names for the same things.
ALONE = ("integrators/",)
# The same code again for another instruction set.
AGAIN = ("_avx2.cc", "_avx512.cc")
OURS = ("source/", "integrators/", "boundary/", "outputs/", "profiles/", "python/")
# Options of GCC that clang does not know, and those that name files of its build.
DROPPED = re.compile(r"-fpch-preprocess|-W.*|-f(un|no-un)roll.*|-ffile-prefix-map=.*|-fno-(math-errno|trapping-math)|-g\d?|-o|-c|-O\d?")

# GCC takes __builtin_sqrt as a function and knows more names of processors' features, clang does not; kernels are compiled by GCC.
OF_GCC = ("builtin functions must be directly called", "invalid cpu feature string for builtin")


def commands(root, scratch):
    """What CMake says of each file: the options that clang understands."""
    build = os.path.join(scratch, "configured")
    subprocess.run(["cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DBUILD_TESTING=OFF",
                    "-DCMAKE_UNITY_BUILD=OFF", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON"], check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    for entry in entries:
        path = os.path.relpath(entry["file"], root)
        if not path.startswith(OURS) or path.endswith(AGAIN):
            continue
        words = shlex.split(entry["command"])
        start = next(i for i, word in enumerate(words) if word.startswith("-"))
        options = [word for word in words[start:] if not DROPPED.fullmatch(word) and not word.endswith((".cc", ".o"))]
        yield path, options


def units(root, scratch):
    """(name, files, options) of what clang reads at once."""
    groups = collections.defaultdict(list)
    for path, options in commands(root, scratch):
        room = path if path.startswith(ALONE) else os.path.dirname(path)
        groups[(room, tuple(options))].append(path)
    for (room, options), files in sorted(groups.items()):
        yield room, files, list(options)


def is_of(name, room):
    """Whether a unit is one of a room: `kernels` is source/kernels, `python` python/source, `integrators` also integrators/bdf2.cc."""
    return name == room or name == "source/" + room or name.startswith(room + "/")


class Reading:
    """Units behind one precompiled header, or more where they have other options that count for it."""

    def __init__(self, root, scratch, checks):
        self.root, self.scratch, self.checks = root, scratch, checks
        self.headers = {}

    def header(self, options):
        """What comes before a unit of these options; kernels see nothing of deal.II."""
        if "-DOMPI_SKIP_MPICXX" not in options:
            return []
        standing = tuple(option for option in options if not option.startswith(("-DMYOLINES", "-I")))
        if standing not in self.headers:
            file = os.path.join(self.scratch, f"header_{len(self.headers)}.pch")
            subprocess.run([CLANG, "-x", "c++-header", os.path.join(self.root, "include/myolines/pch.h"), "-o", file, *standing], check=True)
            self.headers[standing] = file
        return ["-include-pch", self.headers[standing]]

    def findings(self, name, files, options):
        """What clang-tidy prints of them; "" for nothing."""
        unit = os.path.join(self.scratch, name.replace("/", "_") + ".cc")
        with open(unit, "w", encoding="utf-8") as file:
            file.writelines(f'#include "{os.path.join(self.root, path)}"\n' for path in files)
        done = subprocess.run([TIDY, unit, "--quiet", "--config-file=" + self.checks,
                               "--header-filter=^" + re.escape(self.root) + "/", "--", *options, *self.header(options)],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        return done.stdout if done.returncode == 0 or done.stdout else done.stderr


def look(root, scratch, *rooms):
    """Prints what is found in these rooms, or in all; a room that does not exist is an error, or it would pass as clean."""
    reading = Reading(root, scratch, os.path.join(root, ".clang-tidy"))
    everything = list(units(root, scratch))
    chosen = {room: [unit for unit in everything if is_of(unit[0], room)] for room in rooms}
    unknown = [room for room, its_units in chosen.items() if not its_units]
    if unknown:
        print("no such room: " + ", ".join(unknown), file=sys.stderr)
        return 2
    found = set()
    for name, files, options in [unit for its_units in chosen.values() for unit in its_units] if rooms else everything:
        print(f"{name}: {len(files)} files", file=sys.stderr, flush=True)
        text = reading.findings(name, files, options)
        for finding in re.split(r"^(?=/)", text, flags=re.M):
            if any(message in finding for message in OF_GCC):
                continue
            if re.match(r"/\S+:\d+:\d+: (warning|error)", finding) and finding not in found:  # in a header it is found again in every room
                found.add(finding)
                print(finding.replace(root + "/", ""), end="", flush=True)
            elif finding and not re.match(r"/", finding):
                found.add(finding)
                print(finding, end="", flush=True)
    return 1 if found else 0


PLANTED = """
#include <map>
#include <string>
#include <utility>
struct Base { virtual ~Base() = default; virtual double value() const = 0; };
struct Derived : Base { virtual double value() const; double half(int n) const { return n / 2; } };
double Derived::value() const { std::string text("a"); std::string other = std::move(text); return text.size() == other.size() ? 0 : half(3); }
bool none(const std::string &text) { return text.size() == 0; }
int sum(const std::map<int, std::string> &all) { int n = 0; for (const auto pair : all) n += pair.first; return n; }
"""
EXPECTED = ("modernize-use-override", "bugprone-integer-division", "bugprone-use-after-move", "performance-for-range-copy", "readability-container-size-empty")


def self_test(root, scratch):
    planted = os.path.join(scratch, "planted.h")
    with open(planted, "w", encoding="utf-8") as file:
        file.write(PLANTED)
    text = Reading(scratch, scratch, os.path.join(root, ".clang-tidy")).findings("planted", ["planted.h"], ["-std=c++17"])
    missed = [check for check in EXPECTED if f"[{check}" not in text]
    print(text + "".join(f"not found: {check}\n" for check in missed), end="")
    return 1 if missed else 0


def main():
    arguments = sys.argv[1:]
    run = look
    if arguments[:1] == ["--self-test"]:
        run, arguments = self_test, arguments[1:]
    if len(arguments) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    if not shutil.which(TIDY) or not shutil.which(CLANG):
        print(f"there is no {TIDY}, or no {CLANG}")
        return 77
    root, scratch = os.path.realpath(arguments[0]), os.path.realpath(arguments[1])
    os.makedirs(scratch, exist_ok=True)
    return run(root, scratch, *arguments[2:])


if __name__ == "__main__":
    sys.exit(main())
