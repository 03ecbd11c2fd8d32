"""How every error estimate is formed: two runs of one computation that share as little as possible.

A run is compared with a second one that has a hundredth of the tolerance and starts a few units in the last place
aside.  Without the second difference both runs would make the same roundings wherever the motion is slow: at rest next
to an unstable equilibrium they compute the same small, wrong rates from the same numbers and leave it side by side, so
that their difference stays small while both are wrong altogether.  A start that is moved by roundings parts from the
other one as fast as anything can, and shows what roundings become.
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
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array, Cost

__all__ = ["SAFETY", "Measured", "measured", "nearby", "safety_of"]

R = TypeVar("R")

SAFETY = 1.25
"""By how much an estimate exceeds the difference of two runs: the second one errs too."""

_FARTHEST = 3.0 * 2.0**-52
_GOLDEN = 0.5 * (5.0**0.5 - 1.0)


def nearby(values: Array) -> Array:
    """Return numbers that differ from these by roundings, up to three units in the last place.

    Each is moved in proportion to its size, as roundings do: a 0 stays 0, and a start 1e-300 off an invariant plane
    stays as close to it, so that nothing is moved that the computation keeps exactly.  The shares follow the golden
    ratio: those of neighbouring components differ by at least 0.38 of the whole range, so that a vector is turned as
    well as stretched.  Stretching alone, or moving all components alike, is a stable or neutral direction of many
    equilibria; shares as uneven as these are next to such a subspace of few systems only.

    Parameters
    ----------
    values : (..., d); states, or the data of another computation.

    Returns
    -------
    Array
        (..., d); the same for the same values.
    """
    return np.asarray(values * _factors(values.shape[-1]))


@cache
def _factors(count: int) -> Array:
    shares = 2.0 * ((np.arange(1, count + 1) * _GOLDEN) % 1.0) - 1.0
    return np.asarray(1.0 + _FARTHEST * shares)


@dataclass(frozen=True)
class Measured(Generic[R]):
    """A result from the start that was asked for, and how exact it is.

    other : the run it was compared with; error : the estimate; safety : by how much that exceeds their difference;
    status : of the error at the level that was asked for; cost : of all runs.
    """

    result: R
    other: R
    error: float
    safety: float
    status: Status
    cost: Cost


def safety_of(off: Array, before: Array) -> Array:
    """Return by what to multiply differences (n,) of two runs for estimates of their errors.

    Where a truncation error happens to be what the other start makes, the difference says nothing: an estimate is no
    less than a hundredth of the one `before` (n,), at a hundred times the tolerance; 0 where there was none.
    """
    return np.maximum(SAFETY, before / (100.0 * np.maximum(off, 1e-300)))


def measured(level: Level, run: Callable[[Level, int], tuple[R, int]], apart: Callable[[R, R], float]) -> Measured[R]:
    """Return a computation with its error estimate, within the promise of the level where double precision allows that.

    The first run is compared with one that is more exact and starts nearby.  Where they are too far apart, the next one
    is more exact again, and so on down to the floor of double precision; every second run has the start itself, and the
    last of these is the result.  A new run is needed for each new tolerance only.

    Parameters
    ----------
    level : order and tolerance of the first run, and the error that is promised.
    run(level, steps) : computes the result at a level, from a start `nearby` where that is `aside`, and counts its
        steps; steps : those of all runs before.
    apart : the difference of two results, in the units of the promise.

    Returns
    -------
    Measured
        Its error is an estimate for the less exact of the two runs, so for the result too.
    """
    begun = time.perf_counter()
    current, error = level, 0.0
    first, steps = run(current, 0)
    while True:
        go_on()
        tighter = current.tightened()
        second, taken = run(tighter, steps)
        steps += taken
        off = apart(first, second)
        safety = float(safety_of(np.array(off), np.array(error))) if 0.0 < error < math.inf else SAFETY
        error = safety * off + 2e-16
        if error <= level.promise or current.is_floor:
            both = (second, first) if current.aside else (first, second)
            return Measured(*both, error, safety, level.status(error), Cost(steps, (time.perf_counter() - begun) * 1e3))
        current, first = tighter, second
