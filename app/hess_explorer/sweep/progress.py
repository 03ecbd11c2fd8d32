"""Progress and remaining time of a sweep."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

__all__ = ["Progress", "Report", "reporting"]


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
def reporting(progress: bool | Report | None, cells: int, before: int) -> Iterator[Callable[[int], None]]:
    """Yield a callback for each number of finished cells, for a progress bar or log (True) or `progress`."""
    done, begun, following = before, time.monotonic(), _EVERY

    def log(found: Progress) -> None:
        nonlocal following
        if found.seconds >= following:
            following = found.seconds + _EVERY
            left = "" if found.left is None else f", about {found.left:.0f} s left"
            print(f"{found.done} of {cells} cells after {found.seconds:.0f} s{left}", file=sys.stderr, flush=True)

    def count(more: int) -> None:
        nonlocal done
        done += more
        seconds = time.monotonic() - begun
        left = seconds / (done - before) * (cells - done) if done > before else None
        report(Progress(done, cells, seconds, left))

    if progress is True and (sys.stderr.isatty() or _in_notebook()):
        from tqdm.auto import tqdm

        with tqdm(total=cells, initial=before, unit="cell", unit_scale=True, dynamic_ncols=True) as bar:
            yield lambda more: (bar.update(more), None)[1]
        return
    report = log if progress is True else progress or (lambda found: None)
    count(0)
    yield count


def _in_notebook() -> bool:
    """Return True in a kernel of Jupyter, whose stderr is not a terminal but is shown."""
    kernel = sys.modules.get("IPython")
    return kernel is not None and "IPKernelApp" in getattr(kernel.get_ipython(), "config", {})
