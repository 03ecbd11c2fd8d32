"""Trade between speed and accuracy: time and error of a computation at each level, measured on this machine."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal, TypeVar

from hess_mechanics.numerics.accuracy import LEVELS, PLANS, REFERENCE, STANDARD, Kind, Plan
from hess_mechanics.numerics.patience import go_on

__all__ = ["Alike", "LevelCost", "beyond", "enough", "measure"]

R = TypeVar("R")
Alike = Literal["", "share", "cells"]
"""Part of a plan in which the truth is that of the measured level; empty for none."""

_TWICE = {Kind.ROTATION: "share", Kind.LINE: "share", Kind.CURVE: "cells"}
"""Part of a plan that limits the error of a kind besides the tolerance, so that its own value would hide this error."""


@dataclass(frozen=True)
class LevelCost:
    """Cost of a computation at one level.

    level : name; ms : milliseconds; error : distance from the truth, NaN if the result has nothing to compare;
    complete : True if the level computes all points at full resolution.
    """

    level: str
    ms: float
    error: float
    complete: bool

    @property
    def is_measured(self) -> bool:
        """True if there is an error."""
        return not math.isnan(self.error)


def beyond(kind: Kind) -> Plan:
    """Return the plan of the truth: finer tolerance than `reference`; twice its returns or points along a curve.

    For basins and indicators the level is `aside`: their points lie beside the centres of the cells.
    """
    finest = PLANS[kind][REFERENCE.name]
    more = {name: 2.0 * getattr(finest, name) for name in (_TWICE[kind],)} if kind in _TWICE else {}
    return replace(finest, level=finest.level.tighter(), **more)


def measure(
    kind: Kind, run: Callable[[Plan], R], error: Callable[[R, R], float], repeats: int = 1, alike: Alike = ""
) -> Iterator[LevelCost]:
    """Yield the cost of a computation at each level, cheapest first; a level runs when its cost is taken.

    error(result, truth) : distance of a result from that of the plan `beyond`; repeats : number of runs, of which the
    fastest counts; alike : as in `Alike`, for results at other points than those of another level.  Raises what `run`
    raises.
    """

    @cache
    def truth(own: float) -> R:
        same: dict[str, Any] = {alike: own} if alike else {}
        return run(replace(beyond(kind), **same))

    def exact(plan: Plan) -> R:
        """Return the truth for the result of a plan; plans that are alike share it."""
        return truth(getattr(plan, alike) if alike else 1.0)

    # The costliest first: it fails if any does.
    exact(PLANS[kind][REFERENCE.name])
    for name in LEVELS:
        plan, seconds = PLANS[kind][name], []
        known = exact(plan)
        for _ in range(repeats):
            go_on()
            start = time.perf_counter()
            result = run(plan)
            seconds.append(time.perf_counter() - start)
        complete = plan.share >= 1.0 and plan.cells >= 1.0
        yield LevelCost(plan.level.name, 1e3 * min(seconds), error(result, known), complete)


def enough(samples: Iterable[LevelCost], largest: float) -> str:
    """Return the first complete level whose error is at most `largest`, or the last level.

    If `largest` is the largest invisible error, more accuracy would make no visible difference.  Without any
    measurement it is `standard`.
    """
    last = STANDARD.name
    for one in samples:
        if one.complete and one.error <= largest:
            return one.level
        if one.is_measured:
            last = REFERENCE.name
    return last
