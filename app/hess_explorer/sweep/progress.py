"""Progress and remaining time of a sweep."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

__all__ = ["Clock", "Progress", "Report", "reporting"]


@dataclass(frozen=True)
class Progress:
    """Progress of a sweep: cells done (including those from a store), total, seconds so far, seconds left or None."""

    done: int
    cells: int
    seconds: float
    left: float | None


_EVERY = 30.0
"""Seconds between two lines of progress in a log."""
Report = Callable[[Progress], None]


@contextmanager
def reporting(progress: bool | Report | None, cells: int, done: int) -> Iterator[Callable[[int], None]]:
    """Yield a callback for each number of finished cells, for a progress bar or log (True) or `progress`."""
    if progress is None or progress is False:
        yield lambda more: None
    elif progress is True and (sys.stderr.isatty() or _in_notebook()):
        from tqdm.auto import tqdm

        with tqdm(total=cells, initial=done, unit="cell", unit_scale=True, dynamic_ncols=True) as bar:
            yield lambda more: (bar.update(more), None)[1]
    else:
        yield Clock(_Log() if progress is True else progress, cells, done)


class _Log:
    """Report that prints a line every `_EVERY` seconds."""

    def __init__(self) -> None:
        self._next = _EVERY

    def __call__(self, found: Progress) -> None:
        if found.seconds >= self._next:
            self._next = found.seconds + _EVERY
            left = "" if found.left is None else f", about {found.left:.0f} s left"
            print(f"{found.done} of {found.cells} cells after {found.seconds:.0f} s{left}", file=sys.stderr, flush=True)


def _in_notebook() -> bool:
    """Return True in a kernel of Jupyter, whose stderr is not a terminal but is shown."""
    kernel = sys.modules.get("IPython")
    return kernel is not None and "IPKernelApp" in getattr(kernel.get_ipython(), "config", {})


class Clock:
    """Callback that adds up finished cells and reports a `Progress`."""

    def __init__(self, report: Report, cells: int, done: int) -> None:
        self._report, self._cells, self._done, self._before = report, cells, done, done
        self._begun = time.monotonic()
        self(0)

    def __call__(self, more: int) -> None:
        """Count `more` finished cells."""
        self._done += more
        seconds, now = time.monotonic() - self._begun, self._done - self._before
        left = seconds / now * (self._cells - self._done) if now else None
        self._report(Progress(self._done, self._cells, seconds, left))
