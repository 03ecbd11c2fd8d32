"""Between the line of a page and its session, so that nothing is computed in the thread that serves.

An answer is one frame of bytes: the lengths of its head and of its block (32 bits each, the lowest byte first), the
head, the block, the cells.  The head is JSON with what is told: "scene" and "lesson", descriptions; "state" and
"chart".  "page/line.js" takes it apart.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any, Generic, TypeVar

from hess_explorer.compute.turns import Turns
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.charts import Charts
from hess_explorer.page.opening import opening
from hess_explorer.page.session import Session

__all__ = ["Desk"]

T = TypeVar("T", str, bytes)


class _Told(Generic[T]):
    """What is set goes to the page with the answer; it is not read."""

    def __set_name__(self, owner: type[Desk], name: str) -> None:
        self._name = name

    def __get__(self, desk: Desk, owner: type[Desk]) -> T:
        raise AttributeError(f"{self._name} is told and not kept")

    def __set__(self, desk: Desk, value: T) -> None:
        desk.said[self._name] = value


class Desk:
    """The page before its session and its chart: messages come one by one, in the session's own turn.

    query, own : of the page, see `opening`; tell : sends a frame to the page, from any thread; follow : told the query
    of each state that it shows.

    scene, lesson, state, chart : JSON, see `describe`, `Session`, `Charts`; block : the numbers of the state; cells :
    those of the chart, double precision, where they are (32 bits) and status (8 bits).

    Messages ask for the state after the user's n-th change, "requested": n, with

    - "values": {name: number or option, …}; "preset": the example chosen; "scene": the scene chosen;
    - "expressions": {name: text, …}, numbers as they were typed, pi/3;
    - "picked": [picture, x, y] or [picture, x0, y0, x1, y1]; "hover": [picture, x, y], where the mouse is;
    - "lesson": the lesson wanted; "step": [lesson or scene, number of the step from 0, whether its guess is revealed];
    - "near": a scene that may be chosen next;
    - "restore": the query of a state to go to, as in a link;
    - "reset", "clear", "stop": whether that was pressed; "held": whether a slider is held;
    - "hidden": [the pictures out of sight, …];

    and others about a chart, "chart": …, see `Charts`.
    """

    scene, lesson, state, block = _Told[str](), _Told[str](), _Told[str](), _Told[bytes]()
    chart, cells = _Told[str](), _Told[bytes]()

    def __init__(self, query: str, own: Lesson | None, tell: Callable[[bytes], object],
                 follow: Callable[[str], None] | None) -> None:
        # One answer tells each thing once.
        self.said: dict[str, Any] = {}
        self._tell, self._follow = tell, follow
        self._turns = Turns()
        self._handlers: list[Callable[[Any], object]] = []
        self._charts = Charts(self)
        self._turns.take(partial(self._work, partial(self._begin, query, own)))

    def on_msg(self, handle: Callable[[Any], object]) -> None:
        """By this the session and the chart take a message."""
        self._handlers.append(handle)

    def receive(self, message: Any) -> None:
        """The page has sent this; nothing in it is trusted."""
        self._turns.take(partial(self._work, partial(self._handle, message)))

    def end(self) -> None:
        """The page is gone."""
        self._turns.end()
        self._charts.end()

    def _begin(self, query: str, own: Lesson | None) -> None:
        opened = opening(query, own)
        Session(self, opened.scene, opened.values, opened.notes, opened.lessons, opened.pictures)

    def _handle(self, message: Any) -> None:
        for handle in self._handlers:
            handle(SimpleNamespace(data=message))

    def _work(self, work: Callable[[], object]) -> None:
        try:
            work()
        finally:
            said, self.said = self.said, {}
            if self._follow is not None and "state" in said:
                self._follow(json.loads(said["state"])["query"])
            if said:
                self._tell(_frame(said))


def _frame(said: dict[str, Any]) -> bytes:
    block, cells = said.pop("block", b""), said.pop("cells", b"")
    # What is told is JSON already.
    head = ("{" + ", ".join(f'"{name}": {text}' for name, text in said.items()) + "}").encode()
    return b"".join([struct.pack("<II", len(head), len(block)), head, block, cells])
