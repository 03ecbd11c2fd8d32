"""How long who asked is ready to wait: long computations ask between their parts whether to go on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

__all__ = ["go_on", "limited_by", "worked"]

_asked: ContextVar[tuple[Callable[[], None], Callable[[float], None]] | None] = ContextVar("patience", default=None)


@contextmanager
def limited_by(check: Callable[[], None], spend: Callable[[float], None]) -> Iterator[None]:
    """What is computed inside calls check() between its parts, which may raise, and tells spend(seconds) what other
    threads have worked for it."""
    token = _asked.set((check, spend))
    try:
        yield
    finally:
        _asked.reset(token)


def go_on() -> None:
    """Raise what the one who asked raises, where that one does not want to wait any longer."""
    asked = _asked.get()
    if asked is not None:
        asked[0]()


def worked(seconds: float) -> None:
    """Another thread has worked for so long, in seconds of the processor, for the one who asked."""
    asked = _asked.get()
    if asked is not None:
        asked[1](seconds)
