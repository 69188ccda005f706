#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the intervals of `myolines verify` hold much finer values, for doc/verify.md.

verify_table.py MYOLINES [--keep FOLDER] [--require]

Last force and peak force of four scenes: the value of the scene with its errors, as verify.csv has them, beside that of one run that is finer in space and in
time, by a method of higher order where the scene's is of first. The bipennate muscle has a mesh of 3 x 1 x 3 cells; the finer one is that of input/bodies.
--keep: runs that are there are not taken again. --require ends with exit code 1 unless every interval holds.
"""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

from block import ENVIRONMENT, HERE

ROOT = pathlib.Path(HERE).resolve().parent.parent
sys.path.insert(0, str(ROOT / "input" / "bodies"))
sys.dont_write_bytecode = True
import make_bodies  # noqa: E402

PULL = ("reaction.csv:moving end x", "reaction.csv:moving end x:largest")
LIFT = ("reaction.csv:origin along the line", "reaction.csv:origin along the line:smallest")
# Name, scene, settings, quantities, settings of the finer run.
SCENES = (
    ("isometric block", "isometric_block.xml", ["system/geometry/refinement=1"], PULL,
     ["system/geometry/refinement=3", "integrator/type=sdirk2", "time/step=0.00625"]),
    ("kinked block", "kinked_block.xml", [], PULL, ["system/geometry/refinement=3", "time/step=0.003125"]),
    ("bipennate", "bodies/bipennate.xml", ["system/geometry/file=MESH"], PULL,
     ["time/control/displacement/relative tolerance=1e-4", "time/control/displacement/absolute tolerance=1e-7"]),
    ("afterloaded", "afterloaded_contraction.xml", [], LIFT,
     ["system/geometry/refinement=2", "integrator/type=sdirk2", "time/step=0.00125"]),
)


def command(program, what, scene, settings, out, *more):
    arguments = [program, what, str(ROOT / "input" / scene), "--out", str(out), *more]
    return arguments + [x for setting in settings for x in ("--set", setting)]


def finer_value(folder, quantity):
    name, column, *take = quantity.split(":")
    with open(folder / name, newline="") as file:
        head, *rows = csv.reader(file)
    place = [title.split(" [")[0] for title in head].index(column)
    values = [float(row[place]) for row in rows if row[place]]
    return values[-1] if not take else max(values) if take == ["largest"] else min(values)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--keep", metavar="FOLDER", type=pathlib.Path)
    parser.add_argument("--require", action="store_true")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    all_hold = True
    print("| scene | force [N] | value | steps | mesh | finer | off by | held |\n|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        folder = (options.keep or pathlib.Path(scratch)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        make_bodies.bipennate((3, 1, 3)).write(folder / "bipennate.msh")
        for name, scene, settings, quantities, finer in SCENES:
            settings = [setting.replace("MESH", str(folder / "bipennate.msh")) for setting in settings]
            asked = [x for quantity in quantities for x in ("--quantity", quantity)]
            stem = folder / name.replace(" ", "_")
            subprocess.run(command(program, "verify", scene, settings, f"{stem}_verified", "--jobs", "1", *asked), check=True, env=ENVIRONMENT,
                           stdout=subprocess.DEVNULL)
            fine = pathlib.Path(f"{stem}_finer")
            if not (fine / "manifest.json").exists() or '"exit reason": "done"' not in (fine / "manifest.json").read_text():
                resumed = ["--resume"] if (fine / "checkpoint").exists() else ["--overwrite"]
                subprocess.run(command(program, "run", scene, finer, fine, "--quiet", *resumed), check=True, env=ENVIRONMENT)
            with open(f"{stem}_verified/verify.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            for row, quantity in zip(rows, quantities):
                value, steps, mesh = (float(row[column] or 0) for column in ("value", "error of steps", "error of mesh"))
                true = finer_value(fine, quantity)
                holds = abs(true - value) <= steps + mesh
                all_hold = all_hold and holds
                print(f"| {name} | {'peak' if quantity.count(':') > 1 else 'last'} | {value:.4g} | {steps:.2g} | {mesh:.2g} | {true:.4g} | "
                      f"{abs(true - value):.2g} | {'yes' if holds else 'no'} |", flush=True)
    return 0 if all_hold or not options.require else 1


if __name__ == "__main__":
    sys.exit(main())
