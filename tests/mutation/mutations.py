#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wrong numerical lines must be noticed: mutations.py SOURCE_FOLDER SCRATCH_FOLDER [--only NUMBER]...

Each mutation changes one line of a copy of the sources (a sign, a dropped term, a factor), builds the tests of one room and runs them. A
mutation that they pass is told, and the exit code is 1.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys

# file, right, wrong, tests (program and, for long ones, a filter)
MUTATIONS = [
    ("source/time/dirk.cc", "combine(d_, {{g, &point.v}}); // u~ - u_0", "combine(d_, {{-g, &point.v}});", ("integrators", "*sdirk2*")),
    ("source/time/alpha_method.cc", "{dt * dt * (0.5 - beta), &state.a}});", "{dt * dt * 0.5, &state.a}});", ("integrators", "*newmark*:*alpha*")),
    ("source/time/energy_balance.cc", "const double half = (t - before_->t) / 2;", "const double half = t - before_->t;", ("time", "*")),
    ("source/time/error_norm.cc", "communicator_) / n_free_)", "communicator_))", ("time", "*")),
    ("source/system/spline_filter.cc", ": i + 1 == j ? h[j] / 6", ": i + 1 == j ? h[j] / 3", ("system", "*")),
    ("source/muscle1d/hill_force.cc", "+ passive.value + damping * e,", "+ passive.value - damping * e,", ("muscle1d", "*")),
    ("source/rod1d/rod1d_material.cc", "kappa / (2 * (1 + nu)));", "kappa / (2 * (1 - nu)));", ("rod1d", "*")),
    ("source/study/discretisation_error.cc", "*found.assumed) - 1);", "*found.assumed));", ("study", "*iscretisation*")),
    ("source/compare/differences.cc", "weight = length * points.weight[q];", "weight = points.weight[q];", ("compare", "*")),
    ("source/muscle3d/surface_forces.cc", "return -scale * point.weight * face.sign * cross_product_3d(x.x1, x.x2);",
     "return -scale * point.weight * cross_product_3d(x.x1, x.x2);", ("muscle3d", "*ressure*:*BoundaryTerms*")),
]


def run(*command, folder=None):
    return subprocess.run([str(word) for word in command], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def noticed(copy, file, right, wrong, room, tests):
    """Whether the tests of the room fail with the line as it should not be. The line is put back."""
    path = copy / file
    text = path.read_text()
    if text.count(right) != 1:
        sys.exit(f"{file}: the line \"{right}\" is there {text.count(right)} times")
    path.write_text(text.replace(right, wrong))
    try:
        built = run("ninja", "-C", copy / "build" / "release", f"test_{room}")
        if built.returncode != 0:
            sys.exit(built.stdout[-3000:])
        tested = run(copy / "build" / "release" / "tests" / f"test_{room}", f"--gtest_filter={tests}", "--gtest_brief=1")
        failed = [line for line in tested.stdout.splitlines() if line.startswith("[  FAILED  ]")]
        return tested.returncode != 0, failed[-1] if failed else f"exit code {tested.returncode}"
    finally:
        path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--only", type=int, action="append", help="this mutation, from 1; may be repeated")
    arguments = parser.parse_args()
    copy = arguments.scratch.resolve()
    if not copy.exists():
        shutil.copytree(arguments.source, copy, ignore=shutil.ignore_patterns("build", ".git", "results"))
        configured = run("cmake", "--preset", "release", folder=copy)
        if configured.returncode != 0:
            sys.exit(configured.stdout[-3000:])
    survived = 0
    for number, (file, right, wrong, (room, tests)) in enumerate(MUTATIONS, 1):
        if arguments.only and number not in arguments.only:
            continue
        seen, how = noticed(copy, file, right, wrong, room, tests)
        survived += not seen
        print(f"{number}. {file}: \"{right}\" -> \"{wrong}\": {'noticed, ' + how if seen else 'SURVIVED'}", flush=True)
    print(f"{survived} survived")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
