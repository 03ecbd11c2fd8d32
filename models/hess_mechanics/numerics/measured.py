"""Error estimates from two runs of a computation that share as little as possible.

The second run has another order, other steps, a hundredth of the tolerance, and starts a few units in the last place
away.  With equal starts, both runs would make the same roundings wherever the motion is slow: near an unstable
equilibrium they would compute the same small, wrong rates and leave it side by side, so that their difference stayed
small while both were wrong.  A start that is moved by roundings diverges as fast as anything can.

Components keep their relative digits, however small they are, and so do the steps (`step_kernels.last_terms`): what
leaves an equilibrium or an invariant plane grows with its relative error.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Generic, TypeVar

import numpy as np

from hess_mechanics.numerics.accuracy import Level, Status
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Cost

__all__ = ["SAFETY", "UNSURE", "MeasuredResult", "measured", "perturb", "safety_of"]

R = TypeVar("R")

SAFETY = 1.25
"""Ratio of an error estimate to the difference of two runs, because the second one has an error too."""

UNSURE = 1e-15
"""Error estimate at the floor of double precision from which on a third run checks it."""

_FARTHEST = 3.0 * 2.0**-52
_GOLDEN = 0.5 * (5.0**0.5 - 1.0)


def perturb(values: Array) -> Array:
    """Return numbers that differ from the given ones by roundings, up to three units in the last place.

    Each number moves in proportion to its size, like a rounding: 0 stays 0, and a start 1e-300 away from an invariant
    plane stays as close to it.  The fractions follow the golden ratio, and those of neighbouring components differ by
    at least 0.38 of the range, so that a vector is rotated as well as stretched.  Stretching alone is a stable or
    neutral direction of many equilibria.

    Parameters
    ----------
    values : ndarray, shape (..., d)
        States, or other data of a computation.

    Returns
    -------
    ndarray, shape (..., d)
        The moved numbers; the function is deterministic.
    """
    return np.asarray(values * _factors(values.shape[-1]))


@cache
def _factors(count: int) -> Array:
    shares = 2.0 * ((np.arange(1, count + 1) * _GOLDEN) % 1.0) - 1.0
    return np.asarray(1.0 + _FARTHEST * shares)


@dataclass(frozen=True)
class MeasuredResult(Generic[R]):
    """A result from the given start, with its error.

    Attributes
    ----------
    result : object
        The result.
    other : object
        Result of the run with which it was compared; of two such runs, the one that differs more.
    error : float
        Error estimate.
    safety : float
        Ratio of the error estimate to the difference of the runs.
    status : Status
        Status of the error at the requested level.
    cost : Cost
        Steps and time of all runs.
    """

    result: R
    other: R
    error: float
    safety: float
    status: Status
    cost: Cost


def safety_of(off: Array, before: Array) -> Array:
    """Return the factors that turn differences of two runs into error estimates.

    A difference says nothing if the other start happens to cancel the truncation error.  So an estimate is at least a
    hundredth of the estimate at a hundred times the tolerance.

    Parameters
    ----------
    off : ndarray, shape (n,)
        Differences of the two runs.
    before : ndarray, shape (n,)
        Estimates at a hundred times the tolerance; 0 if there were none.

    Returns
    -------
    ndarray, shape (n,)
        The factors, at least `SAFETY`.
    """
    return np.maximum(SAFETY, before / (100.0 * np.maximum(off, 1e-300)))


def measured(
    level: Level, run: Callable[[Level, int], tuple[R, int]], apart: Callable[[R, R], float]
) -> MeasuredResult[R]:
    """Return a computation with its error estimate, within the promise of the level if double precision allows it.

    The first run is compared with a more accurate one from a nearby start.  If they differ too much, a still more
    accurate run follows, and so on down to the floor of double precision.  Every second run has the given start, and
    the last one of these is the result.  Each new tolerance needs a single new run.  At the floor, where an error is
    round-off, two runs agree by chance to a quarter of their error in one case of twelve: a third one follows if the
    estimate exceeds `UNSURE`.

    Parameters
    ----------
    level : Level
        Order and tolerance of the first run, and the promised error.
    run : callable
        Function run(level, steps) that returns the result at a level, from a start moved by `perturb` if
        `level.is_perturbed`, and the number of steps; `steps` is the number of steps of all runs before.
    apart : callable
        Difference of two results, in the units of the promise.

    Returns
    -------
    MeasuredResult
        The result; its error estimate holds for the less accurate of the two runs.
    """
    begun = time.perf_counter()
    current, error = level, 0.0
    first, steps = run(current, 0)
    while True:
        check_limit()
        tighter = current.tighter()
        second, taken = run(tighter, steps)
        steps += taken
        off = apart(first, second)
        safety = float(safety_of(np.array(off), np.array(error))) if 0.0 < error < math.inf else SAFETY
        error = safety * off + 2e-16
        if error <= level.promise or current.is_floor:
            result, other = (second, first) if current.is_perturbed else (first, second)
            if current.is_floor and error > UNSURE:
                third, taken = run(current.variant(), steps)
                steps += taken
                further = apart(result, third)
                if further > off:
                    other, error = third, max(error, SAFETY * further + 2e-16)
                    safety = error / further if further < math.inf else SAFETY
            cost = Cost(steps, (time.perf_counter() - begun) * 1e3)
            return MeasuredResult(result, other, error, safety, level.status(error), cost)
        current, first = tighter, second
