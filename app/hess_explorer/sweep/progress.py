"""Progress and remaining time of a sweep."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NamedTuple


class Progress(NamedTuple):
    """Progress of a sweep.

    Attributes
    ----------
    done : int
        Number of finished cells, including those from a store.
    cells : int
        Total number of cells.
    seconds : float
        Wall time of this run so far, in seconds.
    remaining : float or None
        Estimated remaining time in seconds; None until this run has finished a cell.
    """

    done: int
    cells: int
    seconds: float
    remaining: float | None


_EVERY = 30.0
"""Seconds between two progress bars in a log."""
Report = Callable[[Progress], None]


@contextmanager
def progress_report(progress: bool | Report | None, cells: int, before: int) -> Iterator[Callable[[int], object]]:
    """Yield a function that adds a number of finished cells to the progress bar, or reports the sum to `progress`.

    Parameters
    ----------
    progress : bool, callable or None
        True for a progress bar; a function is called with a `Progress` at once and after each addition.
    cells : int
        Total number of cells.
    before : int
        Number of cells that are already finished.
    """
    if not callable(progress):
        from tqdm.auto import tqdm

        # A notebook shows stderr although it is not a terminal.
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
