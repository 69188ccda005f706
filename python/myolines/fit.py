# SPDX-License-Identifier: LGPL-2.1-or-later
"""Least squares: parameters of scenes with which their runs agree with measured columns."""

from __future__ import annotations

import dataclasses
import html
import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from .errors import SolveError
from .evaluations import Evaluations, Task
from .scenes import Path, Scene


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A number of the scenes to be found: one path, or several that take the same value. `start` is that of the first scene unless given."""

    path: Union[str, Tuple[str, ...]]
    low: float = -np.inf
    high: float = np.inf
    start: Optional[float] = None
    name: str = ""

    @property
    def paths(self) -> Tuple[str, ...]:
        return (self.path,) if isinstance(self.path, str) else tuple(self.path)

    @property
    def label(self) -> str:
        return self.name or self.paths[0]


@dataclasses.dataclass(frozen=True)
class Column:
    """Measured values y at x, of which the column of a table that the scene writes is to be the like, with the column `against` as its x.

    sigma: standard deviation of the measured values, one or for each. None: not known, and the same for all values of this column as a part of
    their spread; it is then estimated from what the fit leaves.
    """

    scene: Scene
    table: str
    column: str
    x: Sequence[float]
    y: Sequence[float]
    sigma: Union[None, float, Sequence[float]] = None
    against: str = "Time"


@dataclasses.dataclass(frozen=True)
class Fit:
    """Parameters that were found, in the order in which they were given."""

    parameters: Tuple[Parameter, ...]
    values: np.ndarray
    covariance: np.ndarray
    """Of the parameters, from the Jacobian at the end. Infinite for those that nothing tells."""
    residuals: List[np.ndarray]
    """(model - measured) for each column, in its unit."""
    jacobian: np.ndarray
    """Of the weighted residuals."""
    weak: List[Dict[str, float]]
    """Directions that the measurements do not tell: changes of the parameters in parts of their scale, of which a change by the whole scale is
    within the standard error. Empty: all parameters are identifiable."""
    at_bounds: List[str]
    """Parameters that ended at a bound: their errors are not those of a free one."""
    degrees_of_freedom: int
    sigma_known: bool
    runs: int
    """That were carried out; others had been kept."""
    message: str
    scenes: List[Scene]
    """The scenes with the values that were found."""

    @property
    def errors(self) -> np.ndarray:
        """Standard errors of the parameters."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlation(self) -> np.ndarray:
        """Correlation matrix of the parameters."""
        with np.errstate(invalid="ignore"):
            return self.covariance / np.outer(self.errors, self.errors)

    def intervals(self, level: float = 0.95) -> np.ndarray:
        """Confidence intervals of each parameter alone, (parameters, 2): of Student's t, or normal ones where sigma is known."""
        from scipy import stats

        p = (1 + level) / 2
        quantile = stats.norm.ppf(p) if self.sigma_known else stats.t.ppf(p, self.degrees_of_freedom)
        return np.stack([self.values - quantile * self.errors, self.values + quantile * self.errors], axis=1)

    def __getitem__(self, name: str) -> float:
        labels = [parameter.label for parameter in self.parameters]
        if name not in labels:
            _core.refuse("fit", f'there is no parameter "{name}"', "one of " + ", ".join(labels), _core.nearest_hint(name, labels, "nearest"))
        return float(self.values[labels.index(name)])

    def _rows(self) -> List[Tuple[str, str, str]]:
        return [(parameter.label, f"{value:.6g}", f"{error:.2g}") for parameter, value, error in zip(self.parameters, self.values, self.errors)]

    def __repr__(self) -> str:
        lines = [f"  {label} = {value} ± {error}" for label, value, error in self._rows()]
        lines += [f"  not told by the measurements: {direction}" for direction in self.weak]
        lines += [f"  at its bound: {label}" for label in self.at_bounds]
        return f"<Fit after {self.runs} runs\n" + "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{html.escape(label)}</td><td>{value}</td><td>{error}</td></tr>" for label, value, error in self._rows())
        return f"<table><tr><th>parameter</th><th>value</th><th>standard error</th></tr>{rows}</table>"


class _Model:
    """Weighted residuals and their Jacobian as functions of z = value/scale."""

    def __init__(self, parameters: Sequence[Parameter], columns: Sequence[Column], start: np.ndarray, scale: np.ndarray, evaluations: Evaluations,
                 step: float):
        self._parameters, self._columns, self._scale, self._evaluations, self._step = parameters, columns, scale, evaluations, step
        self.scenes: List[Scene] = []
        for column in columns:
            if not any(column.scene is scene for scene in self.scenes):
                self.scenes.append(column.scene)
        self._xml = [_without_fields(scene).xml() for scene in self.scenes]
        self._of_scene = [[i for i, column in enumerate(columns) if column.scene is scene] for scene in self.scenes]
        self._weights = [_weights(column) for column in columns]
        self._penalty = 0.0
        self._low = np.array([parameter.low for parameter in parameters]) / scale
        self._high = np.array([parameter.high for parameter in parameters]) / scale
        first = self._all([start / scale])[0]
        if isinstance(first, str):
            raise SolveError(f"The run with the values at the start failed: {first}")
        self._penalty = 1e3 * max(1.0, float(np.abs(first).max()))

    def settings(self, z: np.ndarray) -> Tuple[Tuple[str, str], ...]:
        values = zip(self._parameters, z * self._scale)
        return tuple((path, repr(float(value))) for parameter, value in values for path in parameter.paths)

    def _tasks(self, z: np.ndarray) -> List[Task]:
        tasks = []
        for scene, xml, columns in zip(self.scenes, self._xml, self._of_scene):
            wanted = [(self._columns[i].table, name) for i in columns for name in (self._columns[i].against, self._columns[i].column)]
            tasks.append(Task(xml, scene.name, self.settings(z), tuple(wanted)))
        return tasks

    def _all(self, points: List[np.ndarray]) -> List[Union[np.ndarray, str]]:
        """Weighted residuals at several points, or why there are none; all runs of all points at once."""
        tasks = [self._tasks(z) for z in points]
        results = iter(self._evaluations.results([task for of_point in tasks for task in of_point]))
        found: List[Union[np.ndarray, str]] = []
        for of_point in tasks:
            parts: Dict[int, np.ndarray] = {}
            failed = ""
            for columns in self._of_scene:
                result = next(results)
                if result.columns is None:
                    failed = result.failed
                    continue
                for number, i in enumerate(columns):
                    parts[i] = self._residual(self._columns[i], np.array(result.columns[2 * number]), np.array(result.columns[2 * number + 1]))
            found.append(failed or np.concatenate([parts[i] * self._weights[i] for i in range(len(self._columns))]))
        return found

    @staticmethod
    def _residual(column: Column, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        wanted, order = np.asarray(column.x, dtype=float), np.argsort(x, kind="stable")
        slack = 1e-9 * max(1e-300, float(np.ptp(x)))
        if wanted.min() < x.min() - slack or wanted.max() > x.max() + slack:
            _core.refuse(f"{column.scene.name}: {column.table}/{column.column}", f"measured from {wanted.min():g} to {wanted.max():g}, "
                         f'the run has "{column.against}" from {x.min():g} to {x.max():g}', "a run that covers what was measured")
        return np.interp(wanted, x[order], y[order]) - np.asarray(column.y, dtype=float)

    def residuals(self, z: np.ndarray) -> np.ndarray:
        """A trial whose run fails counts as very far, so that the step is shortened."""
        found = self._all([z])[0]
        return found if isinstance(found, np.ndarray) else np.full(sum(len(column.x) for column in self._columns), self._penalty)

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        """Central differences, one-sided at bounds."""
        points, steps = [], []
        for i in range(len(z)):
            h = self._step * max(1.0, abs(z[i]))
            ends = np.clip([z[i] - h, z[i] + h], self._low[i], self._high[i])
            for end in ends:
                point = z.copy()
                point[i] = end
                points.append(point)
            steps.append(ends[1] - ends[0])
        found = self._all(points)
        residuals = []
        for one in found:
            if isinstance(one, str):
                raise SolveError(f"A run for the derivatives failed: {one}")
            residuals.append(one)
        return np.stack([(residuals[2 * i + 1] - residuals[2 * i]) / steps[i] for i in range(len(z))], axis=1)

    def by_column(self, weighted: np.ndarray) -> List[np.ndarray]:
        ends = np.cumsum([len(column.x) for column in self._columns])[:-1]
        return [part / weight for part, weight in zip(np.split(weighted, ends), self._weights)]


def _without_fields(scene: Scene) -> Scene:
    """Files that no column is read from are not written."""
    copy = scene.copy()
    for path in ("fields", "quadrature", "checkpoint/keep"):
        if path in copy["output"]:
            del copy["output/" + path]
    return copy


def _weights(column: Column) -> np.ndarray:
    y = np.asarray(column.y, dtype=float)
    if len(column.x) != len(y) or not len(y):
        _core.refuse(f"{column.table}/{column.column}", f"{len(column.x)} places and {len(y)} measured values", "as many of one as of the other")
    if column.sigma is None:
        spread = float(np.std(y)) or float(np.abs(y).max()) or 1.0
        return np.full(len(y), 1 / spread)
    sigma = np.broadcast_to(np.asarray(column.sigma, dtype=float), y.shape)
    if not (sigma > 0).all():
        _core.refuse(f"{column.table}/{column.column}", "a standard deviation that is not above zero", "standard deviations > 0")
    return 1 / sigma


def fit(parameters: Sequence[Parameter], columns: Sequence[Column], *, folder: Optional[Path] = None, jobs: int = 0, step: float = 1e-4,
        tolerance: float = 1e-8, progress: Optional[Callable[[Mapping[str, float], float], None]] = None) -> Fit:
    """Finds parameters by least squares of (model - measured)/sigma over all columns (scipy.optimize.least_squares, trust region, bounds).

    folder     keeps what runs have given, in evaluations.jsonl: called again after it was stopped, no run is done twice
    jobs       runs at a time, in processes of their own; 1: in this process, where integrators written in Python are known; 0: one a core
    step       of the central differences, in parts of the scale of a parameter (its start, or its range); large beside the tolerances of the runs
    tolerance  relative change of parameters, cost or gradient at which it ends
    progress   called with the values and the cost after every trial

    Raises SolveError if the first run, one for a derivative, or the iteration fails. On one rank.
    """
    from scipy.optimize import least_squares

    if _core.ranks() > 1:
        _core.refuse("fit", "it is called on several ranks", "one rank: runs are done in processes of their own")
    if not parameters or not columns:
        _core.refuse("fit", "there are no parameters, or no columns", "at least one of each")
    start, scale = _start(parameters, columns[0].scene)
    if folder is not None:
        os.makedirs(os.fspath(folder), exist_ok=True)
    jobs = jobs or len(os.sched_getaffinity(0))
    with Evaluations(None if folder is None else os.fspath(folder), jobs) as evaluations:
        model = _Model(parameters, columns, start, scale, evaluations, step)

        def residuals(z: np.ndarray) -> np.ndarray:
            found = model.residuals(z)
            if progress is not None:
                progress({parameter.label: float(value) for parameter, value in zip(parameters, z * scale)}, float(found @ found / 2))
            return found

        bounds = [np.array([parameter.low for parameter in parameters]) / scale, np.array([parameter.high for parameter in parameters]) / scale]
        solved = least_squares(residuals, start / scale, jac=model.jacobian, bounds=bounds, xtol=tolerance, ftol=tolerance, gtol=tolerance,
                               x_scale="jac")
        if not solved.success:
            raise SolveError(f"The least squares have not converged: {solved.message}.")
        return _result(parameters, columns, scale, model, solved, evaluations.runs)


def _start(parameters: Sequence[Parameter], scene: Scene) -> Tuple[np.ndarray, np.ndarray]:
    start, scale = [], []
    for parameter in parameters:
        value = parameter.start if parameter.start is not None else scene[parameter.paths[0]]
        if not isinstance(value, (int, float)):
            _core.refuse(f"{scene.name}: {parameter.paths[0]}", "there is no number to start from", "a parameter that is a number, or a start")
        if not parameter.low <= value <= parameter.high:
            _core.refuse(f"{scene.name}: {parameter.paths[0]}", f"the start {value:g} is outside the bounds",
                         f"a start from {parameter.low:g} to {parameter.high:g}")
        span = parameter.high - parameter.low
        start.append(float(value))
        scale.append(abs(float(value)) or (span if np.isfinite(span) else 1.0))
    return np.array(start), np.array(scale)


def _result(parameters: Sequence[Parameter], columns: Sequence[Column], scale: np.ndarray, model: _Model, solved: Any, runs: int) -> Fit:
    known = all(column.sigma is not None for column in columns)
    free = solved.active_mask == 0
    freedom = len(solved.fun) - int(free.sum())
    variance = 1.0 if known else 2 * solved.cost / freedom if freedom > 0 else np.inf
    covariance, weak = np.zeros((len(scale), len(scale))), []
    if free.any():
        _, singular, directions = np.linalg.svd(solved.jac[:, free], full_matrices=False)
        # Of the scaled parameters; what is told only beyond rounding of the differences is not told.
        told = singular > 1e-10 * singular[0] if singular[0] > 0 else np.zeros(len(singular), dtype=bool)
        with np.errstate(divide="ignore"):
            errors = np.where(told, np.sqrt(variance) / np.where(told, singular, 1), np.inf)
        labels = [parameter.label for parameter, is_free in zip(parameters, free) if is_free]
        weak = [{label: float(part) for label, part in zip(labels, direction)} for direction, error in zip(directions, errors) if error > 1]
        finite = (directions[told].T * errors[told] ** 2) @ directions[told]
        blind = (np.abs(directions[~told]) > 1e-6).any(axis=0)
        finite[blind, :] = finite[:, blind] = 0
        finite[blind, blind] = np.inf
        covariance[np.ix_(free, free)] = finite
    values = solved.x * scale
    with np.errstate(invalid="ignore"):
        covariance = np.where(covariance == 0, 0.0, covariance * np.outer(scale, scale))
    settings = {path: float(value) for parameter, value in zip(parameters, values) for path in parameter.paths}
    return Fit(tuple(parameters), values, covariance, model.by_column(solved.fun), solved.jac, weak,
               [parameter.label for parameter, is_free in zip(parameters, free) if not is_free], freedom, known, runs, str(solved.message),
               [scene.with_values(settings) for scene in model.scenes])
