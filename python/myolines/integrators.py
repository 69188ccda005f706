# SPDX-License-Identifier: LGPL-2.1-or-later
"""Integrators written in Python, which scenes name and the loop of the library runs."""

from __future__ import annotations

from typing import Any, Dict, Tuple, Type, TypeVar, Union

import numpy as np

from . import _core
from .systems import System

StepReport = _core.StepReport
State = _core.State


class Integrator:
    """A method of one's own: a class with facts, start() and step(), made known by @myolines.integrator.

        @myolines.integrator
        class Trapezoidal(myolines.Integrator):
            name, summary, order = "my rule", "u and v by the trapezoidal rule.", 2

            def step(self, dt, state):
                u, v = state.u + dt * state.v + dt**2 / 4 * state.a, state.v + dt / 2 * state.a
                return self.solve_stage(state.t + dt, state, u, v, 0 * v, (dt**2 / 4, dt / 2, 1))

    Then scenes may say integrator/type = "my rule"; kinks, step control, outputs and resuming are those of all methods.
    """

    name: str = ""
    """As in a scene."""
    summary: str = ""
    """One sentence."""
    reference: str = ""
    stability: str = ""
    order: int = 1
    """Of accuracy of u and v on smooth problems."""
    second_order_only: bool = False
    """It takes only systems whose unknowns all have accelerations."""
    parameters: Dict[str, Tuple[float, str, float, float, str]] = {}
    """Of the list `integrator`: name -> (default, unit, least, greatest, sentence)."""
    remembers: Tuple[str, ...] = ()
    """Names of attributes, numbers or arrays like u, that the next step depends on beyond the state: they are saved and loaded."""

    def __init__(self, context: Any):
        self.context = context
        self.system = System(_core_system=context.system)
        self.values: Dict[str, float] = dict(context.parameters)

    def start(self, state: Any) -> None:
        """The state is the beginning of a smooth piece. By default prescribed motion, and accelerations where there is a mass, become consistent with it."""
        self.context.start_piece(state)

    def step(self, dt: float, state: Any) -> Union[None, str, Any]:
        """One step from state.t to state.t + dt [s]: state.u, state.v, state.a, arrays that may be written to, become those at its end. Returns
        None or the report of solve_stage(), or a text that says why the step failed: the state is then put back."""
        raise NotImplementedError

    def solve_stage(self, t: float, state: Any, u: np.ndarray, v: np.ndarray, a: np.ndarray, c: Tuple[float, float, float]) -> Any:
        """Finds d with R(t, u + c[0] d, v + c[1] d, a + c[2] d) = 0 by Newton's method; constrained unknowns are where they are prescribed. The
        state, its time too, becomes the end of the stage if that succeeds. Returns a report with `accepted` and `reason`."""
        return self.context.solve_stage(t, state, u, v, a, c)


Method = TypeVar("Method", bound=Type[Integrator])


def integrator(method: Method) -> Method:
    """Makes a class known, for this process, as an integrator that scenes may name."""
    if not method.name:
        _core.refuse(method.__name__, "it has no name", "a class with a name, as scenes are to spell it")
    _core.register_integrator(method)
    return method


