# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes that are advanced step by step, looked at and steered in between."""

from __future__ import annotations

import os
from typing import Any, Callable, Dict, Optional, Sequence, Union

import numpy as np

from . import _core
from .scenes import Path, Scene, tell
from .systems import System
from .tables import split_column

Course = Any
"""A function of time that a drive follows: of course() or samples()."""


def course(value: Callable[[float], float], first: Optional[Callable[[float], float]] = None,
           second: Optional[Callable[[float], float]] = None, kinks: Sequence[float] = ()) -> Course:
    """A drive from functions of time [s]: the value and, which motions need, its first and second derivative. `kinks` are all times at which
    one of them jumps: steps end there. At a kink the functions are asked just before, or just behind it."""

    def sided(function: Optional[Callable[[float], float]]) -> Optional[Callable[[float, str], float]]:
        if function is None:
            return None
        known = function
        if not kinks:
            return lambda t, side: float(known(t))
        places = np.asarray(kinks, dtype=float)

        def value_of_side(t: float, side: str) -> float:
            near = np.abs(places - t) <= 1e-12 * max(1.0, abs(t))
            if near.any():
                t = float(np.nextafter(places[near][0], -np.inf if side == "left" else np.inf))
            return float(known(t))

        return value_of_side

    return _core.course(sided(value), sided(first), sided(second), [float(t) for t in kinks])


def samples(t: Sequence[float], x: Sequence[float], between: str = "monotone") -> Course:
    """A drive through samples x at ascending times t [s]: "monotone" leaves no bounds that the samples keep, a "spline" is smoother, of
    "lines" every sample is a kink."""
    return _core.sampled(np.asarray(t, dtype=float), np.asarray(x, dtype=float), between)


class Simulation:
    """A scene in hand: Simulation(scene) begins at time/start, with the state of the scene.

        simulation = myolines.Simulation(scene)
        while simulation.t < 1:
            force = simulation.measure("tendon force/F0")
            simulation.set("system/input/excitation", 0.5 if force < 0.2 else 0.1)
            simulation.advance(0.005)

    Drives of type "steered" are what set(), ramp() and follow() change: activation, excitation, forces, motions. What is set holds from the
    present time on, which is a kink: steps end there, and the integrator starts anew. Steps are those of the scene, shorter where advance()
    ends between two of them; steps that fail are repeated as the scene says. Not steered, and advanced from one planned step to another,
    it is bit-equal to the run. Nothing is written. Several may live at a time; on several ranks all call alike.
    """

    def __init__(self, scene: Union[Scene, Path], values: Optional[Dict[str, Any]] = None):
        scene = scene if isinstance(scene, Scene) else Scene(scene)
        self.scene = scene.with_values(values) if values else scene.copy()
        self._core = _core.Simulation(self.scene._document)
        tell(self.scene, self._core.warnings)

    @property
    def t(self) -> float:
        """Present time [s]."""
        return float(self._core.t)

    @property
    def end(self) -> float:
        """time/end, beyond which it does not go [s]."""
        return float(self._core.end)

    @property
    def u(self) -> np.ndarray:
        """Displacements [m], a copy: those of the unknowns that this rank owns."""
        return self._core.u

    @property
    def v(self) -> np.ndarray:
        """Velocities [m/s]."""
        return self._core.v

    @property
    def a(self) -> np.ndarray:
        """Accelerations [m/s^2]."""
        return self._core.a

    @property
    def steps(self) -> int:
        """Steps that were accepted."""
        return int(self._core.steps)

    @property
    def last_step(self) -> Dict[str, Any]:
        """Size and cost of the last one."""
        return dict(self._core.last_step)

    @property
    def counts(self) -> Dict[str, int]:
        """Work so far: residual evaluations, Newton iterations, ..."""
        return dict(self._core.counts)

    @property
    def system(self) -> System:
        """Its system as operators, at any state."""
        return System(_core_system=self._core.system())

    def advance_to(self, t: float, control: Optional[Callable[["Simulation"], None]] = None, every: Optional[float] = None) -> "Simulation":
        """Advances to t [s] exactly. `control` is called with this simulation at the beginning and after every interval `every` [s], which is
        time/step unless given; what it sets holds until the next call. Ctrl-C ends it after its step."""
        if control is None:
            self._core.advance_to(t)
            return self
        interval = every if every is not None else self.scene["time/step"]
        if interval is None:
            _core.refuse("every", "a controller has no interval, and the scene no \"time/step\"", "an interval [s]")
        begin, number, advance = self.t, 0, self._core.advance_to
        now = begin
        while now < t:
            control(self)
            number += 1
            now = begin + number * interval
            if now > t - 1e-9 * interval:
                now = t
            advance(now)
        return self

    def advance(self, dt: float, control: Optional[Callable[["Simulation"], None]] = None, every: Optional[float] = None) -> "Simulation":
        """advance_to() the present time and dt [s]."""
        return self.advance_to(self.t + dt, control, every)

    @property
    def steered(self) -> Dict[str, str]:
        """What can be set: paths and units."""
        return dict(self._core.steered)

    def set(self, path: str, value: float) -> None:
        """The drive at a path has this value from now on. Before the first step: from the beginning. A motion that jumps is an impact."""
        self._core.steer(path, value, 0.0)

    def ramp(self, path: str, value: float, over: float) -> None:
        """The drive goes linearly to a value, within a time [s] from now, and stays there."""
        self._core.steer(path, value, over)

    def follow(self, path: str, course: Course) -> None:
        """The drive follows course() or samples(), functions of the time of the simulation, from now on."""
        self._core.follow(path, course)

    def value_of(self, path: str) -> float:
        """What the drive at a path has from now on."""
        return float(self._core.steered_value(path))

    def measures(self) -> Dict[str, Dict[str, float]]:
        """What the tables of a run would say of the present state: table to column to number. The scene's list `output` chooses. At a time
        at which something was set, it is what was before."""
        return self._core.measure()

    def measure(self, name: str, table: str = "") -> float:
        """One of these numbers: measure("tendon force/F0"), measure("Force [N]", "reactions")."""
        found = {}
        for file, columns in self._core.measure().items():
            if table in ("", file, file[:-4]):
                if name in columns:
                    return float(columns[name])
                found.update({split_column(column)[0]: number for column, number in columns.items()})
        if name not in found:
            _core.refuse("measure", f'there is no column "{name}"', "one of " + ", ".join(found), _core.nearest_hint(name, list(found), "nearest"))
        return float(found[name])

    def save(self, file: Optional[Path] = None) -> Any:
        """A moment to come back to, with all that is steered; into a file, which has nothing of that, if one is named."""
        if file is None:
            return self._core.save()
        self._core.save_file(os.path.abspath(os.fspath(file)))
        return None

    def restore(self, moment: Any) -> "Simulation":
        """Goes back to what save() gave, or on from its file."""
        if isinstance(moment, (str, os.PathLike)):
            self._core.restore_file(os.path.abspath(os.fspath(moment)))
        else:
            self._core.restore(moment)
        return self

    def __repr__(self) -> str:
        return f"<Simulation of {self.scene.name!r} at t = {self.t:g} s, {self.steps} steps>"


