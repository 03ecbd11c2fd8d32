"""One user's session: the single place where a change becomes a computation and a picture.

A change only notes what is wanted.  The newest state is computed and sent when the browser has
painted the one before the last: a fast drag skips states, it never queues them.
"""

from __future__ import annotations

import json
import logging
import math
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

    A change by `change` or `reset` only notes what is wanted.  The browser sends a request after
    each change; that, or a state painted, is what makes `update` compute and send.

    Parameters
    ----------
    scene : what is shown; stage : its pictures.
    values : the state to begin with; notes : what had to be changed in the link.
    show : called with the admitted values inside each update, to bring the controls up to date.
    """

    def __init__(self, scene: Scene, stage: Stage, ready: Ready, values: Values, notes: list[str],
                 show: Callable[[dict[str, Value]], None]) -> None:
        self.scene = scene
        self.stage = stage
        self.ready = ready
        self.values: dict[str, Value] = {}
        self._specs = {spec.name: spec for spec in scene.specs}
        self._wanted = dict(values)
        self._link_notes = notes
        self._show = show
        self._hold_axes = False
        self._dirty = True
        self.wire = Wire()
        self._document: Document | None = None
        self._number = 0
        self._painted = 0
        self._requested = 0
        self._answered = 0
        self._sent_at = 0.0
        self._later: Any = None
        ready.on_msg(lambda event: self._receive(event.data))

    def attach(self, document: Document) -> None:
        """Draw the first state into this document; later ones are sent to its browser."""
        self._draw()
        self._number = 1
        self._send()
        self.stage.connect(self.wire)
        self._document = document

    def change(self, values: Values) -> None:
        """The user wants these values."""
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
        self._dirty |= self._wanted != before or bool(self._link_notes)

    def reset(self) -> None:
        """Back to the scene's defaults."""
        self.change(self.scene.defaults())

    def update(self) -> None:
        """Compute and send what is wanted, unless the browser is still busy with earlier states."""
        waiting = self._number - self._painted >= IN_FLIGHT
        if self._dirty and waiting and time.monotonic() - self._sent_at < PATIENCE:
            if self._later is None and self._document is not None:
                # "painted" brings us back; a browser that never says it is given up.
                self._later = self._document.add_timeout_callback(self._give_up, int(1100 * PATIENCE))
            return
        if not self._dirty and self._answered == self._requested:
            return
        with unlocked():
            if self._dirty:
                self._draw()
            self._number += 1
            self._answered = self._requested
            self._send()
        self._sent_at = time.monotonic()

    def _give_up(self) -> None:
        self._later = None
        self.update()

    def _send(self) -> None:
        tree, block = self.wire.pack()
        state = json.dumps({
            "number": self._number, "answers": self._answered, "query": encode(self.values), "tree": tree,
        })
        # In this order: the state says how to read the block.
        self.ready.block = block
        self.ready.state = state

    def _receive(self, message: Any) -> None:
        """A message of the browser: nothing in it is trusted."""
        if not isinstance(message, dict):
            return
        picked = message.get("picked")
        if isinstance(picked, list) and len(picked) == 3 and isinstance(picked[0], str):
            x, y = (float(z) if isinstance(z, int | float) else math.nan for z in picked[1:])
            if math.isfinite(x) and math.isfinite(y):
                self.change(self.stage.pick(picked[0], x, y))
        requested, painted = message.get("requested"), message.get("painted")
        if isinstance(requested, int):
            self._requested = requested
            held = message.get("held") is True
            # When a slider is let go, the axes may have to follow.
            self._dirty |= self._hold_axes and not held
            self._hold_axes = held
        if isinstance(painted, int):
            self._painted = min(painted, self._number)
        self.update()

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
        self._show(admitted)
        self.wire.say("status", report.status)
        self.wire.say("notes", "\n".join([*self._link_notes, *notes, *report.notes]))
        self.wire.say("derived", "\n".join(report.derived))
