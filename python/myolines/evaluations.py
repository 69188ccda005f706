# SPDX-License-Identifier: LGPL-2.1-or-later
"""Columns that runs of scenes give, for fits: several runs at a time, none twice."""

from __future__ import annotations

import hashlib
import json
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
from typing import IO, Any, Dict, List, NamedTuple, Optional, Tuple

from . import _core, errors, program
from .tables import Table

Wanted = Tuple[str, str]
"""Table and column."""


class Task(NamedTuple):
    """A run: a scene as XML, its name, values by their paths, columns that are wanted of it."""

    xml: str
    name: str
    settings: Tuple[Tuple[str, str], ...]
    wanted: Tuple[Wanted, ...]

    def key(self) -> str:
        """The same for equal tasks of one version of the library."""
        return hashlib.sha256(json.dumps([_core.versions(), self.xml, self.settings, self.wanted]).encode()).hexdigest()


class Result(NamedTuple):
    """Columns as they were wanted; or why there are none."""

    columns: Optional[List[List[float]]]
    failed: str = ""


def carry_out(task: Task, folder: str) -> Result:
    """Runs a task in this process. What is wrong with the scene is raised, a solve that fails is a result."""
    document = _core.Document(task.xml, task.name, ".")
    document.set(task.settings)
    try:
        _core.run(document, folder, False, True, True, None, "")
    except errors.SolveError as error:
        return Result(None, str(error))
    tables: Dict[str, Table] = {}
    columns = []
    for name, column in task.wanted:
        if name not in tables:
            tables[name] = Table.read(os.path.join(folder, name if name.endswith(".csv") else name + ".csv"))
        columns.append([float(number) for number in tables[name][column]])
    return Result(columns)


class _Worker:
    """A process that carries out tasks, one after the other."""

    def __init__(self) -> None:
        package = os.path.dirname(os.path.dirname(os.path.abspath(_core.__file__)))
        environment = program.environment()
        environment["PYTHONPATH"] = os.pathsep.join([package, *filter(None, [environment.get("PYTHONPATH")])])
        self._process = subprocess.Popen([sys.executable, "-c", "from myolines.evaluations import serve; serve()"], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, text=True, env=environment, start_new_session=True)

    def carry_out(self, task: Task, folder: str) -> Result:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None and stdout is not None
        stdin.write(json.dumps([task, folder]) + "\n")
        stdin.flush()
        line = stdout.readline()
        if not line:
            raise errors.SystemRefused(f"a process for runs has ended with the code {self._process.wait()}")
        reply = json.loads(line)
        if "error" in reply:
            problems = [errors.Problem(*problem) for problem in reply["problems"]]
            raise errors.InputError(reply["error"], problems) if problems else errors.SystemRefused(reply["error"])
        return Result(*reply["result"])

    def end(self) -> None:
        self._process.terminate()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            stream.close()


class Evaluations:
    """Carries out tasks, `jobs` at a time (1: in this process), and keeps their results, in a file of the folder if there is one."""

    def __init__(self, folder: Optional[str], jobs: int):
        self._jobs = jobs
        # In memory where there is such a place: a run waits for the disk several times.
        self._scratch = tempfile.mkdtemp(prefix="myolines-fit-", dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        self._workers: List[_Worker] = []
        self._known: Dict[str, Result] = {}
        self._file: Optional[IO[str]] = None
        self.runs = 0
        """How many were carried out."""
        if folder is not None:
            self._open(os.path.join(folder, "evaluations.jsonl"))

    def _open(self, name: str) -> None:
        if os.path.exists(name):
            with open(name, encoding="utf-8") as stream:
                for line in stream:
                    if line.endswith("\n"):  # else it was not finished
                        entry = json.loads(line)
                        self._known[entry["key"]] = Result(entry["columns"], entry["failed"])
        self._file = open(name, "a", encoding="utf-8")

    def __enter__(self) -> "Evaluations":
        return self

    def __exit__(self, *_: Any) -> None:
        for worker in self._workers:
            worker.end()
        if self._file is not None:
            self._file.close()
        shutil.rmtree(self._scratch, ignore_errors=True)

    def results(self, tasks: List[Task]) -> List[Result]:
        """The results of tasks, in their order."""
        keys = [task.key() for task in tasks]
        new = {key: task for key, task in zip(keys, tasks) if key not in self._known}
        if self._jobs == 1:
            for key, task in new.items():
                self._keep(key, carry_out(task, self._place(key)))
        elif new:
            self._share_out(new)
        return [self._known[key] for key in keys]

    def _place(self, key: str) -> str:
        return os.path.join(self._scratch, key[:16])

    def _keep(self, key: str, result: Result) -> None:
        self._known[key] = result
        self.runs += 1
        shutil.rmtree(self._place(key), ignore_errors=True)
        if self._file is not None:
            self._file.write(json.dumps({"key": key, "columns": result.columns, "failed": result.failed}) + "\n")
            self._file.flush()

    def _share_out(self, tasks: Dict[str, Task]) -> None:
        while len(self._workers) < min(self._jobs, len(tasks)):
            self._workers.append(_Worker())
        waiting: "queue.SimpleQueue[Tuple[str, Task]]" = queue.SimpleQueue()
        for item in tasks.items():
            waiting.put(item)
        done: "queue.SimpleQueue[Tuple[str, Any]]" = queue.SimpleQueue()
        stop = threading.Event()

        def work(worker: _Worker) -> None:
            while not stop.is_set():
                try:
                    key, task = waiting.get_nowait()
                except queue.Empty:
                    return
                try:
                    done.put((key, worker.carry_out(task, self._place(key))))
                except BaseException as error:  # pylint: disable=broad-except
                    done.put((key, error))

        threads = [threading.Thread(target=work, args=(worker,), daemon=True) for worker in self._workers]
        for thread in threads:
            thread.start()
        try:
            for _ in tasks:
                key, result = done.get()
                if isinstance(result, BaseException):
                    raise result
                self._keep(key, result)
        finally:
            stop.set()


def serve() -> None:
    """Tasks on standard input, a line each; results on standard output."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what else is printed does not come between
    for line in sys.stdin:
        (xml, name, settings, wanted), folder = json.loads(line)
        task = Task(xml, name, tuple((path, text) for path, text in settings), tuple((table, column) for table, column in wanted))
        try:
            reply: Dict[str, Any] = {"result": carry_out(task, folder)}
        except errors.InputError as error:
            reply = {"error": str(error), "problems": error.problems}
        except Exception as error:  # pylint: disable=broad-except
            reply = {"error": str(error), "problems": []}
        out.write(json.dumps(reply) + "\n")
        out.flush()
