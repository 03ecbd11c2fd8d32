"""The chart of one session: start it, stop it, and send its cells."""

from __future__ import annotations

import logging

import numpy as np

from hess_explorer.compute.budget import Abandoned
from hess_explorer.protocol.messages import (
    Answer,
    CellExplained,
    ChartCells,
    ChartEnded,
    ChartRequest,
    ContinueChart,
    ExplainCell,
    StartChart,
    StopChart,
)
from hess_explorer.sweep.chart import Chart, Side
from hess_explorer.sweep.charting import FAILED, Charting
from hess_explorer.sweep.work import version
from hess_mechanics.errors import ModelError

__all__ = ["Charts"]

logger = logging.getLogger("hess_explorer")


class Charts:
    """Manages the single chart of a session; it is independent of the scene and ends with the page."""

    def __init__(self) -> None:
        self._id: int | None = None
        self._charting: Charting | None = None

    def end(self) -> None:
        """Stop the computation, because the page has closed or another chart starts."""
        if self._charting is not None:
            self._charting.stop()
            self._charting = None

    def answer(self, request: ChartRequest) -> Answer:
        """Process a request and return the response."""
        try:
            return self._answer(request)
        except ModelError as refusal:
            return Answer(chart=ChartEnded(self._id, str(refusal)))
        except Abandoned:
            raise
        # Log any error; the page waits for a response and must not show a traceback.
        except Exception:
            logger.exception("a chart could not be started")
            return Answer(chart=ChartEnded(self._id, FAILED))

    def _answer(self, request: ChartRequest) -> Answer:
        match request:
            case StartChart(chart, number):
                self.end()
                self._id = number
                self._charting = Charting(Chart.read(chart))
                return self._cells(0)
            case ContinueChart(known, number) if number == self._id:
                return self._cells(known)
            case StopChart() if self._charting is not None:
                self._charting.stop()
            case ExplainCell(chart, x, y):
                with np.errstate(all="ignore"):
                    return Answer(chart=CellExplained((x, y), Chart.read(chart).why(x, y)))
        return Answer()

    def _cells(self, known: int) -> Answer:
        """Return the cells after the first `known` ones, and the progress of the chart."""
        charting = self._charting
        if charting is None:
            return Answer(chart=ChartEnded(self._id, ""))
        # Read the progress before the cells: the page requests later cells once more.
        running, progress = charting.running, charting.progress
        where, values, status = charting.since(known)
        if not running and where.size == 0:
            # The browser has all cells.
            self._charting = None
        chart = charting.chart
        return Answer(
            chart=ChartCells(
                self._id,
                cells=where.size,
                first=min(max(known, 0), progress.cells),
                running=running,
                reason=charting.reason,
                done=progress.done,
                of=progress.cells,
                left=progress.left,
                level=chart.level.name,
                error=charting.error,
                version=version(),
                x=_side(chart.x),
                y=_side(chart.y),
            ),
            cells=values.astype("<f8").tobytes() + where.astype("<i4").tobytes() + status.tobytes(),
        )


def _side(side: Side) -> tuple[str, float, float, int]:
    """Return an axis of the chart after clamping."""
    return side.name, side.low, side.high, side.count
