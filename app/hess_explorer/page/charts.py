"""The chart of one session: what the browser asks of it, and what it is told."""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Callable, Mapping
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.budget import Abandoned
from hess_explorer.page.wanted import as_float
from hess_explorer.sweep.chart import Chart
from hess_explorer.sweep.charting import FAILED, Charting
from hess_explorer.sweep.work import version
from hess_mechanics.errors import ModelError

__all__ = ["Charts"]

logger = logging.getLogger("hess_explorer")


class Page(Protocol):
    """What it speaks to: see `Desk`, whose attributes these are."""

    cells: bytes
    chart: str

    def on_msg(self, handle: Callable[[Any], object]) -> None:
        """Have each message handled, as its `data`."""


class Charts:
    """One chart at a time, whatever scene is on show; it is gone with the page.

    Messages are {"chart": …} with

    - {"start": what `Chart.read` takes, "id": number}: a chart in place of the one before;
    - {"more": how many cells are known, "id": number}: those that have been computed since;
    - {"stop": true}; {"why": what `Chart.read` takes, "at": [x, y]}: how a cell ends.
    """

    def __init__(self, page: Page) -> None:
        self._page = page
        self._number = 0
        self._id: int | None = None
        self._charting: Charting | None = None
        page.on_msg(lambda event: self._receive(event.data))

    def end(self) -> None:
        """The page is gone."""
        if self._charting is not None:
            self._charting.stop()
            self._charting = None

    def _receive(self, message: Any) -> None:
        """A message of the browser: nothing in it is trusted."""
        asked = message.get("chart") if isinstance(message, dict) else None
        if not isinstance(asked, dict):
            return
        try:
            self._handle(asked)
        except ModelError as refusal:
            self._tell(said=str(refusal), running=False)
        except Abandoned:
            raise
        # Whatever it is, the page waits for an answer and shows no traceback; the log says all.
        except Exception:
            logger.exception("a chart could not be begun")
            self._tell(said=FAILED, running=False)

    def _handle(self, asked: Mapping[Any, Any]) -> None:
        match asked:
            case {"start": dict(given), "id": int(number)}:
                self.end()
                self._id = number
                self._charting = Charting(Chart.read(given))
                self._send(0)
            case {"more": int(known), "id": int(number)}:
                if number == self._id:
                    self._send(known)
            case {"stop": True}:
                if self._charting is not None:
                    self._charting.stop()
            case {"why": dict(given), "at": [x, y]}:
                place = as_float(x), as_float(y)
                if all(map(math.isfinite, place)):
                    with np.errstate(all="ignore"):
                        self._tell(at=list(place), why=Chart.read(given).why(*place))

    def _send(self, known: int) -> None:
        """The cells that have come since so many were known, and how far it is."""
        charting = self._charting
        if charting is None:
            return self._tell(said="", running=False, cells=0)
        # Before the cells: what comes meanwhile is asked for once more.
        running, progress = charting.running, charting.progress
        where, values, status = charting.since(known)
        self._page.cells = b"".join([values.astype("<f8").tobytes(), where.astype("<i4").tobytes(), status.tobytes()])
        self._tell(cells=int(where.size), first=min(max(known, 0), progress.cells), running=running,
                   said=charting.said, done=progress.done, of=progress.cells, left=progress.left,
                   level=charting.chart.level.name, error=charting.error, version=version(),
                   x=_side(charting.chart.x), y=_side(charting.chart.y))
        if not running and where.size == 0:
            # The browser has it all.
            self._charting = None
        return None

    def _tell(self, **said: Any) -> None:
        self._number += 1
        self._page.chart = json.dumps({"number": self._number, "id": self._id, **said})


def _side(side: Any) -> list[Any]:
    """As it is after it was clamped."""
    return [side.name, side.low, side.high, side.count]
