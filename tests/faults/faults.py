#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whatever the system refuses, and whenever a process is killed, nothing is lost: faults.py PROGRAM SCRATCH_FOLDER
[--scenario NAME]... [--every N] [--kills N] [--seed S]

Each scenario is a command that writes. Of every call in it that opens, writes, cuts, moves, removes, syncs or closes a file one fails, in a
new process each: with EIO; with ENOSPC, from then on, where it needs room; with EACCES where names matter; and the process is killed there.
With --every N these are every N-th call only, others in each kind. Then as many processes as --kills says are killed after times drawn at
random. Afterwards

- the exit code is 4 and the message has the reason of the system; or 2 where a file of the user cannot be read or a name not be used;
  or the process was killed; or, where the fault changes nothing that anyone reads, 0 with the right results;
- all files can be read: tables have whole rows, the manifest is one and gives the reason, lists of fields are well formed;
- the command with --resume, or the same again where there is no state yet, ends with 0 and leaves the tables that a run leaves that nothing
  has disturbed, byte by byte.
"""

import argparse
import contextlib
import csv
import errno
import json
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import sys
import tempfile
import time
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from command_server import CommandServer  # noqa: E402

OSCILLATOR = """<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="oscillator"/>
    <Parameter name="cubic stiffness" type="double" value="10"/>
    <ParameterList name="force">
      <Parameter name="type" type="string" value="control points"/>
      <Parameter name="file" type="string" value="force.dat"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="sdirk2"/></ParameterList>
  <ParameterList name="time"><Parameter name="end" type="double" value="0.6"/><Parameter name="step" type="double" value="0.1"/></ParameterList>
  <ParameterList name="output">
    <ParameterList name="motion"><Parameter name="interval" type="double" value="0.15"/></ParameterList>
    <ParameterList name="checkpoint">
      <Parameter name="every" type="int" value="2"/><Parameter name="seconds" type="double" value="0"/>
      <ParameterList name="keep"><Parameter name="every" type="int" value="3"/></ParameterList>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""

MUSCLE = """<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="muscle 3d"/>
    <ParameterList name="geometry"><Parameter name="refinement" type="int" value="0"/></ParameterList>
    <ParameterList name="boundary">
      <ParameterList name="pulled"><Parameter name="face" type="string" value="x+"/><Parameter name="type" type="string" value="strain"/>
        <ParameterList name="strain"><Parameter name="type" type="string" value="control points"/>
          <Parameter name="points" type="string" value="0 0; 0.04 0.01"/></ParameterList></ParameterList>
      <ParameterList name="fixed"><Parameter name="face" type="string" value="x-"/><Parameter name="type" type="string" value="fixed"/></ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="sdirk2"/></ParameterList>
  <ParameterList name="time"><Parameter name="end" type="double" value="0.04"/><Parameter name="step" type="double" value="0.01"/></ParameterList>
  <ParameterList name="output">
    <ParameterList name="series"><Parameter name="all faces" type="bool" value="true"/></ParameterList>
    <ParameterList name="fields"><Parameter name="every" type="int" value="2"/></ParameterList>
    <ParameterList name="quadrature"><Parameter name="every" type="int" value="2"/></ParameterList>
    <ParameterList name="checkpoint"><Parameter name="every" type="int" value="2"/><Parameter name="seconds" type="double" value="0"/></ParameterList>
  </ParameterList>
</ParameterList>
"""

STUDY = """<ParameterList name="study">
  <Parameter name="scene" type="string" value="scene.xml"/>
  <ParameterList name="grids"><ParameterList name="all"><ParameterList name="step">
    <Parameter name="type" type="string" value="list"/><Parameter name="parameter" type="string" value="time/step"/>
    <Parameter name="values" type="string" value="0.1 | 0.05"/>
  </ParameterList></ParameterList></ParameterList>
  <ParameterList name="quantities"><ParameterList name="end">
    <Parameter name="type" type="string" value="column"/><Parameter name="file" type="string" value="trajectory.csv"/>
    <Parameter name="column" type="string" value="Displacement [m]"/><Parameter name="measure" type="string" value="final"/>
  </ParameterList></ParameterList>
</ParameterList>
"""

NEEDS_ROOM = ("open", "write", "sync", "rename", "mkdir", "close")
OF_NAMES = ("open", "read", "rename", "remove", "mkdir")


def resolved_scene(folder):
    file = folder / "out" / "scene.resolved.xml"
    return file.read_bytes() if file.exists() else b""


class Scenario:
    """A command, what has to be there before, how to go on after a fault, and where the results are."""

    def __init__(self, name, files, command, before=(), is_study=False):
        self.name, self.files, self.command, self.before, self.is_study = name, files, command, before, is_study

    def again(self, folder, resolved):
        """What a person would do: where the folder still has the state of another run, before this one, the same command."""
        words = [word for word in self.command if word not in ("--overwrite", "--resume")]
        if self.is_study:
            return words + ["--retry"]
        if not (folder / "out" / "checkpoint").exists():
            return words
        return words + ["--resume"] if resolved_scene(folder) == resolved or "--resume" in self.command else self.command


def scenarios():
    files = {"scene.xml": OSCILLATOR, "force.dat": "0 0\n0.25 1\n0.5 1\n"}
    run = ["run", "scene.xml", "--out", "out", "--quiet"]
    yield Scenario("run", files, run)
    yield Scenario("resume", files, run + ["--resume"], [run + ["--set", "time/end=0.3"]])
    yield Scenario("overwrite", files, run + ["--overwrite"], [run + ["--set", "time/end=0.3", "--set", "time/start=-0.1"]])
    yield Scenario("aside", files, run, [run + ["--set", "system/mass=3"]])
    yield Scenario("study", dict(files, **{"study.xml": STUDY}), ["study", "study.xml", "--out", "out", "--quiet", "--jobs", "1"], is_study=True)
    yield Scenario("muscle", {"scene.xml": MUSCLE}, run)
    yield Scenario("muscle hdf5", {"scene.xml": MUSCLE}, run + ["--set", "output/fields/format=hdf5", "--set", "output/quadrature/format=flexodeal"])


class Wrong(Exception):
    pass


def tables(folder):
    """All tables of numbers that depend on the scene alone."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted((folder / "out").rglob("*.csv"))
            if file.name != "seconds.csv" and not any(part.startswith("earlier-") for part in file.parts)}


def require_readable(folder, killed):
    out = folder / "out"
    for file in out.rglob("*"):
        if not file.is_file() or file.suffix == ".new":
            continue
        if file.suffix == ".csv" and not killed:
            text = file.read_text()
            rows = list(csv.reader(text.splitlines()))
            if (text and not text.endswith("\n")) or any(len(row) != len(rows[0]) for row in rows):
                raise Wrong(f"{file.name} has half a row")
        if file.name in ("manifest.json", "ledger.json"):
            json.loads(file.read_text())
        if file.suffix in (".pvd", ".xdmf", ".xml", ".vtu", ".pvtu"):
            xml.etree.ElementTree.fromstring(file.read_bytes())


class Tester:
    def __init__(self, program, scenario, scratch, reference=None):
        self.server = CommandServer(program, *([] if scenario.is_study else ["started"]))
        self.scenario, self.scratch = scenario, scratch
        self.folder = scratch / "work"
        self.prepared = scratch / "prepared"
        for path in (self.folder, self.prepared):
            shutil.rmtree(path, ignore_errors=True)
        self.folder.mkdir(parents=True)
        for name, text in scenario.files.items():
            (self.folder / name).write_text(text)
        for command in scenario.before:
            if self.ask(self.folder, command) != 0:
                sys.exit(f"{scenario.name}: cannot prepare: {(self.folder / 'err.txt').read_text()}")
        self.folder.rename(self.prepared)  # and back at every begin: scenes know their files by absolute paths
        self.renew()
        begin = time.time()
        if self.ask(self.folder, scenario.command) != 0:
            sys.exit(f"{scenario.name}: {(self.folder / 'err.txt').read_text()}")
        self.seconds = time.time() - begin
        self.calls = [line.split(" ", 1) for line in (self.folder / "calls.txt").read_text().splitlines()]
        self.tables = tables(self.folder)
        self.resolved = resolved_scene(self.folder)

    def ask(self, folder, command, at=0, error=0, lasting=False, killed_after=0):
        return self.server.ask(at, error, "lasting" if lasting else "once", int(1e6 * killed_after), folder, *command)

    def renew(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.prepared, self.folder)

    def faults(self):
        """(number of the call, errno or 0)."""
        for i, (call, _) in enumerate(self.calls):
            yield i + 1, 0
            yield i + 1, errno.EIO
            if call in NEEDS_ROOM:
                yield i + 1, errno.ENOSPC
            if call in OF_NAMES:
                yield i + 1, errno.EACCES

    def inject(self, at, error):
        self.renew()
        status = self.ask(self.folder, self.scenario.command, at, error, error == errno.ENOSPC)
        message = (self.folder / "err.txt").read_text(errors="replace")
        self.require_end(status, error, self.calls[at - 1][0] if at <= len(self.calls) else "", message)
        self.require_rest(error == 0)

    def kill(self, after):
        self.renew()
        status = self.ask(self.folder, self.scenario.command, killed_after=after)
        if status not in (0, signal.SIGKILL):
            raise Wrong(f"status {status}")
        self.require_rest(True)

    def a_case_tells(self, error):
        """Whether the database of the study has a case that was killed, or ended with the reason of the system."""
        with contextlib.closing(sqlite3.connect(self.folder / "out" / "study.sqlite")) as database:
            reasons = [reason for reason, in database.execute("SELECT reason FROM cases WHERE status != 'done'")]
        return any(error == 0 or os.strerror(error) in reason for reason in reasons)

    def require_end(self, status, error, call, message):
        """Exit codes; in a study it may be a case that ended so."""
        code = os.waitstatus_to_exitcode(status)
        if code == 0 and (tables(self.folder) == self.tables or (self.scenario.is_study and self.a_case_tells(error))):
            return
        if error == 0:
            if code != -signal.SIGKILL:
                raise Wrong(f"exit code {code} instead of a kill: {message}")
            return
        of_user = call == "read" or (error == errno.EACCES and call in OF_NAMES)
        if code != 4 and not (code == 2 and of_user):
            raise Wrong(f"exit code {code}: {message}")
        if os.strerror(error) not in message:
            raise Wrong(f"the message does not give the reason: {message}")

    def require_rest(self, killed):
        require_readable(self.folder, killed)
        manifest = self.folder / "out" / "manifest.json"
        if manifest.exists() and not killed and not self.scenario.before:
            reason = json.loads(manifest.read_text())["exit reason"]
            if reason not in ("running", "done") and "the system refused" not in reason:
                raise Wrong(f"the manifest has the reason {reason}")
        command = self.scenario.again(self.folder, self.resolved)
        code = os.waitstatus_to_exitcode(self.ask(self.folder, command))
        if code != 0:
            raise Wrong(f"{command} ends with {code}: {(self.folder / 'err.txt').read_text(errors='replace')}")
        if tables(self.folder) != self.tables:
            now = tables(self.folder)
            differ = sorted(name for name in set(now) | set(self.tables) if now.get(name) != self.tables.get(name))
            raise Wrong(f"{command} leaves other tables: {differ}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--scenario", action="append", help="only this one; may be repeated")
    parser.add_argument("--every", type=int, default=1, help="only every N-th fault")
    parser.add_argument("--kills", type=int, default=0, help="at random instants, of each scenario")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    kept = arguments.scratch.resolve()
    shutil.rmtree(kept, ignore_errors=True)
    kept.mkdir(parents=True)
    wrong = 0
    in_memory = pathlib.Path("/dev/shm")
    with tempfile.TemporaryDirectory(prefix="myolines_faults_", dir=in_memory if os.access(in_memory, os.W_OK) else kept) as scratch:
        for scenario in scenarios():
            if arguments.scenario and scenario.name not in arguments.scenario:
                continue
            begin = time.time()
            tester = Tester(arguments.program, scenario, pathlib.Path(scratch).resolve())
            generator = random.Random(f"{scenario.name} {arguments.seed}")
            faults = list(tester.faults())[arguments.seed % arguments.every::arguments.every]
            trials = [(f"{tester.calls[at - 1]} (call {at}) {errno.errorcode.get(error, 'killed')}", tester.inject, (at, error)) for at, error in faults]
            trials += [(f"killed after {after:.4f} s", tester.kill, (after,))
                       for after in (generator.uniform(0, 1.1 * tester.seconds) for _ in range(arguments.kills))]
            bad = 0
            for what, action, values in trials:
                try:
                    action(*values)
                except (Wrong, ValueError, xml.etree.ElementTree.ParseError) as error:
                    bad += 1
                    folder = kept / f"{scenario.name}-{bad}".replace(" ", "-")
                    shutil.copytree(tester.folder, folder)
                    print(f"WRONG {scenario.name}: {what}: {error}\n  {folder}", flush=True)
            tester.server.close()
            wrong += bad
            print(f"{scenario.name}: {len(tester.calls)} calls, {len(faults)} faults, {arguments.kills} kills, {bad} wrong, "
                  f"{time.time() - begin:.0f} s", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
