# SPDX-License-Identifier: LGPL-2.1-or-later
"""Systems R(t, u, v, a) = M a + F(t, u, v) = 0 as operators of SciPy."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple, Union

import numpy as np

from . import _core
from .errors import SolveError
from .scenes import Path, Scene


class System:
    """The system of a scene, without a method: System(scene).

    Arrays hold the unknowns that this rank owns: all of them on one rank. Unknowns that are prescribed, or tied to others, are among them;
    `free` tells which are not. Equal arguments give equal results, in any order of calls.
    """

    def __init__(self, scene: Union[Scene, Path, None] = None, *, _core_system: Any = None):
        if _core_system is None:
            scene = scene if isinstance(scene, Scene) else Scene(scene)
            _core_system = _core.System(scene._document)
        self._core = _core_system
        self.free: np.ndarray = self._core.free() > 0.5
        """True for unknowns that no constraint determines."""

    @property
    def n_unknowns(self) -> int:
        """On all ranks."""
        return int(self._core.n_unknowns)

    @property
    def capabilities(self) -> Dict[str, Any]:
        """Facts: inertia, rates, linear, symmetric tangent, orders, splits."""
        return dict(self._core.capabilities())

    def initial_state(self, t: float = 0.0) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """u, v, a with which a run begins at t [s]."""
        return self._core.initial_state(t)

    def prescribed(self, t: float, u: np.ndarray, v: np.ndarray, a: np.ndarray, side: str = "left") -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The same with constrained unknowns where they are at t [s]; at a kink on that side of it."""
        return self._core.prescribed(t, u, v, a, side)

    def residual(self, t: float, u: np.ndarray, v: Optional[np.ndarray] = None, a: Optional[np.ndarray] = None, side: str = "left") -> np.ndarray:
        """R(t, u, v, a) [N]; in rows of prescribed unknowns it is the reaction. NaN where the state is inadmissible, see why_inadmissible()."""
        zero = np.zeros_like(u)
        return self._core.residual(t, u, zero if v is None else v, zero if a is None else a, side)[0]

    def why_inadmissible(self, t: float, u: np.ndarray, v: Optional[np.ndarray] = None, a: Optional[np.ndarray] = None, side: str = "left") -> Optional[str]:
        """Why there is no residual; None where there is one."""
        zero = np.zeros_like(u)
        return self._core.residual(t, u, zero if v is None else v, zero if a is None else a, side)[1]

    def linearise(self, t: float, u: np.ndarray, v: Optional[np.ndarray] = None, a: Optional[np.ndarray] = None, side: str = "left") -> "Linearised":
        """K = dR/du, C = dR/dv and M = dR/da at an admissible point."""
        zero = np.zeros_like(u)
        return Linearised(self, self._core.linearise(t, u, zero if v is None else v, zero if a is None else a, side))

    def events(self, t0: float, t1: float) -> "list[float]":
        """Times between t0 and t1 [s] at which what drives the system has kinks."""
        return list(self._core.events(t0, t1))

    def dot(self, x: np.ndarray, y: np.ndarray) -> float:
        """The scalar product over all ranks."""
        return float(self._core.dot(x, y))

    def gathered(self, x: np.ndarray) -> np.ndarray:
        """All entries of all ranks, on all of them, in an order that does not depend on how many ranks there are."""
        return self._core.gathered(x)


class Linearised:
    """A system linearised at a point. J = u K + v C + a M for any weights u, v, a."""

    def __init__(self, system: System, core: Any):
        self.system = system
        self._core = core

    def operator(self, u: float = 0.0, v: float = 0.0, a: float = 0.0) -> Any:
        """J as a scipy.sparse.linalg.LinearOperator over all unknowns, no constraint applied. On one rank."""
        from scipy.sparse.linalg import LinearOperator

        n = self._only_rank()
        return LinearOperator((n, n), matvec=lambda x: self.apply(x, u, v, a), dtype=float)

    def apply(self, x: np.ndarray, u: float = 0.0, v: float = 0.0, a: float = 0.0) -> np.ndarray:
        """J x, on any number of ranks."""
        return self._core.apply(np.ravel(x), u, v, a)

    def matrix(self, u: float = 0.0, v: float = 0.0, a: float = 0.0) -> Any:
        """J of the free unknowns as a scipy.sparse.csr_matrix: rows and columns of constrained ones are empty, what hangs on free ones is
        added to them. Take [free][:, free] of it for solvers. On one rank."""
        from scipy.sparse import csr_matrix

        n = self._only_rank()
        rows = self._core.csr(u, v, a)
        return csr_matrix((rows["data"], rows["indices"], rows["indptr"]), shape=(n, n))

    @property
    def K(self) -> Any:
        """Stiffness dR/du [N/m], as matrix() gives it."""
        return self.matrix(u=1)

    @property
    def C(self) -> Any:
        """Damping dR/dv [N s/m]."""
        return self.matrix(v=1)

    @property
    def M(self) -> Any:
        """Mass dR/da [kg]."""
        return self.matrix(a=1)

    def solve(self, b: np.ndarray, u: float = 0.0, v: float = 0.0, a: float = 0.0, tolerance: float = 1e-10) -> np.ndarray:
        """x with J x = b on the free unknowns, to |b - J x| <= tolerance |b|, by the Krylov solver and the preconditioner of the scene; zero on
        constrained ones. On any number of ranks. Raises SolveError if it does not get there."""
        solved = self._core.solve(b, u, v, a, tolerance)
        if not solved["converged"]:
            raise SolveError(f'The linear system cannot be solved: {solved["reason"]}.')
        return solved["x"]

    def preconditioner(self, u: float = 0.0, v: float = 0.0, a: float = 0.0, tolerance: float = 1e-1) -> Any:
        """Roughly J^-1 as a LinearOperator, a solve() to the tolerance: for scipy.sparse.linalg.gmres and eigenvalue solvers. On one rank."""
        from scipy.sparse.linalg import LinearOperator

        n = self._only_rank()
        return LinearOperator((n, n), matvec=lambda x: self.solve(np.ravel(x), u, v, a, tolerance), dtype=float)

    def _only_rank(self) -> int:
        if self.system._core.is_spread:
            _core.refuse("system", "its unknowns are spread over several ranks, of which SciPy knows nothing", "apply() and solve(), or one rank")
        return self.system.n_unknowns
