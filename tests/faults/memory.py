#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the system gives little memory the program does its work or says so, and comes to an end: memory.py PROGRAM SCENE SCRATCH_FOLDER
[--seconds N] [--from MB] [--by MB] [--limits N]

A short run of SCENE is done under limits on the addresses of a process (ulimit -v), each a step smaller than the last, down to where nothing
can be started any more. Exit code 0 with a manifest that says "done", 2 or 4 with a reason are right; a signal, another code or more than
so many seconds are not. Limits below what the libraries need before main() are not looked at.
"""

import argparse
import json
import pathlib
import resource
import shutil
import subprocess
import sys


def ended(program, scene, folder, megabytes, seconds):
    """(exit code or "hangs", what was said)"""
    shutil.rmtree(folder, ignore_errors=True)
    limit = megabytes << 20
    command = [program, "run", scene, "--out", folder, "--quiet", "--set", "time/end=0.02"]
    try:
        process = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=seconds, check=False,
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
    except subprocess.TimeoutExpired:
        return "hangs", ""
    return process.returncode, process.stdout + process.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--from", dest="largest", type=int, default=1000, metavar="MB")
    parser.add_argument("--by", type=int, default=50, metavar="MB")
    parser.add_argument("--limits", type=int, default=12)
    arguments = parser.parse_args()
    arguments.scratch.mkdir(parents=True, exist_ok=True)
    folder = arguments.scratch.resolve() / "run"
    wrong = 0
    for megabytes in range(arguments.largest, arguments.largest - arguments.by * arguments.limits, -arguments.by):
        code, text = ended(arguments.program.resolve(), arguments.scene.resolve(), folder, megabytes, arguments.seconds)
        if code == 127 or "cannot allocate memory in static TLS block" in text or "failed to map segment" in text:
            print(f"{megabytes} MB: the program cannot be loaded")
            break
        right = code in (2, 4) and text
        if code == 0:
            right = json.loads((folder / "manifest.json").read_text())["exit reason"] == "done"
        print(f"{megabytes} MB: {code} {text.strip().splitlines()[0][:120] if text.strip() else ''}{'' if right else '   WRONG'}", flush=True)
        wrong += not right
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
