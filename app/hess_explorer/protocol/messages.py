"""Messages of a page's websocket: `parse` reads requests from untrusted JSON, `Response.encode` writes responses.

A request is a text frame of JSON.  The key "requested": n asks for the state after the user's n-th change.  Other keys:

- "values": {name: number or option, …}; "preset": the chosen example; "scene": the chosen scene;
- "expressions": {name: text, …}, numbers typed as expressions such as pi/3;
- "picked": a click [picture, x, y] or a box [picture, x0, y0, x1, y1]; "hover": [picture, x, y];
- "lesson": the name of a lesson to describe; "step": [lesson or scene, index of the step, true if its prediction is
  revealed];
- "near": a scene that the user may choose next;
- "restore": the query of the state to go to, as in a link;
- "reset", "clear", "stop": true if that button was pressed; "held": true while a slider is held;
- "hidden": [picture outside of the viewport, …].

The request `ALIVE` is answered with an empty text frame, even while a state is being computed.

Any other response is one binary frame: the lengths of head and block (32 bits each, little endian), the head, the
block.  The head is the JSON of a `Response` without its block and empty fields.  "page/websocket.js" decodes the frame.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from hess_explorer.protocol.specs import Value

T = TypeVar("T")
ALIVE = {"alive": True}
"""Request that a page sends after some seconds without a message."""


@dataclass(frozen=True)
class PicturePoint:
    """A point in a picture, with finite coordinates.

    Attributes
    ----------
    picture : str
        Name of the picture.
    x, y : float
        Coordinates on the axes of the picture.
    """

    picture: str
    x: float
    y: float


@dataclass(frozen=True)
class PictureBox:
    """A box in a picture, with finite coordinates.

    Attributes
    ----------
    picture : str
        Name of the picture.
    corners : tuple of float
        Opposite corners (x0, y0, x1, y1), on the axes of the picture.
    """

    picture: str
    corners: tuple[float, float, float, float]


@dataclass(frozen=True)
class StepChoice:
    """A step of a lesson, or of the suggestions of a scene.

    Attributes
    ----------
    lesson : str
        Name of the lesson or scene.
    number : int
        Index of the step, from 0; not checked.
    revealed : bool
        True for the state in which the prediction of the step is revealed.
    """

    lesson: str
    number: int
    revealed: bool


@dataclass(frozen=True)
class Request:
    """A request with the keys that the module describes as attributes; a missing or invalid key has its default."""

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


def parse(message: Any) -> Request | None:
    """Return the request in decoded JSON; None if the JSON is not an object."""
    if not isinstance(message, dict):
        return None

    def of(kind: type[T], key: str) -> T | None:
        value = message.get(key)
        return value if isinstance(value, kind) else None

    values, expressions, hidden = of(dict, "values"), of(dict, "expressions"), of(list, "hidden")
    hover = _pick(message.get("hover"))
    return Request(
        requested=of(int, "requested"),
        restore=of(str, "restore"),
        values=values and {name: _value(value) for name, value in values.items()},
        expressions=expressions and {name: raw for name, raw in expressions.items() if isinstance(raw, str)},
        picked=_pick(message.get("picked")),
        hover=hover if isinstance(hover, PicturePoint) else None,
        step=_step(message.get("step")),
        hidden=None if hidden is None else [name for name in hidden if isinstance(name, str)],
        scene=of(str, "scene"),
        near=of(str, "near"),
        preset=of(str, "preset"),
        lesson=of(str, "lesson"),
        reset=message.get("reset") is True,
        clear=message.get("clear") is True,
        stop=message.get("stop") is True,
        held=message.get("held") is True,
    )


def _pick(raw: Any) -> PicturePoint | PictureBox | None:
    match raw:
        case [str(picture), *point] if all(map(math.isfinite, numbers := [number(one) for one in point])):
            match numbers:
                case [x, y]:
                    return PicturePoint(picture, x, y)
                case [x0, y0, x1, y1]:
                    return PictureBox(picture, (x0, y0, x1, y1))
    return None


def _step(raw: Any) -> StepChoice | None:
    match raw:
        case [str(lesson), int(number), bool(revealed)]:
            return StepChoice(lesson, number, revealed)
    return None


def _value(value: Any) -> Value:
    return number(value) if isinstance(value, int | float) else str(value)


def number(value: Any) -> float:
    """Return the value as a float; NaN if it is not a number or is an integer beyond the range of doubles."""
    try:
        return float(value) if isinstance(value, int | float) else math.nan
    except OverflowError:
        return math.nan


@dataclass(frozen=True)
class StateResponse:
    """A state of the page.

    Attributes
    ----------
    number : int
        Number of the state in the session, from 1.
    answers : int
        Value of "requested" in the request.
    query : str
        Query of the link to the state.
    tree : mapping of str
        Changes of the page, see `Wire.pack`.
    scene : str
        Name of the scene.
    progress : tuple of int or None
        Background tasks (done, total) while they are running, otherwise None.
    """

    number: int
    answers: int
    query: str
    tree: Mapping[str, Any]
    scene: str
    progress: tuple[int, int] | None


@dataclass(frozen=True)
class Response:
    """A response to the page.

    Attributes
    ----------
    scene, lesson : str
        Descriptions as JSON; empty for none.
    state : StateResponse or None
        The state; None if none was requested.
    block : bytes
        Arrays of the state.
    show : str
        Texts beside the state for the followers of a room, as JSON.
    """

    scene: str = ""
    lesson: str = ""
    state: StateResponse | None = None
    block: bytes = b""
    show: str = ""

    def encode(self) -> bytes:
        """Return the binary frame; empty if the response has no content."""
        # `asdict` would make a deep copy.
        state = "" if self.state is None else json.dumps(vars(self.state))
        parts = {"scene": self.scene, "lesson": self.lesson, "state": state, "show": self.show}
        fields = ", ".join(f'"{name}": {text}' for name, text in parts.items() if text)
        head = f"{{{fields}}}".encode()
        return struct.pack("<II", len(head), len(self.block)) + head + self.block if fields else b""
