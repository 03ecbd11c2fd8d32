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


Report = Callable[[Progress], None]


@contextmanager
def reporting(progress: bool | Report | None, cells: int, done: int) -> Iterator[Callable[[int], None]]:
    """Yield a callback for each number of finished cells, which updates a progress bar (True) or calls `progress`."""
    if progress is None or progress is False:
        yield lambda more: None
    elif progress is True:
        from tqdm.auto import tqdm

        # None disables a bar of text unless stderr is a terminal; the one of a notebook is always shown.
        hidden = False if _in_notebook() else None
        with tqdm(total=cells, initial=done, unit="cell", unit_scale=True, disable=hidden, dynamic_ncols=True) as bar:
            yield lambda more: (bar.update(more), None)[1]
    else:
        yield Clock(progress, cells, done)


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
