#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flexodeal Lite beside Myolines, from the same input files, by ratio of CPU seconds.

flexodeal_lite.py FLEXODEAL_LITE PROGRAM [--input FOLDER] [--set "ENTRY=VALUE" ...] [--pairs 2] [--points 3 ...]

FLEXODEAL_LITE is the program dynamic-muscle of github.com/sfu-nml/flexodeal-lite, version 1.5, built outside of this repository in Release mode. FOLDER has
what it reads: parameters.prm, control_points_strain.dat, control_points_activation.dat, markers.dat; PROGRAM imports the same files. --set changes an
entry of the parameters for both; the optional binary files of Flexodeal Lite are off. Every pair runs all programs one after the other, in turns from
the front and from the back, each on one thread. Everything counts: start, steps, and what each program writes by default.

Prints CPU seconds (user and system) per step, the median of the pairs; Newton and Krylov iterations; at the end the force at the nearest inner points of
the pulled face and its reaction, which Flexodeal Lite does not write; and its CPU seconds over those of Myolines, the median of the pairs' ratios
with the smallest and the largest. --points: rows of Myolines with fewer points per direction. After each pair the table so far goes to standard error.

The ratio means nothing if the programs do not compute the same: forces at the end that differ by more than 0.1 %, at equal points, are refused.
"""

import argparse
import csv
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from block import ENVIRONMENT, HERE, run_command, spawn
from measured_runs import MeasuredRun

INPUT = os.path.join(HERE, "..", "regression", "flexodeal_isometric_refinement3")
PARAMETERS, STRAIN, ACTIVATION, MARKERS = FILES = ["parameters.prm", "control_points_strain.dat", "control_points_activation.dat", "markers.dat"]
ARGUMENTS = ["-ACTIVATION", "-BDY_STRAIN", "-OUTPUT_DIR", "-PARAMETERS"]
BUILD = "git clone https://github.com/sfu-nml/flexodeal-lite; git checkout f397969; cmake . -DCMAKE_BUILD_TYPE=Release; make"
SAME = 1e-3  # of the force


class Refused(Exception):
    """Input with which nothing can be measured."""


class Failed(Exception):
    """A program that fails."""


class Side:
    """One program with what its runs took: CPU seconds of each, counts and forces of the last one."""

    def __init__(self, name, points, run):
        self.name, self.points, self.run = name, points, run
        self.cpu, self.steps, self.newton, self.krylov, self.force, self.reaction = [], 0, 0, 0, 0.0, None

    def measure(self, scratch):
        out = tempfile.mkdtemp(dir=scratch)
        self.run(self, out)
        shutil.rmtree(out)
        print(f"{self.name}, {self.points} points: {self.cpu[-1]:.1f} s for {self.steps} steps", file=sys.stderr, flush=True)


def last_row(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[-1]


def spend(command, folder):
    """CPU seconds of a command and what it printed."""
    log = os.path.join(folder, "log")
    with open(log, "w", encoding="utf-8") as file:
        try:
            usage, _ = spawn(command, file, folder)
        except (RuntimeError, OSError) as error:
            with open(log, encoding="utf-8", errors="replace") as text:
                raise Failed(f"{error}\n{text.read()[-2000:]}") from error
    with open(log, encoding="utf-8") as text:
        return usage.ru_utime + usage.ru_stime, text.read()


def flexodeal_lite(program, inputs):
    def run(side, out):
        for name in FILES:
            shutil.copy(os.path.join(inputs, name), out)
        # The name of the folder has 80 characters at most.
        words = [f"-PARAMETERS={PARAMETERS}", f"-BDY_STRAIN={STRAIN}", f"-ACTIVATION={ACTIVATION}", "-OUTPUT_DIR=out"]
        cpu, text = spend([program] + words, out)
        # A line of a Newton iteration has "| iterations residual" behind its phases.
        solves = [int(count) for count in re.findall(r"UQPH\s+\|\s+(\d+)\s+\d\.\d+e[-+]\d+", text)]
        if not solves:
            raise Failed(f"{program} prints no Newton iterations:\n{text[-2000:]}")
        side.cpu.append(cpu)
        side.steps, side.newton, side.krylov = len(re.findall(r"^Timestep \d+ @", text, re.M)), len(solves), sum(solves)
        side.force = float(last_row(os.path.join(out, "out", "force_data-3d.csv"))["Total [N]"])

    return run


def myolines(program, scene, settings):
    def run(side, out):
        folder = os.path.join(out, "out")
        cpu, _ = spend(run_command(program, scene, settings, folder), out)
        made = MeasuredRun(folder, 0, "", cpu)
        side.cpu.append(cpu)
        side.steps, side.newton, side.krylov = made.accepted, made.count("newton iterations"), made.count("linear iterations")
        side.force = float(last_row(os.path.join(folder, "force_data-3d.csv"))["Total [N]"])
        side.reaction = float(last_row(os.path.join(folder, "reaction.csv"))["moving end x [N]"])

    return run


def executable(path, what):
    if not os.path.isfile(path) or not os.access(path, os.X_OK):
        raise Refused(f"{path}: no program; expected {what}")
    return os.path.abspath(path)


def said(program, argument):
    """What a program prints to an argument; nothing if it does not end."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            return subprocess.run([program, argument], cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                                  check=False, timeout=60).stdout
        except (OSError, subprocess.TimeoutExpired):
            return ""


def check_flexodeal_lite(path):
    """That `path` takes the arguments of version 1.5: it lists them when it gets another one, and stops."""
    program = executable(path, f"dynamic-muscle of Flexodeal Lite. To build it: {BUILD}")
    listed = re.search(r"^Supported arguments: (.*)$", said(program, "-NONE=1"), re.M)
    if not listed or sorted(listed.group(1).split()) != ARGUMENTS:
        has = f"its arguments are {listed.group(1).strip()}" if listed else "it does not list its arguments"
        raise Refused(f"{path}: not Flexodeal Lite 1.5: {has}; expected {' '.join(ARGUMENTS)}. To build it: {BUILD}")
    return program


def check_myolines(path):
    program = executable(path, "Myolines, build/release/myolines")
    text = said(program, "--version")
    if not text.startswith("myolines "):
        raise Refused(f'{path}: not Myolines: to --version it says "{text.strip().partition(chr(10))[0][:80]}"; expected build/release/myolines')
    return program


def write_inputs(source, entries, folder):
    """Copies of the input files, with other values of entries; returns the points per direction."""
    for name in FILES:
        try:
            shutil.copyfile(os.path.join(source, name), os.path.join(folder, name))
        except OSError as error:
            raise Refused(f"{os.path.join(source, name)}: {error.strerror}; expected the files {', '.join(FILES)} in {source}") from error
    path = os.path.join(folder, PARAMETERS)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for entry, value in entries.items():
        text, number = re.subn(rf"^(\s*set {re.escape(entry)}\s*=).*$", lambda match, value=value: f"{match.group(1)} {value}", text, flags=re.M)
        if number != 1:
            raise Refused(f'--set "{entry}={value}": {os.path.join(source, PARAMETERS)} has {number} entries "{entry}"; expected the name of one')
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    points = re.search(r"^\s*set Quadrature order\s*=\s*(\d+)\s*$", text, re.M)
    if not points:
        raise Refused(f'{os.path.join(source, PARAMETERS)}: no entry "Quadrature order"; expected the points per direction')
    return int(points.group(1))


def entry_of(text):
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise Refused(f'--set "{text}": expected "ENTRY=VALUE"')
    return name, value


def sides_of(given, scratch):
    other, ours = check_flexodeal_lite(given.flexodeal_lite), check_myolines(given.program)
    entries = dict([("Output binary files main variables", "false")] + [entry_of(text) for text in given.set])
    points = write_inputs(given.input, entries, scratch)
    scene = os.path.join(scratch, "scene.xml")
    spend([ours, "import", "flexodeal", PARAMETERS, STRAIN, ACTIVATION, "--markers", MARKERS, "--out", scene], scratch)
    sides = [Side("Flexodeal Lite", points, flexodeal_lite(other, scratch)), Side("Myolines", points, myolines(ours, scene, {}))]
    return sides + [Side("Myolines", fewer, myolines(ours, scene, {"system/discretisation/quadrature points": fewer})) for fewer in given.points]


def check_same(other, ours):
    """At equal points both compute the same force in the same number of steps."""
    if other.steps != ours.steps or abs(other.force - ours.force) > SAME * abs(ours.force):
        raise Refused(f"Flexodeal Lite ends with {other.force:g} N after {other.steps} steps, Myolines with {ours.force:g} N after {ours.steps}: "
                      "they do not compute the same; expected version 1.5, unchanged")


def ratio(side, ours):
    ratios = [a / b for a, b in zip(side.cpu, ours.cpu)]
    return f"{statistics.median(ratios):.3g} ({min(ratios):.3g} to {max(ratios):.3g})"


def print_table(sides, file):
    other, *ours = sides
    heads = ["program", "points", "CPU per step [s]", "Newton per step", "Krylov per Newton", "force [N]", "reaction [N]"]
    heads += [f"CPU over Myolines with {side.points} points" for side in ours]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads), file=file)
    for side in sides:
        row = [side.name, str(side.points), f"{statistics.median(side.cpu) / side.steps:.3g}", f"{side.newton / side.steps:.2f}",
               f"{side.krylov / side.newton:.1f}", f"{side.force:.5g}", f"{side.reaction:.5g}" if side.reaction is not None else ""]
        print("| " + " | ".join(row + [ratio(side, our) if side is other else "" for our in ours]) + " |", file=file, flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("flexodeal_lite", metavar="FLEXODEAL_LITE")
    arguments.add_argument("program", metavar="PROGRAM")
    arguments.add_argument("--input", default=INPUT, metavar="FOLDER", help="default: the isometric block at refinement 3 of the regression tests")
    arguments.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE")
    arguments.add_argument("--pairs", type=int, default=2)
    arguments.add_argument("--points", type=int, nargs="+", default=[3])
    given = arguments.parse_args()
    if given.pairs < 1:
        arguments.error(f"--pairs {given.pairs}: expected 1 or more")
    with tempfile.TemporaryDirectory() as scratch:
        try:
            sides = sides_of(given, scratch)
            for pair in range(given.pairs):
                for side in sides if pair % 2 == 0 else reversed(sides):
                    side.measure(scratch)
                check_same(*sides[:2])
                print_table(sides, sys.stderr)
        except Refused as error:
            print(f"flexodeal_lite.py: {error}", file=sys.stderr)
            return 2
        except Failed as error:
            print(f"flexodeal_lite.py: {error}", file=sys.stderr)
            return 1
    print_table(sides, sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
