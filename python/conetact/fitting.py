# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of entries for which a scene answers as was measured: damped Gauss-Newton steps with differences of runs."""
from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from .errors import ConetactError, InputError
from .results import Result
from .runs import Batch, Changes, SceneLike, scene_file

Vector = npt.NDArray[np.float64]
Bounds = Mapping[str, tuple[float, float]]
Measure = Callable[[Result], npt.ArrayLike]
Answer = tuple[Optional[Vector], Result]  # what is measured, None where there is no equilibrium
HALVINGS = 8


@dataclass(repr=False)
class Fit:
    """What fit() finds: `values`, their standard `errors`, the root mean square `residual`, the `result` with these
    values, the number of `runs`, and whether the last step was as small as was asked for. `history` has all residuals.

    >>> mu = "Contact bottom/Friction coefficient"
    >>> slips = conetact.run(SCENE, {mu: 0.75}).reactions["u_t1"]
    >>> found = conetact.fit(SCENE, {mu: 0.6}, lambda result: result.reactions["u_t1"], slips)
    >>> print(f"{found.values[mu]:.5f}", found.history[0] > found.history[-1])
    0.75000 True
    """

    values: dict[str, float]
    errors: dict[str, float]
    residual: float
    result: Result
    runs: int
    converged: bool
    history: list[float] = field(default_factory=list)

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {value:.6g}" for name, value in self.values.items())
        end = "" if self.converged else ", not converged"
        return f"Fit({values}; residual {self.residual:.3g}, {self.runs} runs{end})"

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        rows = "".join(f"<tr><td>{escape(name)}</td><td>{value:.6g}</td><td>{self.errors[name]:.2g}</td></tr>"
                       for name, value in self.values.items())
        return (f"<b>residual {self.residual:.3g}, {self.runs} runs{'' if self.converged else ', not converged'}</b>"
                f"<table><tr><th>entry</th><th>value</th><th>standard error</th></tr>{rows}</table>")


def fit(scene: SceneLike, start: Mapping[str, float], measure: Measure, target: npt.ArrayLike, *,
        bounds: Bounds | None = None, entries: Callable[[dict[str, float]], Changes] | None = None,
        changes: Changes | None = None, tolerance: float = 1e-6, difference: float = 1e-3, steps: int = 30,
        processes: int | None = None) -> Fit:
    """Finds values for which what is measured of the results comes nearest to `target`, in the mean square.

    `start`: entries and values to begin with. `measure(result)`: a number, or as many as `target` has. `bounds`: least
    and largest values. `entries(values)` makes entries of values that are no entries themselves, such as parts of
    expressions. Steps end where none changes a value by more than `tolerance` of it; derivatives are differences over
    `difference` of it. Pictures are not drawn unless `changes` asks for them.

    >>> push = "Load push/Value"
    >>> found = conetact.fit(SCENE, {"push": 0.1}, lambda result: result.increments["bottom_f_x"], [-0.25],
    ...                      entries=lambda values: {push: f"{values['push']} * t"})
    >>> round(found.values["push"], 6), found.converged
    (0.25, True)
    """
    with scene_file(scene) as file, Batch(processes) as batch:
        problem = Problem(batch, file, list(start), measure, np.atleast_1d(np.asarray(target, dtype=float)).ravel(),
                          entries or dict, {"Output/VTU": 0, **(changes or {})})
        return Descent(problem, start, bounds or {}, difference).go(tolerance, steps)


@dataclass
class Problem:
    """Residuals as a function of the values."""

    batch: Batch
    scene: str
    names: list[str]
    measure: Measure
    target: Vector
    entries: Callable[[dict[str, float]], Changes]
    changes: Changes
    runs: int = 0

    def answers(self, points: Sequence[Vector]) -> Iterator[Answer]:
        """At many points, side by side."""
        cases = [{**self.changes, **self.entries(dict(zip(self.names, map(float, point))))} for point in points]
        self.runs += len(cases)
        for result in self.batch.results(self.scene, cases):
            yield (None if result.error else self._residual(result)), result

    def _residual(self, result: Result) -> Vector:
        measured = np.atleast_1d(np.asarray(self.measure(result), dtype=float)).ravel()
        if measured.shape != self.target.shape:
            raise InputError(f"The target has {len(self.target)} numbers, what is measured has {len(measured)}. "
                             "Give as many as measure(result) returns.")
        if not np.isfinite(measured).all():
            raise InputError("What is measured is not a finite number. Let measure(result) return finite numbers.")
        difference: Vector = measured - self.target
        return difference


class Descent:
    """Steps from one point to the next one."""

    def __init__(self, problem: Problem, start: Mapping[str, float], bounds: Bounds, difference: float) -> None:
        unknown = [name for name in bounds if name not in start]
        if unknown or not start:
            raise InputError(f"There are bounds of '{unknown[0]}', which has no value to start from." if unknown else
                             "There is no value to start from. Name at least one.")
        self.problem, self.difference = problem, difference
        self.low, self.high = (np.array([bounds.get(name, (-np.inf, np.inf))[i] for name in start]) for i in (0, 1))
        self.x = np.clip(np.array(list(start.values()), dtype=float), self.low, self.high)
        self.scale = np.where(self.x == 0, 1.0, np.abs(self.x))
        first = next(iter(problem.answers([self.x])))
        if first[0] is None:
            raise first[1].error or ConetactError("The first run has no result.")
        self.residual: Vector = first[0]
        self.result = first[1]
        self.history = [self.cost]

    @property
    def cost(self) -> float:
        return float(np.sqrt(np.mean(self.residual**2)))

    def go(self, tolerance: float, steps: int) -> Fit:
        converged = False
        for _ in range(steps):
            slopes = self.slopes()
            converged = self.advance(self.step(slopes), tolerance)
            self.history.append(self.cost)
            if converged:
                break
        return self.found(slopes if steps else np.zeros((len(self.residual), len(self.x))), converged)

    def slopes(self) -> Vector:
        """Derivatives of the residuals with respect to scaled values, by a run for each, away from a near bound."""
        widths = self.difference * np.where(self.x + self.difference * self.scale <= self.high, 1.0, -1.0)
        columns = self.differences(range(len(self.x)), widths)
        if len(columns) < len(self.x):  # no equilibrium there: look to the other side
            columns.update(self.differences([i for i in range(len(self.x)) if i not in columns], -widths))
        for i, name in enumerate(self.problem.names):
            if i not in columns:
                raise ConetactError(f"Beside {name} = {self.x[i]:g} there is no equilibrium on either side. "
                                    "Start elsewhere, or give bounds.")
        slopes = np.column_stack([columns[i] for i in range(len(self.x))])
        self.refuse_idle(slopes)
        return slopes

    def differences(self, which: Sequence[int], widths: Vector) -> dict[int, Vector]:
        """Those of points with an equilibrium."""
        points = [self.x + widths[i] * self.scale[i] * (np.arange(len(self.x)) == i) for i in which]
        answers = self.problem.answers(points)
        return {i: (residual - self.residual) / widths[i] for i, (residual, _) in zip(which, answers)
                if residual is not None}

    def refuse_idle(self, slopes: Vector) -> None:
        idle = [name for name, column in zip(self.problem.names, slopes.T) if not column.any()]
        if idle and self.cost > 0:
            raise ConetactError(f"{idle[0]} = {self.values()[idle[0]]:g} does not change what is measured. "
                                "Start elsewhere, measure something else, or leave it out.")

    def step(self, slopes: Vector) -> Vector:
        """Least squares; values that stand at a bound and would leave it stay there."""
        downhill = -slopes.T @ self.residual
        free = ~((self.x <= self.low) & (downhill < 0) | (self.x >= self.high) & (downhill > 0))
        step = np.zeros(len(self.x))
        if free.any():
            step[free] = np.linalg.lstsq(slopes[:, free], -self.residual, rcond=1e-10)[0]
        scaled: Vector = step * self.scale
        return scaled

    def advance(self, step: Vector, tolerance: float) -> bool:
        """Goes as far as the residual falls; true once steps are small, or none helps any more."""
        for k in range(HALVINGS):
            x = np.clip(self.x + step / 2**k, self.low, self.high)
            if (np.abs(x - self.x) <= tolerance * self.scale).all():
                return True
            residual, result = next(iter(self.problem.answers([x])))
            if residual is not None and (residual**2).sum() < (self.residual**2).sum():
                self.x, self.residual, self.result = x, residual, result
                self.scale = np.maximum(np.abs(x), 1e-3 * self.scale)
                return self.cost <= 1e-14 * float(np.abs(self.problem.target).max(initial=0))
        return bool((np.abs(step / 2**HALVINGS) <= 100 * tolerance * self.scale).all())

    def values(self) -> dict[str, float]:
        return dict(zip(self.problem.names, map(float, self.x)))

    def found(self, slopes: Vector, converged: bool) -> Fit:
        return Fit(self.values(), dict(zip(self.problem.names, self.errors(slopes))), self.cost, self.result,
                   self.problem.runs, converged, self.history)

    def errors(self, slopes: Vector) -> list[float]:
        """Standard errors, of independent errors of one size in all that was measured."""
        surplus = len(self.residual) - len(self.x)
        if surplus < 1:
            return [float("nan")] * len(self.x)
        variance = float(self.residual @ self.residual) / surplus
        spread = np.diag(np.linalg.pinv(slopes.T @ slopes)) * variance
        return [float(error) for error in np.sqrt(spread) * self.scale]
