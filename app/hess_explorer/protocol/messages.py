"""The messages of a page's websocket: requests are parsed once from untrusted JSON, answers are encoded once.

A request is JSON in a text frame.  It asks for the state after the user's n-th change, "requested": n, with

- "values": {name: number or option, …}; "preset": the chosen example; "scene": the chosen scene;
- "expressions": {name: text, …}, numbers as they were typed, pi/3;
- "picked": [picture, x, y], a click, or [picture, x0, y0, x1, y1], a box; "hover": [picture, x, y];
- "lesson": the wanted lesson; "step": [lesson or scene, number of the step from 0, whether its guess is revealed];
- "near": a scene that may be chosen next;
- "restore": the query of a state to go to, as in a link;
- "reset", "clear", "stop": whether that was pressed; "held": whether a slider is held;
- "hidden": [the pictures out of sight, …].

Or it is about the chart of the page: {"chart": …} with {"start": what `Chart.read` takes, "id": number}, {"more":
number of known cells, "id": number}, {"stop": true}, or {"why": what `Chart.read` takes, "at": [x, y]}.

An answer is one binary frame: the lengths of its head and of its block (32 bits each, little endian), the head, the
block, the cells.  The head is JSON, see `Answer`.  "page/websocket.js" takes it apart.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hess_explorer.protocol.parameters import Value

__all__ = [
    "Answer",
    "CellExplained",
    "ChartCells",
    "ChartEnded",
    "ChartRequest",
    "ContinueChart",
    "ExplainCell",
    "PictureBox",
    "PicturePoint",
    "Request",
    "StartChart",
    "StateAnswer",
    "StepChoice",
    "StopChart",
    "parse",
]


@dataclass(frozen=True)
class PicturePoint:
    """A point in a picture, finite."""

    picture: str
    x: float
    y: float


@dataclass(frozen=True)
class PictureBox:
    """A box in a picture, with the finite corners (x0, y0, x1, y1)."""

    picture: str
    corners: tuple[float, float, float, float]


@dataclass(frozen=True)
class StepChoice:
    """A step of a lesson, or of what can be tried in a scene."""

    lesson: str
    number: int
    revealed: bool


@dataclass(frozen=True)
class Request:
    """A request for a state; its fields are described above, and a field that was missing or wrong says nothing."""

    requested: int | None = None
    restore: str | None = None
    values: Mapping[str, Value] | None = None
    expressions: Mapping[str, str] | None = None
    picked: PicturePoint | PictureBox | None = None
    hover: PicturePoint | None = None
    step: StepChoice | None = None
    hidden: Sequence[str] | None = None
    scene: str | None = None
    near: str | None = None
    preset: str | None = None
    lesson: str | None = None
    reset: bool = False
    clear: bool = False
    stop: bool = False
    held: bool = False


@dataclass(frozen=True)
class StartChart:
    """A chart in place of the one before; chart : what `Chart.read` takes."""

    chart: Mapping[str, object]
    id: int


@dataclass(frozen=True)
class ContinueChart:
    """The cells after the first `known` ones."""

    known: int
    id: int


@dataclass(frozen=True)
class StopChart:
    """Stop the chart."""


@dataclass(frozen=True)
class ExplainCell:
    """How the cell at (x, y) ends; chart : what `Chart.read` takes."""

    chart: Mapping[str, object]
    x: float
    y: float


ChartRequest = StartChart | ContinueChart | StopChart | ExplainCell


def parse(message: Any) -> Request | ChartRequest | None:
    """Return the request in decoded JSON; None where there is none."""
    if not isinstance(message, dict):
        return None
    chart = message.get("chart")
    if isinstance(chart, dict):
        return _chart(chart)

    def text(key: str) -> str | None:
        value = message.get(key)
        return value if isinstance(value, str) else None

    def mapping(key: str) -> Mapping[str, Any] | None:
        value = message.get(key)
        return value if isinstance(value, dict) else None

    requested, values, expressions = message.get("requested"), mapping("values"), mapping("expressions")
    hidden, hover = message.get("hidden"), _picked(message.get("hover"))
    return Request(
        requested=requested if isinstance(requested, int) else None,
        restore=text("restore"),
        values=values and {name: _value(value) for name, value in values.items()},
        expressions=expressions and {name: given for name, given in expressions.items() if isinstance(given, str)},
        picked=_picked(message.get("picked")),
        hover=hover if isinstance(hover, PicturePoint) else None,
        step=_step(message.get("step")),
        hidden=[name for name in hidden if isinstance(name, str)] if isinstance(hidden, list) else None,
        scene=text("scene"),
        near=text("near"),
        preset=text("preset"),
        lesson=text("lesson"),
        reset=message.get("reset") is True,
        clear=message.get("clear") is True,
        stop=message.get("stop") is True,
        held=message.get("held") is True,
    )


def _chart(given: Mapping[str, Any]) -> ChartRequest | None:
    match given:
        case {"start": dict(chart), "id": int(number)}:
            return StartChart(chart, number)
        case {"more": int(known), "id": int(number)}:
            return ContinueChart(known, number)
        case {"stop": True}:
            return StopChart()
        case {"why": dict(chart), "at": [x, y]} if all(map(math.isfinite, place := (_number(x), _number(y)))):
            return ExplainCell(chart, *place)
    return None


def _picked(given: Any) -> PicturePoint | PictureBox | None:
    match given:
        case [str(picture), *place] if all(map(math.isfinite, numbers := [_number(one) for one in place])):
            match numbers:
                case [x, y]:
                    return PicturePoint(picture, x, y)
                case [x0, y0, x1, y1]:
                    return PictureBox(picture, (x0, y0, x1, y1))
    return None


def _step(given: Any) -> StepChoice | None:
    match given:
        case [str(lesson), int(number), bool(revealed)]:
            return StepChoice(lesson, number, revealed)
    return None


def _value(value: Any) -> Value:
    return _number(value) if isinstance(value, int | float) else str(value)


def _number(value: Any) -> float:
    """Return a number; NaN for whatever is none, or beyond double range."""
    try:
        return float(value) if isinstance(value, int | float) else math.nan
    except OverflowError:
        return math.nan


@dataclass(frozen=True)
class StateAnswer:
    """A state: its number among those of the session, the request it answers, its query, what changes on the page.

    tree : see `Wire.pack`; progress : (done, of) while some of its tasks are on their way.
    """

    number: int
    answers: int
    query: str
    tree: Mapping[str, Any]
    scene: str
    progress: tuple[int, int] | None


@dataclass(frozen=True)
class ChartCells:
    """Cells of a chart that follow those known, and how far it is; x, y : (name, low, high, count) as clamped."""

    id: int | None
    cells: int
    first: int
    running: bool
    said: str
    done: int
    of: int
    left: float | None
    level: str
    error: float | None
    version: str
    x: tuple[str, float, float, int]
    y: tuple[str, float, float, int]


@dataclass(frozen=True)
class ChartEnded:
    """There is no chart, and why."""

    id: int | None
    said: str
    running: bool = False
    cells: int = 0


@dataclass(frozen=True)
class CellExplained:
    """How the cell at (x, y) ends."""

    at: tuple[float, float]
    why: str


@dataclass(frozen=True)
class Answer:
    """What a page is told at once.

    scene, lesson : descriptions, JSON, empty for none; block : the numbers of the state; cells : those of the chart,
    double precision, their indices (32 bits) and status (8 bits).
    """

    scene: str = ""
    lesson: str = ""
    state: StateAnswer | None = None
    block: bytes = b""
    chart: ChartCells | ChartEnded | CellExplained | None = None
    cells: bytes = b""

    def encode(self) -> bytes:
        """Return the frame; empty where there is nothing to tell."""
        parts = {"scene": self.scene, "lesson": self.lesson, "state": _json(self.state), "chart": _json(self.chart)}
        told = ", ".join(f'"{name}": {text}' for name, text in parts.items() if text)
        head = f"{{{told}}}".encode()
        return struct.pack("<II", len(head), len(self.block)) + head + self.block + self.cells if told else b""


def _json(part: StateAnswer | ChartCells | ChartEnded | CellExplained | None) -> str:
    # Not `asdict`, which copies all that is in it.
    return json.dumps(vars(part)) if part is not None else ""
