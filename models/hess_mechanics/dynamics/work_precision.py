"""Work and precision on one motion: errors over time, drift of the integrals and cost, all measured."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import count
from typing import TypeVar

import numpy as np

from hess_mechanics.dynamics.double_double import DoubleDoubleOrbit, double_double_orbit
from hess_mechanics.dynamics.orbit import drifts_along, solve
from hess_mechanics.dynamics.system import Problem, systems
from hess_mechanics.numerics.accuracy import LEVELS, REFERENCE
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = [
    "SLOW_METHODS",
    "ErrorGrowth",
    "WorkPoint",
    "fastest_scipy_method",
    "growth",
    "longest_duration",
    "measure_levels",
    "measure_scipy",
    "scipy_takes_long",
    "truth",
]

T = TypeVar("T")

SLOW_METHODS = ("DOP853", "LSODA")
_TOLERANCES = (1e-4, 1e-7, 1e-10)
_LONGEST_FOR_OTHERS = 150.0
_LONGEST = 5000.0
"""Longest time spans of SciPy's methods and of the levels, which they integrate in about a second, in units of 1/ν."""
_LONG_RUN = 0.1
"""A run longer than this many seconds is not repeated: disturbances are short compared with it."""
_EVALUATIONS = 1000
"""Number of evaluations of the field, about 10 ms, between two calls of `check_limit` by SciPy's methods."""
_MOST_STEPS_FOR_OTHERS = 1500
"""Largest number of steps of `reference` for which SciPy's methods run; together they take 0.16 ms per such step."""


@dataclass(frozen=True)
class ErrorGrowth:
    """Errors along one motion, by the names of the levels.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times.
    errors : mapping of str to ndarray, shape (n,)
        Largest error of any variable, in units in which the state is O(1).
    pixels : mapping of str to ndarray, shape (n,)
        Error in pixels, the larger one of two pictures: that of the velocities and that of the other variables.
    drifts : mapping of str to Mapping[str, ndarray]
        Drift, shape (n,), of each integral by its name, for each level, see `drifts_along`.
    """

    times: Array
    errors: Mapping[str, Array]
    pixels: Mapping[str, Array]
    drifts: Mapping[str, Mapping[str, Array]]


@dataclass(frozen=True)
class WorkPoint:
    """Cost and error of one method at one setting.

    Attributes
    ----------
    method : str
        Name of the method.
    setting : str
        Name of the level, or the tolerance, such as "1e-07".
    ms : float
        Wall time, in milliseconds.
    error : float
        Largest error of any variable at any time, in units in which the state is O(1).
    """

    method: str
    setting: str
    ms: float
    error: float


@lru_cache(maxsize=8)
def truth(
    name: str, start: tuple[float, ...], parameters: tuple[float, ...], duration: float, samples: int
) -> DoubleDoubleOrbit:
    """Return a motion with 31 digits at evenly spaced times; the last few motions are cached.

    Parameters
    ----------
    name : str
        Name of the system.
    start : tuple of float, shape (d,)
        Initial state.
    parameters : tuple of float, shape (q,)
        Values of the parameters.
    duration : float
        Last time; negative: backward.
    samples : int
        Number of times, both ends included.

    Returns
    -------
    DoubleDoubleOrbit
        The motion.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the motion needs too many steps.
    """
    return double_double_orbit(systems()[name].at(parameters), start, np.linspace(0.0, duration, samples))


def growth(
    name: str,
    start: tuple[float, ...],
    parameters: tuple[float, ...],
    duration: float,
    weights: tuple[float, ...],
    samples: int,
) -> ErrorGrowth:
    """Return the errors of all levels along a motion, at evenly spaced times.

    Parameters
    ----------
    name : str
        Name of the system.
    start : tuple of float, shape (d,)
        Initial state.
    parameters : tuple of float, shape (q,)
        Values of the parameters.
    duration : float
        Last time; negative: backward.
    weights : tuple of float, shape (d,)
        Pixels per unit of each variable.
    samples : int
        Number of times, both ends included.

    Returns
    -------
    ErrorGrowth
        The errors.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the motion needs too many steps.
    """
    system, exact = systems()[name], truth(name, start, parameters, duration, samples)
    body = system.at(parameters)
    first = system.angular_velocities
    errors, pixels, drifts = {}, {}, {}
    for level in LEVELS.values():
        check_limit()
        states = solve(body, start, exact.times, level).states
        difference = exact.errors_of(states)
        errors[level.name] = as_read_only(np.max(difference / exact.scale, axis=1))
        weighted = difference * np.asarray(weights)
        pixels[level.name] = as_read_only(
            np.maximum(np.linalg.norm(weighted[:, :first], axis=1), np.linalg.norm(weighted[:, first:], axis=1))
        )
        along = drifts_along(system, np.array(start), states, np.array(parameters))
        drifts[level.name] = {key: as_read_only(drift) for key, drift in along.items()}
    return ErrorGrowth(exact.times, errors, pixels, drifts)


def _best_of(run: Callable[[], T], repeats: int) -> tuple[float, T]:
    """Return the milliseconds of the fastest of `repeats` runs, and the last result; a long run is not repeated."""
    best = np.inf
    for _ in range(repeats):
        if _LONG_RUN < best < np.inf:
            break
        check_limit()
        start = time.perf_counter()
        result = run()
        best = min(best, time.perf_counter() - start)
    return best * 1e3, result


def measure_levels(
    name: str, start: tuple[float, ...], parameters: tuple[float, ...], duration: float, samples: int
) -> tuple[WorkPoint, ...]:
    """Measure cost and error of each level on a motion; the cost includes the error estimate.

    Parameters
    ----------
    name : str
        Name of the system.
    start : tuple of float, shape (d,)
        Initial state.
    parameters : tuple of float, shape (q,)
        Values of the parameters.
    duration : float
        Last time; negative: backward.
    samples : int
        Number of times, both ends included.

    Returns
    -------
    tuple of WorkPoint
        One point for each level.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the motion needs too many steps.
    """
    body, exact = systems()[name].at(parameters), truth(name, start, parameters, duration, samples)
    points = []
    for level in LEVELS.values():
        ms, states = _best_of(lambda: solve(body, start, exact.times, level).states, 3)  # noqa: B023 (called at once)
        points.append(WorkPoint("Taylor", level.name, ms, float(np.max(exact.errors_of(states) / exact.scale))))
    return tuple(points)


def longest_duration(name: str, start: Sequence[float], parameters: Sequence[float]) -> float:
    """Return the longest time span of a motion that the levels integrate in about a second.

    Parameters
    ----------
    name : str
        Name of the system.
    start : sequence of float, shape (d,)
        Initial state.
    parameters : sequence of float, shape (q,)
        Values of the parameters.

    Returns
    -------
    float
        The time span, in units of the problem.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    """
    return _LONGEST / Problem.of(systems()[name].at(parameters), [start]).nu


def scipy_takes_long(name: str, start: Sequence[float], parameters: Sequence[float], duration: float) -> bool:
    """Return True if SciPy's methods would take long for a motion.

    The decision depends on the time span and the number of steps, not on a clock, so it is reproducible.

    Parameters
    ----------
    name : str
        Name of the system.
    start : sequence of float, shape (d,)
        Initial state.
    parameters : sequence of float, shape (q,)
        Values of the parameters.
    duration : float
        Last time; negative: backward.

    Returns
    -------
    bool
        True for a duration of more than 150/ν, or more than 1500 steps at the level `reference`.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the motion needs too many steps.
    """
    body = systems()[name].at(parameters)
    return (
        duration * Problem.of(body, [start]).nu > _LONGEST_FOR_OTHERS
        or solve(body, start, np.array([0.0, duration]), REFERENCE).cost.steps > _MOST_STEPS_FOR_OTHERS
    )


def measure_scipy(
    name: str, start: tuple[float, ...], parameters: tuple[float, ...], duration: float, samples: int
) -> tuple[WorkPoint, ...]:
    """Measure cost and error of SciPy's methods on the plain field, at three tolerances each, without error estimates.

    Parameters
    ----------
    name : str
        Name of the system.
    start : tuple of float, shape (d,)
        Initial state.
    parameters : tuple of float, shape (q,)
        Values of the parameters.
    duration : float
        Last time; negative: backward.
    samples : int
        Number of times, both ends included.

    Returns
    -------
    tuple of WorkPoint
        One point for each method and tolerance.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the motion needs too many steps.
    """
    from scipy.integrate import solve_ivp  # Imported here because the import takes 0.3 s.

    system, exact = systems()[name], truth(name, start, parameters, duration, samples)
    evaluations = count(1)

    def rates(_: float, y: Sequence[float]) -> Sequence[float]:
        if next(evaluations) % _EVALUATIONS == 0:
            check_limit()
        return system.field(y, parameters)

    points = []
    for method in SLOW_METHODS:
        for tolerance in _TOLERANCES:
            run = partial(solve_ivp, rates, (0.0, duration), start, method, exact.times, rtol=tolerance, atol=tolerance)
            ms, solved = _best_of(run, 1)
            points.append(
                WorkPoint(method, f"{tolerance:.0e}", ms, float(np.max(exact.errors_of(solved.y.T) / exact.scale)))
            )
    return tuple(points)


def fastest_scipy_method(points: Sequence[WorkPoint], error: float) -> WorkPoint | None:
    """Return the fastest measurement of SciPy's methods that is accurate enough.

    Parameters
    ----------
    points : sequence of WorkPoint
        Points of `measure_scipy`.
    error : float
        Largest error that is accurate enough, in units in which the state is O(1).

    Returns
    -------
    WorkPoint or None
        The point; None if no method is accurate enough.
    """
    good = [point for point in points if point.method in SLOW_METHODS and point.error <= error]
    return min(good, key=lambda point: point.ms, default=None)
