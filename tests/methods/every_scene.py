#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every method in every shipped scene: `--set integrator/type=X` runs, or is refused with a reason before anything is computed.

every_scene.py PROGRAM WORK_FOLDER [--limit 60] [--coarse] [--scene NAME ...] [--method NAME ...]

Each scene of input/ is run with each method for two of its steps. What must come out of it is exit code 0 with a step, or exit code 2 with what, where,
what was expected, and no output folder. A run that computes for longer than the limit [s] is asked to stop ("runs on", or "no step yet").
With --coarse, bodies that the program makes itself are not refined: a tenth of the time. Prints a line for each pair and the refusals, each once.
Exit code 1 if anything else happens.
"""

import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

INPUT = pathlib.Path(__file__).resolve().parent.parent.parent / "input"


def shipped_scenes():
    for path in sorted(INPUT.rglob("*.xml")):
        if xml.parse(path).getroot().get("name") == "scene":
            yield path


def methods(program):
    lines = subprocess.run([program, "list", "integrators"], capture_output=True, text=True, check=True).stdout.splitlines()
    return [line for line in lines if line and not line.startswith(" ")]


def two_steps(scene):
    """Overrides that end a scene after two of its first steps."""
    time = {p.get("name"): p.get("value") for p in xml.parse(scene).getroot().find("./ParameterList[@name='time']").findall("Parameter")}
    start = float(time.get("start", 0))
    if "steps" in time:
        size = float(re.match(r"\s*\d+ x ([^;\s]+)", time["steps"]).group(1))
        return [f"time/steps=2 x {size!r}", f"time/end={start + 2 * size!r}"]
    return [f"time/end={start + 2 * float(time['step'])!r}"]


def coarse(scene):
    """An override that leaves a body of the program's own shapes unrefined."""
    geometry = xml.parse(scene).getroot().find("./ParameterList[@name='system']/ParameterList[@name='geometry']")
    refined = geometry is not None and geometry.find("./Parameter[@name='refinement']") is not None
    return ["system/geometry/refinement=0"] if refined else []


def run(program, scene, method, overrides, folder, limit):
    """What came of it, in a word, and the text behind it."""
    shutil.rmtree(folder, ignore_errors=True)
    command = [program, "run", str(scene), "--quiet", "--out", str(folder)]
    for override in [f"integrator/type={method}", *two_steps(scene), *overrides]:
        command += ["--set", override]
    process = subprocess.run(command, capture_output=True, text=True, check=False,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, resource.RLIM_INFINITY)))
    text = process.stdout + process.stderr
    if process.returncode == 0:
        return "runs", text
    if process.returncode == 2 and not folder.exists():
        return "refused", text
    if process.returncode == 3 and "asked to stop" in text:
        return "runs on" if steps_taken(folder) > 0 else "no step yet", text
    return f"exit code {process.returncode}", text


def steps_taken(folder):
    lines = (folder / "steps.csv").read_text(encoding="utf-8").splitlines() if (folder / "steps.csv").exists() else []
    return max(len(lines) - 1, 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--limit", type=int, default=60)
    parser.add_argument("--coarse", action="store_true")
    parser.add_argument("--scene", action="append", help="part of its name")
    parser.add_argument("--method", action="append")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    options.work.mkdir(parents=True, exist_ok=True)

    wrong, refusals = [], {}
    for scene in shipped_scenes():
        name = str(scene.relative_to(INPUT))
        if options.scene and not any(part in name for part in options.scene):
            continue
        for method in options.method or methods(program):
            result, text = run(program, scene, method, coarse(scene) if options.coarse else [], options.work / "run", options.limit)
            print(f"{name:45} {method:28} {result}", flush=True)
            if result == "refused":
                refusals.setdefault(text.replace(str(scene), "SCENE"), []).append(f"{name}: {method}")
            elif result not in ("runs", "runs on", "no step yet"):
                wrong.append(f"{name}: {method}: {result}\n{text}")
    for text, pairs in refusals.items():
        print(f"\n{text.strip()}\n    " + "\n    ".join(pairs))
    for line in wrong:
        print("\nWRONG: " + line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
