# SPDX-License-Identifier: LGPL-2.1-or-later
"""Myolines: muscle dynamics by the method of lines, from Python.

    import myolines
    scene = myolines.Scene("input/oscillator.xml")
    scene["system/mass"] = 2
    run = myolines.run(scene, "results/oscillator")
    run["trajectory"]["Displacement"]

Scene         a scene: names, units, defaults and checks of the program
run, study    run it into a folder; Run, Study and Table read the results
Simulation    advances a scene step by step; drives of type "steered" are set in between
System        residual, matrices and solves, as arrays and operators of SciPy
Integrator    methods of one's own, which the loop of the library runs
fit           parameters of scenes that fit columns of measured tables
describe      what `myolines list` prints

doc/python.md has all of it with examples.
"""

from . import _core
from .errors import Error, InputError, Interrupted, Problem, SolveError, SystemRefused, guard_ranks
from .fit import Column, Fit, Parameter, fit
from .integrators import Integrator, State, StepReport, integrator
from .runs import Fields, Picture, Report, Run, Study, picture_of_runs, run, study
from .scenes import List, Scene, describe, topics
from .simulations import Course, Simulation, course, samples
from .systems import Linearised, System
from .tables import Table

__version__ = _core.version()

__all__ = [
    "Column", "Course", "Error", "Fields", "Fit", "InputError", "Integrator", "Interrupted", "Linearised", "List", "Parameter", "Picture",
    "Problem", "Report", "Run", "Scene", "Simulation", "SolveError", "State", "StepReport", "Study", "System", "SystemRefused", "Table",
    "course", "describe", "fit", "integrator", "picture_of_runs", "rank", "ranks", "run", "samples", "study", "topics", "versions",
]


def rank() -> int:
    """Number of this process among those that mpirun has started, from 0."""
    return int(_core.rank())


def ranks() -> int:
    """How many processes work together."""
    return int(_core.ranks())


def versions() -> str:
    """Versions of the library and of those that it uses, in lines."""
    return str(_core.versions())


guard_ranks()
