#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the bodies of doc/results/gallery.md, draws them, and writes the page.

gallery.py MYOLINES FOLDER        runs in FOLDER; what is there already is not run again
"""
import datetime
import os
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FIBRES = "fibre direction"

# name, scene, what is set, arguments of `picture`, words
BODIES = (
    ("block", "input/isometric_block.xml", ["system/geometry/refinement=2", "output/fields/every=2"], [["--fibres", "40"]],
     "An isometric contraction of a pennate block of 3 x 1 x 1 cm (`input/isometric_block.xml`): lines along its fibres at rest and fully activated, coloured by their "
     "stretch. Fibres between the held ends lengthen, those from side to side shorten."),
    ("bipennate", "input/bodies/bipennate.xml", [], [["--fibres", "60"], ["--field", "tissue", "--cut", "y:0.5", "--view", "160", "20"]],
     "A bipennate muscle of 8 cm with a sheet of aponeurosis in its middle (`input/bodies/bipennate.xml`), and its tissues where it is cut."),
    ("gastrocnemius", "input/gastrocnemius_running/gastrocnemius_running.xml", ["time/end=0.37", "output/fields/every=37"], [["--fibres", "80"]],
     "A medial gastrocnemius of 22 cm in half a stride of running (`input/gastrocnemius_running/gastrocnemius_running.xml`)."),
    ("tetrahedra", "input/bodies/curved.xml", [], [["--fibres", "40"], ["--field", "pressure", "--cut", "z:0.5"]],
     "A curved muscle of tetrahedra, split into hexahedra, with fibre vectors at its points (`input/bodies/curved.xml`); and the pressure where it is cut."),
    ("column", "tests/curves/twisting_column.xml", ["output/fields/every=8"], [["--field", "stretch", "--at", "0", "0.008", "0.016", "0.02"]],
     "A column, held at one end, that begins to twist about its axis (`tests/curves/twisting_column.xml`)."),
)

HEAD = """# Gallery

*Drawn {date}, commit {commit}, by the command below.*

Bodies of scenes of this repository, drawn by `myolines picture` from the fields that their runs write. `tests/curves/gallery.py PROGRAM FOLDER` makes this page:
it runs the scenes, draws the pictures and writes the text. The reports of the runs ([seeing a run](../pictures.md#reports)) have {sizes} MB.
"""


def call(words):
    print(" ".join(words), flush=True)
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def head(program, runs):
    """With the sizes of their reports, which have to fit into an e-mail."""
    sizes = []
    for run in runs:
        call([program, "report", run])
        sizes.append(os.path.getsize(os.path.join(run, "report.html")) / 1e6)
        if sizes[-1] > 6:
            sys.exit(f"the report of {run} has {sizes[-1]:.1f} MB, more than 6")
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
    return HEAD.format(date=datetime.date.today(), commit=commit, sizes=", ".join(f"{size:.1f}" for size in sizes))


def main(program, folder):
    text = []
    for name, scene, settings, pictures, words in BODIES:
        run = os.path.join(folder, name)
        settings = [f"output/fields/what=displacement, stretch, pressure, tissue, {FIBRES}"] + settings
        if not os.path.exists(os.path.join(run, "fields.pvd")):
            call([program, "run", os.path.join(ROOT, scene), "--quiet", "--out", run] + [word for each in settings for word in ("--set", each)])
        text.append(f"## {name.capitalize()}\n\n{words}\n")
        for number, arguments in enumerate(pictures):
            out = os.path.join(folder, f"{name} pictures {number}")
            shutil.rmtree(out, ignore_errors=True)
            call([program, "picture", run, "--out", out, "--width", "1000"] + arguments)
            file = f"gallery_{name}{'_' + str(number + 1) if number else ''}.png"
            made = [each for each in os.listdir(out) if each.endswith(".png")]
            shutil.copy(os.path.join(out, made[0]), os.path.join(ROOT, "doc", "pictures", file))
            text.append(f"![{name}](../pictures/{file})\n")
        shown = " ".join(f"--set \"{each}\"" for each in settings)
        first = " ".join(pictures[0])
        text.append(f"```sh\nmyolines run {scene} --out {name} \\\n  {shown}\nmyolines picture {name} {first}\n```\n")
    text.insert(0, head(program, [os.path.join(folder, body[0]) for body in BODIES]))
    with open(os.path.join(ROOT, "doc", "results", "gallery.md"), "w", encoding="utf-8") as page:
        page.write("\n".join(text))


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]))
