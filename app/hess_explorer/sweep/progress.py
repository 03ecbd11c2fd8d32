"""Progress and remaining time of a sweep."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NamedTuple

__all__ = ["Progress", "Report", "reporting"]


class Progress(NamedTuple):
    """Progress of a sweep: cells done (including those from a store), total, seconds so far, seconds left or None."""

    done: int
    cells: int
    seconds: float
    left: float | None


_EVERY = 30.0
"""Seconds between two bars in a log."""
Report = Callable[[Progress], None]


@contextmanager
def reporting(progress: bool | Report | None, cells: int, before: int) -> Iterator[Callable[[int], object]]:
    """Yield a callback for each number of finished cells, for a progress bar (True) or `progress`."""
    if not callable(progress):
        from tqdm.auto import tqdm

        # The stderr of a notebook is not a terminal but is shown.
        is_seen = sys.stderr.isatty() or "ipykernel" in sys.modules
        wait = {} if is_seen else {"mininterval": _EVERY, "delay": _EVERY}
        with tqdm(
            total=cells, initial=before, unit="cell", unit_scale=True, dynamic_ncols=True, disable=not progress, **wait
        ) as bar:
            yield bar.update
        return
    done, begun = before, time.monotonic()

    def count(more: int) -> None:
        nonlocal done
        done += more
        seconds = time.monotonic() - begun
        progress(Progress(done, cells, seconds, seconds / (done - before) * (cells - done) if done > before else None))

    count(0)
    yield count
