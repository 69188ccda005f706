#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work and error of the methods of SUNDIALS, beside sdirk3, over the tolerance: sundials.py PROGRAM [--cases rod muscle] [--limit 30]

rod: input/adaptive_rod.xml with 8 elements until 0.1 s, displacements within tol and 1e-2 m tol, velocities within tol and 1 m/s tol; error
of u at the end, root mean square over the nodes between the ends, against the table VERNER_8_5_6 at 1e-10.
muscle: input/isometric_block.xml at refinement 1, exact rates, displacements within tol and 1e-3 m tol; error of the displacement of a point
at the middle of the top, and of the force at the moving end (relative, in parentheses), against sdirk3 at 1e-7.
An entry: steps + rejected (failed solves included); residuals; linear iterations; CPU seconds; error over tolerance.
"""

import argparse
import math
import os
import tempfile

from block import HERE, SCENE as BLOCK
from measured_runs import measured_run

ROD = os.path.join(HERE, "..", "..", "input", "adaptive_rod.xml")
IDA = {"integrator/type": "ida"}
BDF = {"integrator/type": "cvode"}
ORDER_2 = {"integrator/maximum order": 2}
ADAMS = {"integrator/type": "cvode", "integrator/formula": "adams", "integrator/iteration": "fixed point", "integrator/maximum order": 12}
ARKODE = {"integrator/type": "arkode"}
FIFTH = {"integrator/type": "arkode", "integrator/implicit table": "ESDIRK547L2SA_7_4_5"}
SDIRK3 = {"integrator/type": "sdirk3"}


def explicit(table):
    return {"integrator/type": "arkode", "integrator/implicit table": "none", "integrator/explicit table": table}


def norm(values):
    return math.sqrt(sum(value * value for value in values))


def distance(a, b):
    return norm(x - y for x, y in zip(a, b))


class Rod:
    name, scene = "rod", ROD
    methods = {"`ida`": IDA, "`ida`, order 2": dict(IDA, **ORDER_2), "`cvode`": BDF, "`cvode`, adams": ADAMS, "`arkode`": ARKODE, "`arkode`, DORMAND_PRINCE": explicit("DORMAND_PRINCE_7_4_5"),
               "`sdirk3`": SDIRK3}
    tolerances = ("1e-3", "1e-4", "1e-5", "1e-6", "1e-7")
    reference = explicit("VERNER_8_5_6"), "1e-10"

    @staticmethod
    def settings(tolerance):
        settings = {"system/elements": 8, "time/end": 0.1, "time/step": 1e-6, "output/series/every": 1000000000, "output/nodal states/times": "0.1"}
        for block, absolute in (("displacement", 1e-2), ("velocity", 1.0)):
            settings[f"time/control/{block}/relative tolerance"] = tolerance
            settings[f"time/control/{block}/absolute tolerance"] = absolute * float(tolerance)
        return settings

    @staticmethod
    def result(run):
        return [row[2] for row in run.rows("nodal_states.csv")][1:-1]

    @staticmethod
    def error(result, expected, tolerance):
        rms = 1 / math.sqrt(len(expected))
        return f"{distance(result, expected) * rms / (tolerance * (1e-2 + norm(expected) * rms)):.2g}"


class Muscle:
    name, scene = "muscle", BLOCK
    methods = {"`ida`": IDA, "`ida`, order 2": dict(IDA, **ORDER_2), "`cvode`": BDF, "`cvode`, order 2": dict(BDF, **ORDER_2),
               "`arkode`": ARKODE, "`arkode`, ESDIRK547L2SA": FIFTH, "`sdirk3`": SDIRK3}
    tolerances = ("1e-2", "1e-3", "1e-4", "1e-5")
    reference = SDIRK3, "1e-7"

    @staticmethod
    def settings(tolerance):
        return {"system/geometry/refinement": 1, "time/boundary rates": "exact", "time/events": "restart", "time/control/type": "error",
                "time/step": 1e-3, "time/control/displacement/relative tolerance": tolerance,
                "time/control/displacement/absolute tolerance": 1e-3 * float(tolerance), "output/series/every": 1000000000,
                "output/series/markers": "top 0.015 0.005 0.01"}

    @staticmethod
    def result(run):
        return run.rows("displacements-3d.csv")[-1][1:] + run.rows("reaction.csv")[-1][1:2]

    @staticmethod
    def error(result, expected, tolerance):
        error = distance(result[:3], expected[:3]) / (tolerance * (1e-3 + norm(expected[:3])))
        return f"{error:.2g} ({abs(result[3] / expected[3] - 1):.1g})"


def entry(run, error):
    return f"{run.accepted} + {run.rejected}; {run.count('residual evaluations')}; {run.count('linear iterations')}; {run.cpu:.2f}; {error}"


def table(program, case, folder, limit):
    def run(name, method, tolerance):
        return measured_run(program, case.scene, dict(case.settings(tolerance), **method), os.path.join(folder, name), limit)

    reference = run("reference", *case.reference)
    if not reference.finished:
        raise RuntimeError(reference.reason)
    expected = case.result(reference)
    print(f"| {case.name} | " + " | ".join(case.tolerances) + " |")
    print("|---|" + "---|" * len(case.tolerances))
    for number, (name, method) in enumerate(case.methods.items()):
        entries = []
        for tolerance in case.tolerances:
            one = run(f"{number} {tolerance}", method, tolerance)
            error = case.error(case.result(one), expected, float(tolerance)) if one.finished else "fails: " + one.reason
            entries.append(entry(one, error))
        print(f"| {name} | " + " | ".join(entries) + " |", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--cases", nargs="+", choices=["rod", "muscle"], default=["rod", "muscle"])
    arguments.add_argument("--limit", type=float, default=30, help="seconds of CPU of one run")
    given = arguments.parse_args()
    for case in (Rod, Muscle):
        if case.name in given.cases:
            with tempfile.TemporaryDirectory() as folder:
                table(given.program, case, folder, given.limit)


if __name__ == "__main__":
    main()
