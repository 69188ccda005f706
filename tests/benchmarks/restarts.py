#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Methods at kinks, beside sdirk3: restarts.py PROGRAM [--refinement 1] [--tables activation boundary orders] [--methods NAME ...] [--set PATH=VALUE ...]

Runs of input/kinked_block.xml with other drives. Activation: to one half within the time in the head, both ends held. Boundary: an active block whose end is
stretched by 5 % with kinks at 0.05 s and 0.15 s, pulled from the start, or stretched a little within a short time. An entry is how far the force at the moving end is from that of sdirk3 with the same steps, in percent:
at the end of the run, and the most it is after any step from the first kink on, relative to the largest force of sdirk3. "fails": a step that does
not converge; empty: refused. --set goes to all runs but those of sdirk3.

--tables orders: errors of two displacements at the end of the stretch, with restarts, 16, 32 and 64 steps, against 512 of sdirk3, and the order between the last two.
"""

import argparse
import csv
import math
import os
import tempfile

from block import HERE
from measured_runs import measured_run

SCENE = os.path.join(HERE, "..", "..", "input", "kinked_block.xml")


def method(name, **more):
    return dict({"integrator/type": name}, **{"integrator/" + path.replace("_", " "): value for path, value in more.items()})


def radius(value, **more):
    return method("generalized alpha", **{"spectral radius at infinity": value}, **more)


METHODS = {
    "newmark": method("newmark"),
    "hht alpha": method("hht alpha"),
    "hht alpha 0.3": method("hht alpha", alpha=-0.3),
    "wbz alpha": method("wbz alpha"),
    "wbz alpha 0.3": method("wbz alpha", alpha=-0.3),
    "generalized alpha": method("generalized alpha"),
    "generalized alpha 0": radius(0),
    "generalized alpha 0.2": radius(0.2),
    "generalized alpha 0.5": radius(0.5),
    "generalized alpha 0.8": radius(0.8),
    "generalized alpha 0.5, averaged": radius(0.5, force_evaluation="averaged state"),
    "generalized alpha 0.8, averaged": radius(0.8, force_evaluation="averaged state"),
    "wilson theta": method("wilson theta"),
    "tr-bdf2": method("tr-bdf2"),
    "bdf2": method("bdf2"),
    "sdirk2": method("sdirk2"),
    "backward euler": method("backward euler"),
}


def protocol(activation, strain="0 0; 1 0", end=0.05, step=0.005, kink=0.025, rates="exact", events="restart"):
    return kink, {"system/activation/points": activation, "system/boundary/moving end/strain/points": strain, "time/end": end, "time/step": step,
                  "time/boundary rates": rates, "time/events": events}


def ramp(begin, width, value):
    return f"0 0; {begin} 0; {begin + width!r} {value}; 10 {value}"


STRETCH = "0 0; 0.05 0; 0.15 0.05; 0.2 0.05"
PULL = "0 0; 0.05 0.01; 1 0.01"
WIDTHS = (1e-9, 1e-6, 1e-3, 1e-2)

ACTIVATION = {"0.2 s": protocol(ramp(0.1, 0.2, 0.5), end=0.4, step=0.02, kink=0.1)}
ACTIVATION["0.2 s, land"] = protocol(ramp(0.1, 0.2, 0.5), end=0.4, step=0.02, kink=0.1, events="land")
ACTIVATION.update({f"{width:g} s": protocol(ramp(0.025, width, 0.5)) for width in WIDTHS})
ACTIVATION["1e-09 s, until 0.2 s"] = protocol(ramp(0.025, 1e-9, 0.5), end=0.2)
ACTIVATION["from the start"] = protocol("0 0.5; 10 0.5", kink=0)

BOUNDARY = {}
for rates in ("exact", "scheme"):
    BOUNDARY[f"stretch, {rates}"] = protocol("0 0; 0.1 0.5; 0.2 0.5", STRETCH, end=0.2, step=0.00625, kink=0.05, rates=rates)
    BOUNDARY[f"from the start, {rates}"] = protocol("0 0.5; 10 0.5", PULL, kink=0, rates=rates)
    for width in (1e-2, 1e-3):
        BOUNDARY[f"0.2 % within {width:g} s, {rates}"] = protocol("0 0; 0.02 0.5; 1 0.5", ramp(0.025, width, 0.002), rates=rates)
BOUNDARY["stretch, scheme, land"] = protocol("0 0; 0.1 0.5; 0.2 0.5", STRETCH, end=0.2, step=0.00625, kink=0.05, rates="scheme", events="land")

TABLES = {"activation": ACTIVATION, "boundary": BOUNDARY}


def forces(program, settings, folder):
    """[(t, force)], None if the scene is refused, "fails" if a step does not converge."""
    try:
        run = measured_run(program, SCENE, settings, folder)
    except RuntimeError as error:
        if str(error).startswith("exit code 2"):
            return None
        raise
    return [tuple(row[:2]) for row in run.rows("reaction.csv")] if run.finished else "fails"


def deviation(rows, reference, kink):
    """Percents at the end and on the way, or what there is instead."""
    if not isinstance(rows, list):
        return rows or ""
    if [t for t, _ in rows] != [t for t, _ in reference]:
        return "other steps"
    largest = max(abs(force) for _, force in reference)
    worst = max(abs(ours[1] - theirs[1]) for ours, theirs in zip(rows, reference) if ours[0] >= kink)
    return 100 * abs(rows[-1][1] / reference[-1][1] - 1), 100 * worst / largest


def text(entry):
    return entry if isinstance(entry, str) else f"{entry[0]:.1f} ({entry[1]:.1f})"


def displacements(program, settings, steps, folder):
    """Of two points at the end of the stretch; None if the scene is refused or a step fails."""
    tight = {"time/step": 0.2 / steps, "output/series/markers": "a 0.015 0.005 0.01; b 0.02 0.01 0.01",
             "solver/nonlinear/relative tolerance": 1e-12, "solver/nonlinear/absolute tolerance": 1e-11}
    if not isinstance(forces(program, dict(settings, **tight), folder), list):
        return None
    with open(os.path.join(folder, "displacements-3d.csv"), newline="") as file:
        return [float(entry) for entry in list(csv.reader(file))[-1][1:]]


def errors(run, settings, reference):
    found = [run(settings, steps) for steps in (16, 32, 64)]
    if None in found:
        return ""
    sizes = [math.dist(u, reference) / math.hypot(*reference) for u in found]
    return " / ".join(f"{size:.1e}" for size in sizes) + f", {math.log2(sizes[1] / sizes[2]):.1f}"


def print_orders(methods, more, run):
    columns = {rates: BOUNDARY[f"stretch, {rates}"][1] for rates in ("exact", "scheme")}
    print("| method | " + " | ".join(columns) + " |\n|---|---|---|")
    references = {rates: run(dict(settings, **method("sdirk3")), 512) for rates, settings in columns.items()}
    for name in methods:
        entries = [errors(run, dict(settings, **METHODS[name], **more), references[rates]) for rates, settings in columns.items()]
        print(f"| {name} | " + " | ".join(entries) + " |", flush=True)


def worst(entries):
    numbers = [entry for entry in entries if not isinstance(entry, str)]
    return tuple(max(column) for column in zip(*numbers)) if numbers else ""


def print_table(protocols, methods, more, run):
    print("| method | " + " | ".join(protocols) + " | worst |\n|" + "---|" * (2 + len(protocols)))
    references = {name: run(settings, method("sdirk3")) for name, (_, settings) in protocols.items()}
    for name in methods:
        entries = [deviation(run(settings, dict(METHODS[name], **more)), references[p], kink) for p, (kink, settings) in protocols.items()]
        print(f"| {name} | " + " | ".join(text(entry) for entry in entries + [worst(entries)]) + " |", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--refinement", type=int, default=1)
    arguments.add_argument("--tables", nargs="+", default=list(TABLES), choices=[*TABLES, "orders"])
    arguments.add_argument("--methods", nargs="+", default=list(METHODS), choices=list(METHODS))
    arguments.add_argument("--only", nargs="+", metavar="PROTOCOL", help="columns, by their heads")
    arguments.add_argument("--set", nargs="+", default=[], metavar="PATH=VALUE")
    given = arguments.parse_args()
    more = dict(setting.split("=", 1) for setting in given.set)
    common = {"system/geometry/refinement": given.refinement, "output/checkpoint/every": 1000000}
    with tempfile.TemporaryDirectory() as folder:
        def run(protocol_settings, settings):
            return forces(given.program, dict(common, **protocol_settings, **settings), os.path.join(folder, "out"))

        for i, table in enumerate(given.tables):
            if i > 0:
                print()
            if table == "orders":
                out = os.path.join(folder, "out")
                print_orders(given.methods, more, lambda settings, steps: displacements(given.program, dict(common, **settings), steps, out))
                continue
            print_table({name: p for name, p in TABLES[table].items() if not given.only or name in given.only}, given.methods, more, run)


if __name__ == "__main__":
    main()
