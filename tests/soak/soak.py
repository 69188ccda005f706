#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A long run takes no more memory and no more time per step at its end than at its beginning: soak.py PROGRAM SCRATCH_FOLDER
[--oscillator STEPS] [--block STEPS]

The oscillator by default takes 1,000,000 steps, a dynamic block of 64 quadratic cells 2,000; 0 leaves one out. While a run runs, its memory (resident set) and
its CPU time are noted with the steps done. Of what comes after the first fifth, memory may grow by 1 % and 1 MB, and the CPU time per step in the
last quarter may be 1.15 times that in the second.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time

PAGE = os.sysconf("SC_PAGE_SIZE")
TICK = os.sysconf("SC_CLK_TCK")

OSCILLATOR = """<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="oscillator"/>
    <Parameter name="cubic stiffness" type="double" value="10"/>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="generalized alpha"/></ParameterList>
  <ParameterList name="time"><Parameter name="end" type="double" value="1000"/><Parameter name="step" type="double" value="{step}"/></ParameterList>
  <ParameterList name="output">
    <ParameterList name="series"><Parameter name="every" type="int" value="100"/></ParameterList>
    <ParameterList name="checkpoint"><Parameter name="seconds" type="double" value="2"/></ParameterList>
  </ParameterList>
</ParameterList>
"""

BLOCK = """<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="muscle 3d"/>
    <Parameter name="inertia" type="string" value="dynamic"/>
    <ParameterList name="geometry"><Parameter name="refinement" type="int" value="2"/></ParameterList>
    <ParameterList name="activation"><Parameter name="type" type="string" value="ramp"/>
      <Parameter name="amplitude" type="double" value="0.5"/><Parameter name="duration" type="double" value="0.05"/></ParameterList>
    <ParameterList name="boundary">
      <ParameterList name="left"><Parameter name="face" type="string" value="x-"/><Parameter name="type" type="string" value="fixed"/></ParameterList>
      <ParameterList name="right"><Parameter name="face" type="string" value="x+"/><Parameter name="type" type="string" value="fixed"/></ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="generalized alpha"/></ParameterList>
  <ParameterList name="time"><Parameter name="end" type="double" value="2"/><Parameter name="step" type="double" value="{step}"/></ParameterList>
  <ParameterList name="output">
    <ParameterList name="checkpoint"><Parameter name="seconds" type="double" value="2"/></ParameterList>
  </ParameterList>
</ParameterList>
"""


def steps_done(table):
    """The number of the last whole row of steps.csv."""
    with open(table, "rb") as file:
        file.seek(max(0, os.path.getsize(table) - 4096))
        rows = file.read().split(b"\n")
    return int(rows[-2].split(b",")[0]) if len(rows) > 2 else 0


def sample(process, table):
    """(steps, memory [bytes], CPU time [s]), or None where the process has ended or not begun."""
    try:
        steps = steps_done(table)
        memory = int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * PAGE
        words = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (steps, memory, (int(words[11]) + int(words[12])) / TICK) if memory > 0 else None
    except (OSError, ValueError, IndexError):
        return None


def soak(program, folder, name, scene, end, steps):
    out = folder / name
    out.mkdir(parents=True)
    (out / "scene.xml").write_text(scene.format(step=end / steps))
    process = subprocess.Popen([program, "run", out / "scene.xml", "--out", out / "run", "--quiet"])
    samples = []
    while process.poll() is None:
        time.sleep(0.25)
        found = sample(process, out / "run" / "steps.csv")
        if found and found[0] > 0 and (not samples or found[0] > samples[-1][0]):
            samples.append(found)
    if process.returncode != 0:
        sys.exit(f"{name}: exit code {process.returncode}")
    done = samples[-1][0]
    if steps_done(out / "run" / "steps.csv") < steps or len(samples) < 20:
        sys.exit(f"{name}: {steps_done(out / 'run' / 'steps.csv')} steps, {len(samples)} samples")

    def at(part):
        return min(samples, key=lambda each: abs(each[0] - part * done))

    def per_step(begin, end):
        return (at(end)[2] - at(begin)[2]) / (at(end)[0] - at(begin)[0])

    early, late = at(0.2)[1], max(memory for steps_then, memory, _ in samples if steps_then > 0.2 * done)
    second, last = per_step(0.25, 0.5), per_step(0.75, 1)
    print(f"{name}: {steps} steps, {early / 1e6:.1f} MB after a fifth, {late / 1e6:.1f} MB at most afterwards; CPU time per step "
          f"{1e6 * second:.1f} us in the second quarter, {1e6 * last:.1f} us in the last", flush=True)
    return late <= 1.01 * early + 1e6 and last <= 1.15 * second


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--oscillator", type=int, default=1000000)
    parser.add_argument("--block", type=int, default=2000)
    arguments = parser.parse_args()
    shutil.rmtree(arguments.scratch, ignore_errors=True)
    flat = [soak(arguments.program.resolve(), arguments.scratch.resolve(), name, scene, end, steps)
            for name, scene, end, steps in (("oscillator", OSCILLATOR, 1000, arguments.oscillator), ("block", BLOCK, 2, arguments.block)) if steps > 0]
    return 0 if all(flat) else 1


if __name__ == "__main__":
    sys.exit(main())
