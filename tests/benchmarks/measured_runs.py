# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that may fail or take too long, and what they took: shared by the scripts of this folder that compare methods."""

import csv
import json
import os
import re
import signal
import subprocess
import time

from block import ENVIRONMENT, run_command


class MeasuredRun:
    """What a run left in `folder`, finished or not."""

    def __init__(self, folder, code, text, cpu):
        self.folder, self.cpu = folder, cpu
        self.finished = code == 0
        self.counts, self.reason = {}, text
        if os.path.exists(os.path.join(folder, "ledger.json")):
            with open(os.path.join(folder, "ledger.json")) as file:
                self.counts = json.load(file)["counts"]
            with open(os.path.join(folder, "manifest.json")) as file:
                self.reason = json.load(file)["exit reason"]

    def count(self, what):
        return self.counts.get(what, 0)

    @property
    def accepted(self):
        return self.count("accepted steps")

    @property
    def rejected(self):
        """Steps whose error was too large or whose solve failed."""
        return self.count("rejected steps") + self.count("nonlinear convergence failures")

    def rows(self, name):
        """Numbers of a series, without its head."""
        with open(os.path.join(self.folder, name), newline="") as file:
            return [[float(entry) for entry in row] for row in list(csv.reader(file))[1:]]

    def last_time(self):
        """End of the last accepted step that run.log tells of."""
        with open(os.path.join(self.folder, "run.log")) as file:
            times = re.findall(r"^step \d+  t (\S+) s", file.read(), re.MULTILINE)
        return float(times[-1]) if times else 0.0


def cpu_seconds(pid):
    """User time of a running process."""
    with open(f"/proc/{pid}/stat") as file:
        return int(file.read().rsplit(")", 1)[1].split()[11]) / os.sysconf("SC_CLK_TCK")


def measured_run(program, scene, settings, folder, limit=float("inf")):
    """Runs `scene` with overrides {path: value}; asks it to stop after `limit` seconds of user time."""
    command = run_command(program, scene, settings, folder)
    log = folder + ".err"
    with open(log, "w") as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors, env=ENVIRONMENT)
        asked = False
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid != 0:
                break
            if not asked and cpu_seconds(process.pid) > limit:
                process.send_signal(signal.SIGTERM)
                asked = True
            time.sleep(0.02)
    process.returncode = os.waitstatus_to_exitcode(status)
    with open(log) as errors:
        text = errors.read().strip()
    if process.returncode not in (0, 3):
        raise RuntimeError(f"exit code {process.returncode}: {' '.join(command)}\n{text}")
    run = MeasuredRun(folder, process.returncode, text, usage.ru_utime)
    if asked and not run.finished:
        run.reason = f"after {limit:g} s of CPU at t = {run.last_time():.3g} s"
    return run
