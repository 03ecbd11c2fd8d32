"""The chart of one session: starts and stops it, and answers with the cells that are known."""

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
    """One chart at a time, whatever scene is on show; it ends with the page."""

    def __init__(self) -> None:
        self._id: int | None = None
        self._charting: Charting | None = None

    def end(self) -> None:
        """Stop computing: the page is gone, or another chart begins."""
        if self._charting is not None:
            self._charting.stop()
            self._charting = None

    def answer(self, request: ChartRequest) -> Answer:
        """Do what a request says, and return what the page is told."""
        try:
            return self._answer(request)
        except ModelError as refusal:
            return Answer(chart=ChartEnded(self._id, str(refusal)))
        except Abandoned:
            raise
        # Whatever it is, the page waits for an answer and shows no traceback; the log says all.
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
        """Return the cells that have come since so many were known, and how far the chart is."""
        charting = self._charting
        if charting is None:
            return Answer(chart=ChartEnded(self._id, ""))
        # Before the cells: what comes meanwhile is asked for once more.
        running, progress = charting.running, charting.progress
        where, values, status = charting.since(known)
        if not running and where.size == 0:
            # The browser has it all.
            self._charting = None
        chart = charting.chart
        return Answer(
            chart=ChartCells(
                self._id,
                cells=where.size,
                first=min(max(known, 0), progress.cells),
                running=running,
                said=charting.said,
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
    """Return a side as it is after it was clamped."""
    return side.name, side.low, side.high, side.count
