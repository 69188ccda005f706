#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Table 4.2 of the thesis again: table42.py PROGRAM [--limit 120] [--only ode23tb ...]

Every solver of MATLAB in that table has a counterpart here, which runs input/adaptive_rod.xml: the Neo-Hookean rod of 64 elements under the
sinusoidal pull (4.7.5) until 1 s, with RelTol = 1e-2 and AbsTol = 1e-4 for displacements and velocities. Printed beside what the thesis prints:
whether the run ends, accepted + rejected steps (those whose solve failed included), the average step, CPU seconds (user time), evaluations of the
residual, factorisations, and the largest velocity of the middle of the rod at multiples of 0.1 ms. The last row, with much smaller tolerances, tells
what that should be. newmark estimates the errors of displacements only: its scene has no list of velocities. A run is stopped after --limit seconds of CPU.
"""

import argparse
import os
import re
import tempfile
import xml.etree.ElementTree as xml

from block import HERE
from measured_runs import measured_run

SCENE = os.path.join(HERE, "..", "..", "input", "adaptive_rod.xml")
NO = "no"


def method(name, **parameters):
    """Settings of the integrator; _ for blanks."""
    settings = {"integrator/type": name}
    settings.update({"integrator/" + path.replace("_", " "): value for path, value in parameters.items()})
    return settings


def explicit(table):
    return method("arkode", implicit_table="none", explicit_table=table)


def within(block, tolerance):
    return {f"time/control/{block}/relative tolerance": 0, f"time/control/{block}/absolute tolerance": tolerance}


# solver of MATLAB, what Table 4.2 prints (average step [s], CPU [s]), our counterpart
ROWS = [
    ("ode45", NO, explicit("DORMAND_PRINCE_7_4_5")),
    ("ode23", NO, explicit("BOGACKI_SHAMPINE_4_2_3")),
    ("ode113", "1.46e-6, 724", method("cvode", formula="adams", iteration="fixed point", maximum_order=12)),
    ("ode78", NO, explicit("VERNER_8_5_6")),
    ("ode89", NO, explicit("FEHLBERG_13_7_8")),
    ("ode113, MaxOrder 2", "", method("cvode", formula="adams", iteration="fixed point", maximum_order=2)),
    ("ode15s", NO, method("cvode")),
    ("ode15s, MaxOrder 2", "", method("cvode", maximum_order=2)),
    ("ode15i", "", method("ida")),
    ("ode15i, MaxOrder 2", "", method("ida", maximum_order=2)),
    ("ode23s", "5.69e-5, 2262", method("rosenbrock")),
    ("ode23t", "6.21e-7, 1301", method("newmark")),
    ("ode23t", "6.21e-7, 1301", dict(method("newmark"), **within("displacement", 1e-7))),
    ("ode23tb", "4.25e-5, 29", method("tr-bdf2")),
    ("", "", method("sdirk2")),
    ("", "", method("sdirk3")),
    ("", "", method("arkode")),
    ("", "", method("arkode", implicit_table="ARK436L2SA_DIRK_6_3_4", explicit_table="ARK436L2SA_ERK_6_3_4", split="linear")),
]

TIGHT = dict(explicit("FEHLBERG_13_7_8"), **within("displacement", 1e-7), **within("velocity", 1e-7))


def without_velocities(scene, folder):
    """A copy of the scene for methods that estimate the errors of displacements only."""
    tree = xml.parse(scene)
    control = tree.find("./ParameterList[@name='time']/ParameterList[@name='control']")
    control.remove(control.find("./ParameterList[@name='velocity']"))
    copy = os.path.join(folder, "without_velocities.xml")
    tree.write(copy)
    return copy


def label(settings):
    """The integrator, then its other parameters, then tolerances that are not those of the table."""
    parts = [f"`{settings['integrator/type']}`"]
    for path, value in settings.items():
        name = path.split("/")[-1]
        if name in ("implicit table", "explicit table", "formula", "iteration") and value != "none":
            parts.append(value)
        elif name in ("maximum order", "split"):
            parts.append(f"{name} {value}")
        elif name == "absolute tolerance":
            parts.append(f"{path.split('/')[-2]} within {value:g}")
    return ", ".join(parts)


def shortened(reason):
    """Where and why, without repetitions and advice."""
    found = re.search(r"The step from t = (\S+) s failed: (.*?)\. To try", reason)
    if not found:
        return reason
    when, why = found.groups()
    innermost = re.search(r"\((.*)\)$", why)
    return f"t = {float(when):.3g} s: " + (innermost.group(1) if innermost else why)


def row(solver, printed, run, settings):
    end = "yes" if run.finished else "no, " + shortened(run.reason)
    reached = 1.0 if run.finished else run.last_time()
    middle = max(abs(values[2]) for values in run.rows("motion.csv"))
    return [solver, printed, label(settings), end, f"{run.accepted} + {run.rejected}", f"{reached / max(run.accepted, 1):.2e}", f"{run.cpu:.2f}",
            run.count("residual evaluations"), run.count("preconditioner set-ups"), f"{middle:.3g}"]


HEADER = ["MATLAB", "its result", "here", "finished", "steps + rejected", "average step [s]", "CPU [s]", "residuals", "factorisations",
          "largest velocity [m/s]"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--limit", type=float, default=120, help="seconds of CPU of one run")
    arguments.add_argument("--only", nargs="+", help="rows whose solver of MATLAB or integrator is named so")
    given = arguments.parse_args()
    rows = ROWS + [("", "", TIGHT)]
    if given.only:
        rows = [entry for entry in rows if entry[0] in given.only or entry[2]["integrator/type"] in given.only]
    print("| " + " | ".join(HEADER) + " |")
    print("|" + "---|" * len(HEADER))
    with tempfile.TemporaryDirectory() as folder:
        for number, (solver, printed, settings) in enumerate(rows):
            scene = without_velocities(SCENE, folder) if settings["integrator/type"] == "newmark" else SCENE
            output = {"output/series/every": 1000000000, "output/series/places": "0.5", "output/motion/interval": 1e-4}
            run = measured_run(given.program, scene, dict(settings, **output), os.path.join(folder, str(number)), given.limit)
            print("| " + " | ".join(str(entry) for entry in row(solver, printed, run, settings)) + " |", flush=True)


if __name__ == "__main__":
    main()
