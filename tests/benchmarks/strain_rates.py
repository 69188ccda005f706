#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figure 6.16 of the thesis: strain_rates.py PROGRAM [--picture FILE.svg]

Mean fibre strain rates of isometric contractions, input/studies/mass_effects.xml: of the quasi-static runs the difference quotient of the mean stretch (6.5.1),
of the dynamic ones the mean of the strain rate itself (6.2.21), both over the maximum strain rate. One row for each pennation angle, at 10, 50 and 100 % of
activation, with the difference quotient of the dynamic runs in parentheses: what is left between it and the rate is the quotient's. gnuplot draws the picture.
$MYOLINES_RESULTS, if set, is where the study's folder is kept.
"""

import argparse
import csv
import os
import subprocess
import tempfile

from block import HERE
from study_table import run_study

STUDY = os.path.join(HERE, "..", "..", "input", "studies", "mass_effects.xml")
ANGLES = ["0", "5", "10", "15", "20", "25", "30"]
SHOWN = [0.02, 0.1, 0.2]  # s, where a = 0.1, 0.5, 1


def columns(folder, inertia, angle, name, *heads):
    path = os.path.join(folder, "cases", f"inertia={inertia},pennation={angle}", name)
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [[float(row[head]) for row in rows] for head in heads]


def quotients(folder, inertia, angle, largest):
    """(6.5.1) at every time but the first."""
    t, stretch = columns(folder, inertia, angle, "mean_stretch_pennation_data-3d.csv", "Time [s]", "Mean stretch")
    return t[1:], [(b - a) / (largest * (v - u)) for a, b, u, v in zip(stretch, stretch[1:], t, t[1:])]


def rates(folder, angle):
    t, rate, largest = columns(folder, "dynamic", angle, "gearing_info-3d.csv", "Time [s]", "Mean fibre strain rate (non-dim)",
                               "Maximum strain rate [1/s]")
    return t[1:], rate[1:], largest[0]


def at(times, values, t):
    return min(zip(times, values), key=lambda pair: abs(pair[0] - t))[1]


def draw(folder, picture):
    with tempfile.TemporaryDirectory() as scratch:
        plots = []
        for kind in ("quasi-static, difference quotient", "dynamic"):
            curves = []
            for angle in ANGLES:
                times, rate, largest = rates(folder, angle)
                if kind != "dynamic":
                    times, rate = quotients(folder, "quasi-static", angle, largest)
                data = os.path.join(scratch, f"{len(plots)}_{angle}")
                with open(data, "w", encoding="utf-8") as file:
                    file.writelines(f"{t} {value}\n" for t, value in zip(times, rate))
                curves.append(f"'{data}' with lines lw 2 title '{angle} deg'")
            plots.append(f"set title '{kind}'\nplot [0:0.2][-0.45:0.02] {', '.join(curves)}\n")
        text = (f"set terminal svg size 900,380\nset output '{picture}'\nset multiplot layout 1,2\nset xlabel 'time [s]'\n"
                "set ylabel 'mean fibre strain rate / maximum'\nset key bottom right\n" + "".join(plots) + "unset multiplot\n")
        subprocess.run(["gnuplot"], input=text, text=True, check=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--picture")
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        results = os.environ.get("MYOLINES_RESULTS", scratch)
        run_study(given.program, STUDY, results)
        folder = os.path.join(results, "mass_effects")
        print("| pennation | " + " | ".join(f"{head}, {100 * t / 0.2:.0f} %" for t in SHOWN for head in ("quasi-static", "dynamic")) +
              " |\n|" + "---|" * (1 + 2 * len(SHOWN)))
        for angle in ANGLES:
            times, rate, largest = rates(folder, angle)
            line = [angle]
            for t in SHOWN:
                line.append(f"{at(*quotients(folder, 'quasi-static', angle, largest), t):.4f}")
                line.append(f"{at(times, rate, t):.4f} ({at(*quotients(folder, 'dynamic', angle, largest), t):.4f})")
            print("| " + " | ".join(line) + " |")
        if given.picture:
            draw(folder, os.path.abspath(given.picture))


if __name__ == "__main__":
    main()
