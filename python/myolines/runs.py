# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs and studies, and their results."""

from __future__ import annotations

import base64
import glob
import html
import json
import os
import sys
import tempfile
import time
from typing import Any, Callable, Dict, Iterator, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _core, program
from .scenes import Path, Scene, tell
from .tables import Table

Progress = Callable[[float, int], None]


class Picture:
    """A picture that notebooks show, and the file it is in."""

    def __init__(self, file: str):
        self.file = file

    def _repr_png_(self) -> Optional[bytes]:
        return self._bytes() if self.file.endswith(".png") else None

    def _repr_svg_(self) -> Optional[str]:
        return self._bytes().decode() if self.file.endswith(".svg") else None

    def _bytes(self) -> bytes:
        with open(self.file, "rb") as stream:
            return stream.read()

    def __repr__(self) -> str:
        return f"<Picture {self.file!r}>"


class Report:
    """A page about a run or a study that notebooks show, and the file it is in."""

    def __init__(self, file: str):
        self.file = file

    def _repr_html_(self) -> str:
        with open(self.file, "rb") as stream:
            page = base64.b64encode(stream.read()).decode()
        return f"<iframe style='width:100%;height:40em;border:0' src='data:text/html;base64,{page}'></iframe>"

    def __repr__(self) -> str:
        return f"<Report {self.file!r}>"


class Fields(NamedTuple):
    """A body at one instant: hexahedra that share no points, into which cells of higher order are cut, or the faces of its surface."""

    t: float
    """[s]"""
    rest: np.ndarray
    """Places of the points at rest [m], (points, 3)."""
    now: np.ndarray
    """Places of the points at t [m]."""
    cells: np.ndarray
    """Points of each cell, (cells, 8), x fastest."""
    faces: np.ndarray
    """Points of each face, (faces, 4), counter-clockwise seen from outside, of a run with "surface only"; else none."""
    fields: Dict[str, np.ndarray]
    """Name to values at the points, (points,) or (points, 3)."""


class Tables(Mapping[str, Table]):
    """The tables of a folder by name, with or without ".csv"; each is read when it is asked for."""

    def __init__(self, folder: str):
        self._folder = folder

    def __getitem__(self, name: str) -> Table:
        file = name if name.endswith(".csv") else name + ".csv"
        if file not in list(self):
            hint = _core.nearest_hint(name, [*self, *(known[:-4] for known in self)], "nearest")
            _core.refuse(self._folder, f'no table "{name}"', "one of " + ", ".join(self), hint)
        return Table.read(os.path.join(self._folder, file))

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(os.path.basename(file) for file in glob.glob(os.path.join(glob.escape(self._folder), "*.csv"))))

    def __len__(self) -> int:
        return len(list(iter(self)))


class _Results:
    """A folder of results."""

    def __init__(self, folder: Path):
        self.folder = os.fspath(folder)
        if not os.path.isdir(self.folder):
            _core.refuse(self.folder, "there is no such folder", "the folder of a run or of a study")

    @property
    def tables(self) -> Tables:
        """Tables by name: run.tables["steps"]["dt"]."""
        return Tables(self.folder)

    def __getitem__(self, name: str) -> Table:
        return self.tables[name]

    def report(self, out: Optional[Path] = None) -> Report:
        """One page that tells all; into the folder unless another file is named."""
        file = os.path.join(self.folder, "report.html") if out is None else os.fspath(out)
        _core.report(self.folder, file)
        return Report(file)

    def _json(self, name: str) -> Dict[str, Any]:
        with open(os.path.join(self.folder, name), encoding="utf-8") as stream:
            return dict(json.load(stream))

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.folder!r}: {', '.join(self.tables)}>"

    def _repr_html_(self) -> str:
        items = "".join(f"<li>{html.escape(repr(table))}</li>" for table in self.tables.values())
        return f"<b>{html.escape(self.folder)}</b><ul>{items}</ul>"


class Run(_Results):
    """The results of a run in a folder, whoever made them."""

    @property
    def manifest(self) -> Dict[str, Any]:
        """What was run, with what, and how it ended."""
        return self._json("manifest.json")

    @property
    def ledger(self) -> Dict[str, Any]:
        """Counts of work and seconds by phase."""
        return self._json("ledger.json")

    @property
    def done(self) -> bool:
        """Whether it came to its end."""
        return bool(self.manifest["exit reason"] == "done")

    @property
    def warnings(self) -> "list[str]":
        """What one should know before trusting the results."""
        return list(self.manifest["warnings"])

    @property
    def scene(self) -> Scene:
        """The scene with every value in force."""
        return Scene(os.path.join(self.folder, "scene.resolved.xml"))

    @property
    def field_times(self) -> np.ndarray:
        """When fields were written [s]. Raises InputError if none were."""
        return np.array(_core.RunFields(self.folder).times)

    def fields(self, at: float) -> Fields:
        """The fields of the instant that is nearest to a time [s]."""
        files = _core.RunFields(self.folder)
        return Fields(**files.read(files.nearest(at)))

    def picture(self, field: str = "", at: Optional[float] = None, fibres: int = 0, cut: str = "", view: Sequence[float] = (),
                colours: Sequence[float] = (), width: int = 1200) -> Picture:
        """The body at a time [s], the last one unless given: `myolines picture`, whose options these are (doc/pictures.md)."""
        instant = float(self.field_times[-1]) if at is None else float(at)
        folder = os.path.join(self.folder, "pictures")
        before = set(glob.glob(os.path.join(glob.escape(folder), "*.png")))
        begin = time.time() - 1
        _core.picture([self.folder], folder, field, [instant], fibres, cut, list(view), list(colours), width)
        drawn = [file for file in glob.glob(os.path.join(glob.escape(folder), "*.png")) if file not in before or os.path.getmtime(file) >= begin]
        return Picture(max(drawn, key=os.path.getmtime))


class Study(_Results):
    """The results of a study in a folder."""

    @property
    def table(self) -> Table:
        """A row for every case: what varies, what was measured."""
        return self.tables["study"]


def run(scene: Union[Scene, Path], folder: Path, *, resume: bool = False, overwrite: bool = False,
        progress: Union[bool, Progress] = False, instruction_set: str = "") -> Run:
    """Runs a scene to its end; what it writes goes into the folder.

    progress         True shows how far it is; a function gets time [s] and number of accepted steps
    resume           goes on from what the folder has, a run that was stopped or one whose end is later now
    overwrite        results of other scenes in the folder go

    Ctrl-C ends the run after its step (Interrupted): its state is saved. Raises InputError, SolveError, SystemRefused. On several ranks all of
    them call it.
    """
    scene = scene if isinstance(scene, Scene) else Scene(scene)
    shown = _Shown(scene["time/start"], scene["time/end"]) if progress is True else None
    call = shown if shown else progress if callable(progress) else None
    told = None if call is None else lambda t, step, accepted: call(t, step) if accepted else None
    try:
        _core.run(scene._document, os.fspath(folder), resume, overwrite, True, told, instruction_set)
    finally:
        if shown:
            shown.end()
    result = Run(folder)
    tell(scene, result.warnings)
    return result


def study(study: Path, folder: Path, *, overrides: Optional[Mapping[str, Any]] = None, jobs: int = 0, progress: bool = False,
          options: Sequence[str] = ()) -> Study:
    """Runs the cases of a study (doc/studies.md) that have not been run, in processes of the program; `jobs` at a time, 0: as many as fit.

    Interrupted, it goes on where it was when it is called again. On several ranks the first one runs it.
    """
    words = ["study", os.fspath(study), "--out", os.fspath(folder), *(["--jobs", str(jobs)] if jobs else []), *options]
    for path, value in (overrides or {}).items():
        words += ["--set", f"{path}={value}"]
    if _core.rank() == 0:
        program.call(words if progress else [*words, "--quiet"], quiet=not progress)
    _core.barrier()
    return Study(folder)


def picture_of_runs(runs: Sequence[Run], field: str = "", at: Optional[float] = None, width: int = 1200) -> Picture:
    """Bodies of several runs side by side."""
    folder = tempfile.mkdtemp(prefix="myolines-")
    _core.picture([run.folder for run in runs], folder, field, [] if at is None else [float(at)], 0, "", [], [], width)
    return Picture(sorted(glob.glob(os.path.join(folder, "*.png")))[-1])


class _Shown:
    """A line that tells how far a run is."""

    def __init__(self, start: float, end: float):
        self._start, self._end, self._last = start, end, 0.0

    def __call__(self, t: float, steps: int) -> None:
        now = time.monotonic()
        if now - self._last > 0.2:
            self._last = now
            part = (t - self._start) / (self._end - self._start)
            sys.stderr.write(f"\r{100 * part:5.1f} %  t = {t:.6g} s  {steps} steps ")
            sys.stderr.flush()

    def end(self) -> None:
        sys.stderr.write("\n")
