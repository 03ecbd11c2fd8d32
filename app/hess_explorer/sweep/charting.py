"""Background computation of a chart in short pieces, which alternate with other work."""

from __future__ import annotations

import logging
import threading
import time

import numpy as np

from hess_explorer.compute.background import run_in_steps
from hess_explorer.compute.budget import Abandoned, OverBudget, limited
from hess_explorer.sweep.chart import Chart, Indices
from hess_explorer.sweep.progress import Clock, Progress
from hess_explorer.sweep.quantity import Outcomes
from hess_mechanics.numerics.results import Array

__all__ = ["SECONDS", "Charting"]

logger = logging.getLogger("hess_explorer")

SECONDS = 60.0
"""CPU time limit of a chart in seconds."""
_PIECE = 0.2
"""Target duration of a piece in seconds."""
_MOST = 4096
"""Maximum number of cells of a piece."""

STOPPED = "Stopped."
USED_UP = (
    f"The chart was stopped after {SECONDS:g} s of processor time, the limit: choose fewer cells, a cheaper accuracy "
    "or a shorter time."
)
FAILED = "This chart could not be computed. Please report the link."


class Charting:
    """Computes a chart on one core until it is complete, stopped or out of time.

    Attributes
    ----------
    error : largest estimated error so far, None without an estimate.
    progress : progress of the computation.
    running : True while more cells are to come.
    reason : reason for an early end, otherwise empty.
    """

    def __init__(self, chart: Chart, seconds: float = SECONDS) -> None:
        self.chart, self.reason, self.running = chart, "", True
        self._order = chart.order
        self._values, self._status = np.full(chart.cells, np.nan), np.zeros(chart.cells, np.uint8)
        self.error: float | None = None
        self._done, self._size, self._left_to_spend = 0, 1, seconds
        self._stopped = threading.Event()
        self._lock = threading.Lock()
        self.progress = Progress(0, chart.cells, 0.0, None)
        self._tell = Clock(self._hear, chart.cells, 0)
        run_in_steps(self._step)

    def stop(self) -> None:
        """Stop the computation and keep the known cells."""
        self._stopped.set()
        self._end(STOPPED)

    def since(self, first: int) -> tuple[Indices, Array, Outcomes]:
        """Return indices, values and status of the known cells from `first` on, in order of computation."""
        with self._lock:
            own = self._order[min(max(first, 0), self._done) : self._done]
            return own, self._values[own], self._status[own]

    def _hear(self, progress: Progress) -> None:
        self.progress = progress

    def _end(self, reason: str) -> None:
        with self._lock:
            if self.running:
                self.running, self.reason = False, reason

    def _step(self) -> bool:
        """Compute one piece; return True if more remain."""
        if not self.running:
            return False
        piece = self._order[self._done : self._done + self._size]
        began = time.perf_counter()
        try:
            with limited(self._stopped, self._left_to_spend) as budget, np.errstate(all="ignore"):
                found = self.chart.compute(piece)
                self._left_to_spend -= budget.spent
        except Abandoned:
            return False
        except OverBudget:
            self._end(USED_UP)
            return False
        # Report any error: if the worker died silently, the page would wait for ever.
        except Exception:
            logger.exception("a chart failed: %s", self.chart)
            self._end(FAILED)
            return False
        cost = (time.perf_counter() - began) / piece.size
        self._size = int(min(max(1.0, _PIECE / max(cost, 1e-9)), 4.0 * self._size, _MOST))
        with self._lock:
            self._values[piece], self._status[piece] = found.values, found.status
            self._done += piece.size
            known = found.errors[np.isfinite(found.errors)]
            if known.size:
                self.error = max(float(known.max()), self.error or 0.0)
        self._tell(piece.size)
        if self._done == self.chart.cells:
            self._end("")
        elif self._left_to_spend <= 0.0:
            self._end(USED_UP)
        return self.running
