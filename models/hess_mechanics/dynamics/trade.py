"""Trade between speed and accuracy: time and error of a computation at each level, measured on this machine."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal, TypeVar

from hess_mechanics.numerics.accuracy import LEVELS, PLANS, REFERENCE, STANDARD, Kind, Plan
from hess_mechanics.numerics.patience import check_limit

__all__ = ["LevelCost", "SharedSetting", "first_sufficient", "measure", "truth_plan"]

R = TypeVar("R")
SharedSetting = Literal["", "share", "cells"]
"""Setting of a plan that the truth takes from the measured level; empty for none."""

_TWICE = {Kind.ROTATION: "share", Kind.LINE: "share", Kind.CURVE: "cells"}
"""Setting that limits the error of a kind besides the tolerance.  The truth has twice its value: with an equal value
both results would share this error."""


@dataclass(frozen=True)
class LevelCost:
    """Cost of a computation at one level.

    Attributes
    ----------
    level : str
        Name of the level.
    ms : float
        Wall time, in milliseconds.
    error : float
        Distance from the truth, ≥ 0; NaN if there is nothing to compare.
    complete : bool
        True if the level computes all points at full resolution.
    """

    level: str
    ms: float
    error: float
    complete: bool

    @property
    def is_measured(self) -> bool:
        """True if an error was measured."""
        return not math.isnan(self.error)

    def suffices(self, largest: float) -> bool:
        """Return True if the level is complete and its error is small enough.

        Parameters
        ----------
        largest : float
            Largest error that is small enough.

        Returns
        -------
        bool
            False also if no error was measured.
        """
        return self.complete and self.error <= largest


def truth_plan(kind: Kind) -> Plan:
    """Return the plan of the reference result with which the levels of a kind of computation are compared.

    Its tolerance is finer than that of `reference`, and rotation numbers, lines and curves have twice as many returns
    or points.  Its level `is_perturbed`: basins and indicators then take other points than the centres of their cells.

    Parameters
    ----------
    kind : Kind
        Kind of the computation.

    Returns
    -------
    Plan
        The plan.
    """
    finest = PLANS[kind][REFERENCE.name]
    more = {name: 2.0 * getattr(finest, name) for name in (_TWICE[kind],)} if kind in _TWICE else {}
    return replace(finest, level=finest.level.tighter(), **more)


def measure(
    kind: Kind,
    run: Callable[[Plan], R],
    error: Callable[[R, R], float],
    repeats: int = 1,
    shared_setting: SharedSetting = "",
) -> Iterator[LevelCost]:
    """Yield the cost of a computation at each level, the cheapest first.

    A level runs when its cost is requested, the truth for `reference` before the first one.

    Parameters
    ----------
    kind : Kind
        Kind of the computation.
    run : callable
        Function from a plan to the result.
    error : callable
        Function error(result, truth) that returns the distance of a result from that of the plan `truth_plan`.
    repeats : int, default 1
        Number of runs of each level, at least 1, of which the fastest counts.
    shared_setting : {"", "share", "cells"}, default ""
        Setting that the truth takes from each level, if results can be compared only at an equal one.

    Yields
    ------
    LevelCost
        The cost of a level.

    Raises
    ------
    ModelError
        As `run`.
    """

    @cache
    def truth(own: float) -> R:
        same: dict[str, Any] = {shared_setting: own} if shared_setting else {}
        return run(replace(truth_plan(kind), **same))

    def exact(plan: Plan) -> R:
        """Return the truth for the result of a plan; plans with an equal shared setting have the same one."""
        return truth(getattr(plan, shared_setting) if shared_setting else 1.0)

    # Run the costliest plan first: if any plan fails, it does.
    exact(PLANS[kind][REFERENCE.name])
    for name in LEVELS:
        plan, seconds = PLANS[kind][name], []
        known = exact(plan)
        for _ in range(repeats):
            check_limit()
            start = time.perf_counter()
            result = run(plan)
            seconds.append(time.perf_counter() - start)
        complete = plan.share >= 1.0 and plan.cells >= 1.0
        yield LevelCost(plan.level.name, 1e3 * min(seconds), error(result, known), complete)


def first_sufficient(samples: Iterable[LevelCost], largest: float) -> str:
    """Return the name of the first complete level whose error is small enough, or else the last level.

    If `largest` is the largest invisible error, more accuracy would make no visible difference.

    Parameters
    ----------
    samples : iterable of LevelCost
        Costs of the levels, the cheapest first.
    largest : float
        Largest error that is small enough.

    Returns
    -------
    str
        Name of the level; "reference" if no error is small enough, "standard" without any measured error.
    """
    last = STANDARD.name
    for one in samples:
        if one.suffices(largest):
            return one.level
        if one.is_measured:
            last = REFERENCE.name
    return last
