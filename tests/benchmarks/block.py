# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the isometric block, and what they cost: shared by the scripts of this folder."""

import csv
import json
import os
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "..", "input", "isometric_block.xml")

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1", DEAL_II_NUM_THREADS="1",
                   PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe")


class Cost:
    """What one run took. Counts and seconds by phase are those of rank 0."""

    def __init__(self, folder, usage, wall):
        with open(os.path.join(folder, "ledger.json")) as file:
            ledger = json.load(file)
        self.counts, self.seconds = ledger["counts"], ledger["seconds"]
        with open(os.path.join(folder, "steps.csv"), newline="") as file:
            self.steps = list(csv.DictReader(file))
        self.accepted = self.counts["accepted steps"]
        self.cpu = usage.ru_utime + usage.ru_stime
        self.wall = wall
        self.megabytes = usage.ru_maxrss / 1024  # of the largest process

    def count(self, what):
        return self.counts.get(what, 0)

    def second(self, phase):
        return self.seconds.get(phase, 0.0)

    def per(self, phase, what):
        """Seconds of a phase per counted event; 0 if there was none."""
        return self.second(phase) / self.count(what) if self.count(what) else 0.0


def run_command(program, scene, settings, out):
    """Words that run `scene` with overrides {path: value}."""
    return [program, "run", scene, "--out", out, "--quiet", "--overwrite"] + [word for path, value in settings.items() for word in ("--set", f"{path}={value}")]


def spawn(command, log, folder=None):
    """Runs a command, in `folder` if given; returns its resources (children included) and its wall-clock seconds. Raises if it fails."""
    begin = time.monotonic()
    process = subprocess.Popen(command, stdout=log, stderr=log, env=ENVIRONMENT, cwd=folder)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"exit code {process.returncode}: {' '.join(command)}")
    return usage, time.monotonic() - begin


def run(program, settings, ranks=1, scene=SCENE):
    """The cost of one run of `scene` with overrides {path: value}."""
    with tempfile.TemporaryDirectory() as folder:
        command = run_command(program, scene, settings, os.path.join(folder, "out"))
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks)] + command
        with open(os.path.join(folder, "log"), "w+") as log:
            try:
                usage, wall = spawn(command, log)
            except RuntimeError:
                log.seek(0)
                sys.stderr.write(log.read())
                raise
        return Cost(os.path.join(folder, "out"), usage, wall)


def block(refinement, points=3, steps=8, **more):
    """Settings of the block at dt = 0.025 s, `steps` steps of them; more settings with __ for / and _ for blanks."""
    settings = {"system/geometry/refinement": refinement, "system/discretisation/quadrature points": points,
                "time/step": 0.025, "time/end": 0.025 * steps, "output/checkpoint/every": 1000000}
    settings.update({path.replace("__", "/").replace("_", " "): value for path, value in more.items()})
    return settings


def cells(refinement):
    return 8 ** refinement


def unknowns(refinement):
    return 3 * (2 * 2 ** refinement + 1) ** 3
