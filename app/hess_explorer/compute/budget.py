"""How much one answer may cost: what takes longer is refused with a sentence, between two computations of it."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from hess_mechanics.errors import WorkLimit

__all__ = ["SECONDS", "WAIT", "Abandoned", "OverBudget", "check", "limited"]

SECONDS = 10.0
"""Of the processor, for one answer."""

WAIT = 60.0
"""Seconds by the clock, on a machine that has much else to do."""


class Abandoned(Exception):
    """Nobody waits for the answer any more."""


class OverBudget(WorkLimit):
    """An answer has cost too much."""


class _Budget:
    def __init__(self, left: threading.Event, seconds: float, wait: float) -> None:
        self.left, self.seconds, self.wait = left, seconds, wait
        self.work_ends, self.clock_ends = time.thread_time() + seconds, time.monotonic() + wait


_budget: ContextVar[_Budget | None] = ContextVar("budget", default=None)


@contextmanager
def limited(left: threading.Event, seconds: float = SECONDS, wait: float = WAIT) -> Iterator[None]:
    """What this thread computes inside is refused by `check` when that is used up, and abandoned once `left` is set."""
    token = _budget.set(_Budget(left, seconds, wait))
    try:
        yield
    finally:
        _budget.reset(token)


def check() -> None:
    """Raise `OverBudget` where the answer has cost too much, `Abandoned` where nobody waits for it."""
    budget = _budget.get()
    if budget is None:
        return
    if budget.left.is_set():
        raise Abandoned
    if time.thread_time() > budget.work_ends:
        raise OverBudget(f"This state takes more than {budget.seconds:g} s to compute, and no more is given to one: "
                        "choose a shorter time span, fewer orbits or a cheaper accuracy.")
    if time.monotonic() > budget.clock_ends:
        raise OverBudget(f"The server is too busy to compute this state within {budget.wait:g} s: try again later, or "
                        "choose a shorter time span or a cheaper accuracy.")
