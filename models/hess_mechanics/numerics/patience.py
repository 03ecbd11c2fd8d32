"""Cancellation and CPU budget of a request: long computations call `check_limit` between their parts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

__all__ = ["charge", "check_limit", "work_limit"]

_asked: ContextVar[tuple[Callable[[], None], Callable[[float], None]] | None] = ContextVar("patience", default=None)


@contextmanager
def work_limit(check: Callable[[], None], spend: Callable[[float], None]) -> Iterator[None]:
    """Run the body of the `with` statement under a limit, which replaces any outer one.

    Parameters
    ----------
    check : callable
        Function that computations call between their parts; it may raise.
    spend : callable
        Function that receives the CPU seconds of helper threads, which call it themselves.

    Yields
    ------
    None
        Nothing.
    """
    token = _asked.set((check, spend))
    try:
        yield
    finally:
        _asked.reset(token)


def check_limit() -> None:
    """Call the check of `work_limit`, which raises if the request is cancelled or has used up its budget.

    Does nothing without a limit.
    """
    limit = _asked.get()
    if limit is not None:
        limit[0]()


def charge(seconds: float) -> None:
    """Charge CPU seconds of a helper thread to the request; do nothing without a limit.

    Parameters
    ----------
    seconds : float
        CPU time, in seconds.
    """
    limit = _asked.get()
    if limit is not None:
        limit[1](seconds)
