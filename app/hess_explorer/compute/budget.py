"""Time budgets of responses and background tasks.

`check` is called between computations, and between the parts of a long one.  It raises when the budget is used up.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.jit import compile_seconds
from hess_mechanics.numerics.patience import work_limit

SECONDS = 4.0
"""CPU time limit of one response in seconds, summed over all cores; compilation is not counted."""

WAIT = 60.0
"""Wall-clock limit of one response in seconds, for a busy machine."""


class ClientGone(Exception):
    """The client has disconnected, so the result is no longer needed."""


class OverBudget(WorkLimit):
    """A computation has exceeded its time budget."""


class Budget:
    """CPU and wall-clock budget of the answering thread; helpers charge their CPU time through `spend`.

    Parameters
    ----------
    cancellation : threading.Event
        Set when the client has disconnected.
    seconds, wait : float
        Limits of CPU time and of wall-clock time, in seconds.
    what : str
        Subject of the error message.
    """

    def __init__(self, cancellation: threading.Event, seconds: float, wait: float, what: str) -> None:
        self.cancellation, self.seconds, self.wait, self.subject = cancellation, seconds, wait, what
        self._thread, self._began, self._compiled = threading.get_ident(), time.thread_time(), compile_seconds()
        self.deadline = time.monotonic() + wait
        self._elsewhere, self._lock = 0.0, threading.Lock()

    def spend(self, seconds: float) -> None:
        """Charge the CPU time of another thread."""
        with self._lock:
            self._elsewhere += seconds

    @property
    def cpu_seconds(self) -> float:
        """CPU time spent, in seconds, without compilation.  Only the answering thread sees its own share."""
        own = 0.0
        if threading.get_ident() == self._thread:
            own = max(0.0, time.thread_time() - self._began - (compile_seconds() - self._compiled))
        return own + self._elsewhere


_budget: ContextVar[Budget | None] = ContextVar("budget", default=None)


@contextmanager
def time_budget(
    cancellation: threading.Event, seconds: float = SECONDS, wait: float = WAIT, what: str = "This state"
) -> Iterator[Budget]:
    """Give this thread a time budget; `check` raises when it is used up or the client has disconnected.

    Parameters
    ----------
    cancellation : threading.Event
        Set when the client has disconnected.
    seconds, wait : float
        Limits of CPU time and of wall-clock time, in seconds.
    what : str
        Subject of the error message.

    Yields
    ------
    Budget
        The budget.
    """
    budget = Budget(cancellation, seconds, wait, what)
    token = _budget.set(budget)
    try:
        with work_limit(check, budget.spend):
            yield budget
    finally:
        _budget.reset(token)


def check() -> None:
    """Raise `OverBudget` if the time budget is used up, `ClientGone` if the client has disconnected."""
    budget = _budget.get()
    if budget is None:
        return
    if budget.cancellation.is_set():
        raise ClientGone
    if budget.cpu_seconds > budget.seconds:
        raise OverBudget(
            f"{budget.subject} takes more than {budget.seconds:g} s to compute, which is the limit: "
            "choose a shorter time span, fewer orbits or a lower accuracy."
        )
    if time.monotonic() > budget.deadline:
        raise OverBudget(
            f"The server is too busy to compute this state within {budget.wait:g} s: try again later, or "
            "choose a shorter time span or a lower accuracy."
        )
