#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What EMG sampled at 1 kHz costs: how many steps it takes, beside the same samples filtered beforehand, for doc/data.md.

emg.py MYOLINES [--seconds 30] [--refinement 2] [--require]
emg.py --samples FILE [--seconds 30]

The EMG is made here: Gaussian noise between 20 and 450 Hz whose amplitude rises and falls in bursts of 1.1 s, each with a size of its own, above a
little noise that never ends. It excites the isometric block of input/ three times:

- with fixed steps of 25 ms, the program filtering the samples at 6 Hz;
- the same with steps chosen by error, tolerance 1e-3;
- with steps chosen by error, the samples filtered beforehand by a Butterworth filter of second order, forwards and backwards at 6 Hz, and given as
  control points at 60 Hz, each of which is a kink.

All by sdirk3. The samples go on for a second after the end, where filters know as little as at any other one. --require ends with exit code 1 unless the first takes one step for every 25 ms, the second at most 1.3 times as many steps as the third, and
both forces at the end are the same within 1 %. --samples only writes the EMG, as CSV.
"""

import argparse
import csv
import math
import os
import random
import sys
import tempfile
import xml.etree.ElementTree as xml

from block import SCENE
from measured_runs import measured_run

RATE = 1000  # [Hz]
BURST = 1.1  # [s]
CUT_OFF = 6  # [Hz]


def second_order(x, numerator, denominator):
    """y_n = b_0 x_n + b_1 x_(n-1) + b_2 x_(n-2) - a_1 y_(n-1) - a_2 y_(n-2), from rest at the first value."""
    gain = sum(numerator) / (1 + sum(denominator))
    x1 = x2 = x[0]
    y1 = y2 = gain * x[0]
    filtered = []
    for value in x:
        y = numerator[0] * value + numerator[1] * x1 + numerator[2] * x2 - denominator[0] * y1 - denominator[1] * y2
        x1, x2, y1, y2 = value, x1, y, y1
        filtered.append(y)
    return filtered


def butterworth(x, cut_off, high_pass=False):
    """Butterworth's filter of second order by the bilinear transform, forwards."""
    k = math.tan(math.pi * cut_off / RATE)
    scale = 1 / (1 + math.sqrt(2) * k + k * k)
    first = 1 if high_pass else k * k
    numerator = [first * scale, (-2 if high_pass else 2) * first * scale, first * scale]
    return second_order(x, numerator, [2 * (k * k - 1) * scale, (1 - math.sqrt(2) * k + k * k) * scale])


def both_ways(x, cut_off):
    """Forwards and backwards, so that nothing shifts; beyond both ends the samples go on as their mirror image."""
    n = min(RATE, len(x) - 1)
    forwards = butterworth(x[n:0:-1] + x + x[-2:-n - 2:-1], cut_off)
    return butterworth(forwards[::-1], cut_off)[::-1][n:n + len(x)]


def synthetic(seconds, seed=1):
    """Times [s] and EMG [mV]."""
    chance = random.Random(seed)
    noise = butterworth(butterworth([chance.gauss(0, 1) for _ in range(round(seconds * RATE) + 1)], 450), 20, high_pass=True)
    sizes = [chance.uniform(0.5, 1) for _ in range(int(seconds / BURST) + 1)]
    t = [i / RATE for i in range(len(noise))]
    return t, [(0.02 + sizes[int(s / BURST)] * math.sin(math.pi * s / BURST) ** 2) * x for s, x in zip(t, noise)]


def envelope(x):
    """Rectified, low-passed, over its maximum."""
    mean = sum(x) / len(x)
    smooth = [max(value, 0) for value in both_ways([abs(value - mean) for value in x], CUT_OFF)]
    return [value / max(smooth) for value in smooth]


def write_samples(file, t, x):
    with open(file, "w", encoding="utf-8") as out:
        out.write("time [s],EMG [mV]\n" + "".join(f"{s:.3f},{value:.5f}\n" for s, value in zip(t, x)))


def write_scene(file, excitation):
    """The isometric block with an excitation of these parameters in place of its activation."""
    tree = xml.parse(SCENE)
    system = tree.getroot().find("./ParameterList[@name='system']")
    system.remove(system.find("./ParameterList[@name='activation']"))
    node = xml.SubElement(system, "ParameterList", name="excitation")
    for name, (kind, value) in excitation.items():
        xml.SubElement(node, "Parameter", name=name, type=kind, value=value)
    tree.write(file)


def force_at_end(run):
    with open(os.path.join(run.folder, "reaction.csv"), newline="", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    return float(last["moving end x [N]"])


def runs(options, folder):
    """What is measured, with its samples and its steps in words."""
    t, x = synthetic(options.seconds + 1)
    write_samples(os.path.join(folder, "emg.csv"), t, x)
    raw, ready = os.path.join(folder, "emg.xml"), os.path.join(folder, "points.xml")
    write_scene(raw, {"type": ("string", "file"), "file": ("string", "emg.csv"), "rectify": ("bool", "true"), "low-pass": ("double", str(CUT_OFF)),
                      "normalise": ("string", "maximum")})
    smooth = envelope(x)
    sampled = [round(i * RATE / 60) for i in range(int(options.seconds * 60) + 1)]
    write_scene(ready, {"type": ("string", "control points"), "points": ("string", "; ".join(f"{t[i]:.3f} {smooth[i]:.6f}" for i in sampled))})
    common = {"integrator/type": "sdirk3", "system/geometry/refinement": options.refinement, "time/end": options.seconds,
              "output/checkpoint/every": 1000000}
    by_error = {"time/control/type": "error", "time/control/displacement/relative tolerance": 1e-3}
    for name, steps, scene, settings in (("1 kHz", "25 ms", raw, {"time/step": 0.025}), ("1 kHz", "by error", raw, by_error),
                                         ("filtered, 60 Hz", "by error", ready, by_error)):
        yield name, steps, measured_run(options.program, scene, {**common, **settings}, os.path.join(folder, f"{len(name)}{steps}"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--refinement", type=int, default=2)
    parser.add_argument("--require", action="store_true")
    parser.add_argument("--samples", metavar="FILE")
    options = parser.parse_args()
    if options.samples:
        return write_samples(options.samples, *synthetic(options.seconds))
    if not options.program:
        parser.error("the program is missing")
    options.program = os.path.abspath(options.program)
    taken, forces = [], []
    print("| samples | steps | accepted | rejected | Newton iterations | force at the end [N] | CPU s |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, steps, run in runs(options, folder):
            if not run.finished:
                sys.exit(f"{name}, {steps}: {run.reason}")
            taken.append(run.accepted)
            forces.append(force_at_end(run))
            print(f"| {name} | {steps} | {run.accepted} | {run.rejected} | {run.count('newton iterations')} | {forces[-1]:.4g} | {run.cpu:.0f} |",
                  flush=True)
    if not options.require:
        return 0
    kept = [taken[0] == round(options.seconds / 0.025), taken[1] <= 1.3 * taken[2], abs(forces[1] - forces[2]) <= 0.01 * abs(forces[2])]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
