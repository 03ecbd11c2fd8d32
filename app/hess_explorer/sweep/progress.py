"""How far a sweep is, and how long it still takes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

__all__ = ["Clock", "Progress", "Report", "reporting"]


@dataclass(frozen=True)
class Progress:
    """Cells done, those that a store had already among them, of all; seconds so far, and left (None: not known yet)."""

    done: int
    cells: int
    seconds: float
    left: float | None


Report = Callable[[Progress], None]


@contextmanager
def reporting(progress: bool | Report | None, cells: int, done: int) -> Iterator[Callable[[int], None]]:
    """A function that is told of each number of cells that are done, and tells the bar (True) or the function given."""
    if progress is None or progress is False:
        yield lambda more: None
    elif progress is True:
        from tqdm.auto import tqdm

        # None: not where nobody looks, as in a file.
        with tqdm(total=cells, initial=done, unit="cell", unit_scale=True, disable=None, dynamic_ncols=True) as bar:
            yield lambda more: (bar.update(more), None)[1]
    else:
        yield Clock(progress, cells, done)


class Clock:
    """Called with each number of cells that are done, it tells of all of them."""

    def __init__(self, report: Report, cells: int, done: int) -> None:
        self._report, self._cells, self._done, self._before = report, cells, done, done
        self._begun = time.monotonic()
        self(0)

    def __call__(self, more: int) -> None:
        """So many more cells are done."""
        self._done += more
        seconds, now = time.monotonic() - self._begun, self._done - self._before
        left = seconds / now * (self._cells - self._done) if now else None
        self._report(Progress(self._done, self._cells, seconds, left))
