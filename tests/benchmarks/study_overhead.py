#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `myolines study` costs beside the runs themselves: study_overhead.py PROGRAM [--cases 500] [--jobs 2] [--step 0.0005] [--rounds 1]

Runs as many free oscillations, each with a mass of its own, once as a study and once as a plain shell loop (xargs), with as many jobs at a
time. Prints CPU seconds of all processes and wall-clock seconds of both, their ratios, and what the study used beside its runs: its CPU seconds
less those that it has measured of each run. On a machine that does other work the latter is the figure to trust.
"""

import argparse
import csv
import os
import resource
import shlex
import subprocess
import tempfile
import time

from block import ENVIRONMENT, HERE

SCENE = os.path.join(HERE, "..", "..", "input", "oscillator.xml")

STUDY = """<ParameterList name="study">
  <Parameter name="scene" type="string" value="{scene}"/>
  <Parameter name="settings" type="string" value="time/step={step}"/>
  <ParameterList name="grids">
    <ParameterList name="all">
      <ParameterList name="mass">
        <Parameter name="type" type="string" value="range"/>
        <Parameter name="parameter" type="string" value="system/mass"/>
        <Parameter name="first" type="double" value="1"/>
        <Parameter name="last" type="double" value="2"/>
        <Parameter name="number" type="int" value="{cases}"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="quantities">
    <ParameterList name="end">
      <Parameter name="file" type="string" value="trajectory.csv"/>
      <Parameter name="column" type="string" value="Displacement [m]"/>
      <Parameter name="measure" type="string" value="final"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""


def measured(command, folder):
    """CPU seconds of @p command with all its children, and its wall-clock seconds."""

    def cpu():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before, begin = cpu(), time.monotonic()
    subprocess.run(command, cwd=folder, env=ENVIRONMENT, check=True, stdout=subprocess.DEVNULL)
    return cpu() - before, time.monotonic() - begin


def cpu_of_runs(folder):
    with open(os.path.join(folder, "study", "seconds.csv"), newline="") as file:
        return sum(float(row["CPU [s]"]) for row in csv.DictReader(file))


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program")
    arguments.add_argument("--cases", type=int, default=500)
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--step", default="0.0005", help="of the oscillations: how long a case takes [s]")
    arguments.add_argument("--rounds", type=int, default=1, help="of both, in turns first")
    given = arguments.parse_args()
    program = os.path.abspath(given.program)
    sums = {"study": [0.0, 0.0], "loop": [0.0, 0.0]}
    runs = 0.0  # CPU seconds of the runs of the studies
    for number in range(given.rounds):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "study.xml"), "w") as file:
                file.write(STUDY.format(scene=SCENE, step=given.step, cases=given.cases))
            masses = [1 + i / (given.cases - 1) for i in range(given.cases)]
            with open(os.path.join(folder, "masses"), "w") as file:
                file.writelines(f"{mass!r}\n" for mass in masses)
            loop = (f"xargs -a masses -P {given.jobs} -I MASS {shlex.quote(program)} run {shlex.quote(SCENE)} "
                    f"--set time/step={given.step} --set system/mass=MASS --out loop/MASS --quiet")
            commands = {
                "study": [program, "study", "study.xml", "--jobs", str(given.jobs), "--out", "study", "--quiet"],
                "loop": ["sh", "-c", loop],
            }
            for name in ("study", "loop") if number % 2 == 0 else ("loop", "study"):
                cpu, wall = measured(commands[name], folder)
                sums[name][0] += cpu
                sums[name][1] += wall
                runs += cpu_of_runs(folder) if name == "study" else 0
                print(f"{name}: {given.cases} cases, {cpu:.1f} CPU s, {wall:.1f} s of wall clock", flush=True)
    for index, what in enumerate(("CPU", "wall clock")):
        print(f"study over loop, {what}: {sums['study'][index] / sums['loop'][index]:.4f}")
    own = sums["study"][0] - runs
    print(f"the study beside its runs: {own:.2f} CPU s, {100 * own / runs:.2f} % of the {runs:.1f} of its runs")


if __name__ == "__main__":
    main()
