#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Does `myolines advise` tell the truth? A table in Markdown: what it predicts for some scenes beside what the advised scene then has.

advise_table.py PROGRAM [--only NAME] [--keep FOLDER]

Errors of steps are measured beside SDIRK3 with 128 steps on the same mesh. Backward Euler has as many steps as it needs for the error that was
measured, as its own errors with 64 and 128 steps say. The bipennate muscle has a mesh of 3 x 1 x 3 cells, refined once. CPU seconds are those of the runs without the loading of the program.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

from measured_runs import ENVIRONMENT, measured_run

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "input/bodies"))
import make_bodies  # noqa: E402

REFINED = ["--set", "system/geometry/refinement=2"]
# Name, scene, quantity, options
SCENES = [
    ("isometric block", "input/isometric_block.xml", "reaction.csv:moving end x", REFINED),
    ("kinked block", "input/kinked_block.xml", "reaction.csv:moving end x", REFINED),
    ("bipennate", "input/bodies/bipennate.xml", "reaction.csv:moving end x", ["--set", "system/geometry/refinement=1"]),
    ("afterloaded", "input/afterloaded_contraction.xml", "displacements-3d.csv:end_x:smallest", REFINED),
]
STEPS_OF_REFERENCE = 128


def value(run, quantity):
    """The value of FILE:COLUMN[:smallest] in a run."""
    name, column, *take = quantity.split(":")
    with open(os.path.join(run.folder, name), newline="") as file:
        head, *rows = csv.reader(file)
    place = next(i for i, text in enumerate(head) if text.split(" [")[0] == column)
    values = [float(row[place]) for row in rows]
    return min(values) if take == ["smallest"] else values[-1]


def seconds(run):
    with open(os.path.join(run.folder, "ledger.json")) as file:
        return json.load(file)["seconds"]["CPU of the run"]


def end_of(program, scene, options):
    """The time that a scene takes [s]."""
    text = subprocess.run([program, "check", scene, *options], capture_output=True, text=True, env=ENVIRONMENT, check=True).stdout
    def number(name):
        return float(text.split(f'name="{name}"')[1].split('value="')[1].split('"')[0])
    return number("end") - number("start")


def row_of(program, name, scene, quantity, options, accuracy, keep_mesh, folder):
    written = os.path.join(folder, name + ".xml")
    command = [program, "advise", scene, "--quantity", quantity, "--accuracy", accuracy, "--write", written, "--quiet", "--jobs", "1",
               "--out", os.path.join(folder, name + " advise"), *options] + (["--keep-mesh"] if keep_mesh else [])
    done = subprocess.run(command, capture_output=True, text=True, env=ENVIRONMENT)
    if done.returncode != 0:
        return [name, accuracy, done.stderr.strip().splitlines()[-1]] + [""] * 9
    with open(os.path.join(folder, name + " advise", "advise.csv"), newline="") as file:
        advised = next(row for row in csv.DictReader(file) if row["advised"] == "yes")
    columns = ["error of steps, " + quantity, "error of steps as tried, " + quantity, "CPU [s]", "CPU as tried [s]"]
    predicted, tried, cost, cost_tried = (f"{float(advised[column]):.2g}" if advised[column] else "" for column in columns)

    def run(label, settings):
        return measured_run(program, written, settings, os.path.join(folder, name + " " + label))
    length = end_of(program, written, [])
    plain = {"time/control/type": "cut back"}
    truth = value(run("truth", {"integrator/type": "sdirk3", "time/step": length / STEPS_OF_REFERENCE, **plain}), quantity)
    taken = run("advised", {})
    error = abs(value(taken, quantity) - truth)

    def euler(steps):
        made = run(f"euler {steps}", {"integrator/type": "backward euler", "time/step": length / steps, **plain})
        return abs(value(made, quantity) - truth), seconds(made)
    coarse, fine = euler(64)[0], euler(128)[0]
    rate = min(max(math.log2(coarse / fine), 0.5), 1) if coarse > fine > 0 else 1
    steps = max(1, round(128 * (fine / error) ** (1 / rate)))
    if steps <= 20000:
        error_of_euler, cost_of_euler = euler(steps)
        euler_cells = [f"{steps}", f"{error_of_euler:.2g}", f"{cost_of_euler:.2g}"]
    else:
        euler_cells = [f"{steps}, not run", "", ""]
    return [name, accuracy, f"`{advised['method']}`, {advised['value']}", predicted, tried, f"{error:.2g}", cost, cost_tried,
            f"{seconds(taken):.2g}"] + euler_cells


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--only")
    parser.add_argument("--keep", help="folder of the runs; called again it goes on")
    parser.add_argument("--accuracy", nargs="+", default=["1 %", "0.1 %"])
    arguments = parser.parse_args()
    print("| scene | asked for | advised | error: pilot | as tried | measured | CPU s: pilot | as tried | measured | backward Euler: steps | error | CPU s |")
    print("|---" * 12 + "|")
    with tempfile.TemporaryDirectory() as scratch:
        for name, scene, quantity, options in SCENES:
            if name == "bipennate":
                mesh = os.path.join(arguments.keep or scratch, "bipennate.msh")
                make_bodies.bipennate((3, 1, 3)).write(pathlib.Path(mesh))
                options = options + ["--set", f"system/geometry/file={os.path.abspath(mesh)}"]
            for accuracy in arguments.accuracy if arguments.only in (None, name) else []:
                folder = os.path.join(arguments.keep or scratch, accuracy.replace(" %", ""))
                os.makedirs(folder, exist_ok=True)
                print("| " + " | ".join(row_of(os.path.abspath(arguments.program), name, scene, quantity, options, accuracy, True, folder))
                      + " |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
