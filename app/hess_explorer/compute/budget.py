"""How much an answer, or a piece behind it, may cost: what takes longer is refused with a sentence, between two
computations of it, and between two parts of a long one."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.jit import seconds_compiling
from hess_mechanics.numerics.patience import limited_by

__all__ = ["SECONDS", "WAIT", "Abandoned", "Budget", "OverBudget", "check", "limited"]

SECONDS = 4.0
"""Of the processor, all cores together, for one answer; what is compiled meanwhile is compiled once, and apart."""

WAIT = 60.0
"""Seconds by the clock, on a machine that has much else to do."""


class Abandoned(Exception):
    """Nobody waits for the answer any more."""


class OverBudget(WorkLimit):
    """An answer has cost too much."""


class Budget:
    """Of the thread that makes it; others work for it."""

    def __init__(self, left: threading.Event, seconds: float, wait: float, what: str) -> None:
        self.left, self.seconds, self.wait, self.what = left, seconds, wait, what
        self._thread, self._began, self._compiled = threading.get_ident(), time.thread_time(), seconds_compiling()
        self.clock_ends = time.monotonic() + wait
        self._elsewhere, self._lock = 0.0, threading.Lock()

    def spend(self, seconds: float) -> None:
        """Another thread has worked."""
        with self._lock:
            self._elsewhere += seconds

    @property
    def spent(self) -> float:
        """Seconds of the processor, but for compiling; what this thread has done is known in it alone."""
        own = 0.0
        if threading.get_ident() == self._thread:
            own = max(0.0, time.thread_time() - self._began - (seconds_compiling() - self._compiled))
        return own + self._elsewhere


_budget: ContextVar[Budget | None] = ContextVar("budget", default=None)


@contextmanager
def limited(
    left: threading.Event, seconds: float = SECONDS, wait: float = WAIT, what: str = "This state"
) -> Iterator[Budget]:
    """What this thread computes inside is refused by `check` when that is used up, and abandoned once `left` is set.

    what : is computed, as the refusal says.
    """
    budget = Budget(left, seconds, wait, what)
    token = _budget.set(budget)
    try:
        with limited_by(check, budget.spend):
            yield budget
    finally:
        _budget.reset(token)


def check() -> None:
    """Raise `OverBudget` where the answer has cost too much, `Abandoned` where nobody waits for it."""
    budget = _budget.get()
    if budget is None:
        return
    if budget.left.is_set():
        raise Abandoned
    if budget.spent > budget.seconds:
        raise OverBudget(
            f"{budget.what} takes more than {budget.seconds:g} s to compute, and no more is given to one: "
            "choose a shorter time span, fewer orbits or a cheaper accuracy."
        )
    if time.monotonic() > budget.clock_ends:
        raise OverBudget(
            f"The server is too busy to compute this state within {budget.wait:g} s: try again later, or "
            "choose a shorter time span or a cheaper accuracy."
        )
