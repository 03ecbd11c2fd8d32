"""One user's session: the single place where a change becomes a computation and a picture.

A change only notes what is wanted.  The newest state is computed and sent when the browser has
painted the one before the last: a fast drag skips states, it never queues them.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any

from bokeh.document import Document
from panel.io.document import unlocked

from app.components import Ready
from app.scenes.base import Report, Scene, Stage
from app.state import Number, Value, Values, encode
from app.wire import Wire
from models.errors import ModelError

__all__ = ["Session"]

logger = logging.getLogger("hess_explorer")

IN_FLIGHT = 2
"""States sent and not yet painted, at most."""

PATIENCE = 1.0
"""Seconds after which a browser that does not answer is no longer waited for."""


class Session:
    """Wanted values → admitted values → result → pictures.

    Parameters
    ----------
    scene : what is shown; stage : its pictures.
    values : the state to begin with; notes : what had to be changed in the link.
    report : called with (admitted values, report) inside each update, to bring the controls up to date.
    """

    def __init__(self, scene: Scene, stage: Stage, ready: Ready, values: Values, notes: list[str],
                 report: Callable[[dict[str, Value], Report], None]) -> None:
        self.scene = scene
        self.stage = stage
        self.ready = ready
        self._specs = {spec.name: spec for spec in scene.specs}
        self._wanted = dict(values)
        self._link_notes = notes
        self._report = report
        self._hold_axes = False
        self._wire = Wire()
        self._document: Document | None = None
        self._scheduled = False
        self._number = 0
        self._sent_at = 0.0
        self.values: dict[str, Value] = {}
        ready.param.watch(lambda _: self._schedule(), ["requested", "painted"])
        ready.param.watch(self._on_pick, "picked")
        self._dirty = True

    def attach(self, document: Document) -> None:
        """Draw the first state into this document; later changes are scheduled on it."""
        self._draw()
        self._number = 1
        self.ready.sequence = {"number": 1, "answers": 0, "tree": {}}
        self.stage.connect(self._wire)
        self._document = document

    def change(self, values: Values, hold_axes: bool = False) -> None:
        """The user wants these values; `hold_axes` while a slider is being moved."""
        before = dict(self._wanted)
        self._link_notes = []
        for name, value in values.items():
            spec = self._specs.get(name)
            if isinstance(spec, Number):
                self._wanted[name], note = spec.admit(float(value))
                if note:
                    self._link_notes.append(note)
            elif spec is not None:
                self._wanted[name], _ = spec.read(str(value))
        # When a slider is let go its value is sent again: then only the axes may have to follow.
        self._dirty |= self._wanted != before or (self._hold_axes and not hold_axes)
        self._hold_axes = hold_axes
        self._schedule()

    def reset(self) -> None:
        """Back to the scene's defaults."""
        self.change(self.scene.defaults())

    def _on_pick(self, event: Any) -> None:
        picture, x, y = event.new[:3]
        self.change(self.stage.pick(str(picture), float(x), float(y)))

    def _schedule(self) -> None:
        if self._document is not None and not self._scheduled:
            self._scheduled = True
            # The browser sends a value and right after it the number of the request: answer both at once.
            self._document.add_timeout_callback(self._update, 2)

    def _update(self) -> None:
        self._scheduled = False
        waiting = self._number - self.ready.painted >= IN_FLIGHT
        if self._dirty and waiting and time.monotonic() - self._sent_at < PATIENCE:
            # `painted` brings us back, or a browser that does not answer is given up.
            self._document.add_timeout_callback(self._schedule, int(1000 * PATIENCE))
            return
        answered = self.ready.sequence["answers"] == self.ready.requested
        if not self._dirty and answered:
            return
        with unlocked():
            if self._dirty:
                self._draw()
            self._number += 1
            tree, self.ready.block = self._wire.pack()
            self.ready.sequence = {"number": self._number, "answers": self.ready.requested, "tree": tree}
        self._sent_at = time.monotonic()

    def _draw(self) -> None:
        self._dirty = False
        admitted, notes = self.scene.admit(self._wanted)
        self.values = admitted
        try:
            report = self.stage.show(self.scene.compute(admitted), self._hold_axes)
        except ModelError as error:
            self.stage.fail(str(error))
            report = Report([], str(error))
        except Exception:
            logger.exception("a computation failed at %s", encode(admitted))
            sentence = "This state could not be computed. Press Reset, and please report the link."
            self.stage.fail(sentence)
            report = Report([], sentence)
        self._report(admitted, Report(report.derived, report.status, [*self._link_notes, *notes, *report.notes]))
        self.ready.query = encode(admitted)
