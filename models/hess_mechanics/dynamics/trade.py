"""What accuracy costs: time and error of one computation at each level, measured here and now."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TypeVar

from hess_mechanics.numerics.accuracy import LEVELS, PLANS, REFERENCE, Computation, Plan
from hess_mechanics.numerics.patience import go_on

__all__ = ["LevelCost", "beyond", "enough", "measure", "measure_until"]

R = TypeVar("R")


@dataclass(frozen=True)
class LevelCost:
    """One level: milliseconds, error, and whether all that was asked for is computed, none left out, no cell larger."""

    level: str
    ms: float
    error: float
    complete: bool


def beyond(kind: Computation) -> Plan:
    """More exact than `reference`, with other steps, and as fine: what errors are measured against."""
    finest = PLANS[kind][REFERENCE.name]
    return replace(finest, level=finest.level.tightened())


def _sample(plan: Plan, run: Callable[[Plan], R], error: Callable[[R, R], float], truth: R, repeats: int) -> LevelCost:
    best = float("inf")
    for _ in range(repeats):
        go_on()
        start = time.perf_counter()
        result = run(plan)
        best = min(best, time.perf_counter() - start)
    return LevelCost(plan.level.name, 1e3 * best, error(result, truth), plan.share >= 1.0 and plan.cells >= 1.0)


def measure(
    kind: Computation, run: Callable[[Plan], R], error: Callable[[R, R], float], repeats: int = 1
) -> tuple[LevelCost, ...]:
    """A computation at each level, from the cheapest on.

    error(result, truth) : how far a result is from that of the plan `beyond`; repeats : of which the fastest counts.
    Raises what `run` raises.
    """
    truth = run(beyond(kind))
    return tuple(_sample(PLANS[kind][name], run, error, truth, repeats) for name in LEVELS)


def measure_until(kind: Computation, run: Callable[[Plan], R], error: Callable[[R, R], float], largest: float) -> str:
    """The level that `enough` finds, without the cost of those above it."""
    truth = run(beyond(kind))
    return enough((_sample(PLANS[kind][name], run, error, truth, 1) for name in LEVELS), largest)


def enough(samples: Iterable[LevelCost], largest: float) -> str:
    """The first level that computes all that was asked for with an error of at most `largest`, or the last level.

    More accuracy than that changes nothing that can be seen, if `largest` is what can just not be seen.
    """
    return next((one.level for one in samples if one.complete and one.error <= largest), REFERENCE.name)
