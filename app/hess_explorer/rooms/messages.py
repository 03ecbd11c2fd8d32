"""Messages of a room's websocket: `parse` reads them from untrusted JSON.

The first message of a websocket is one of

- {"open": true}: open the room of the URL; the answer {"key": …} belongs to the lecturer alone;
- {"lead": key}: be the lecturer of that room, for instance after a reload;
- {"follow": name}: follow; the name is random, and identifies the guess of a page that reconnects.

Then the lecturer sends {"show": {"query", "lesson", "step", "revealed", "picture"}} and {"end": true}, a follower
{"guess": [[x, y], …], "step": number}.  Anyone may send `ALIVE` of `hess_explorer.protocol.messages`.

A room sends the lecturer {"followers": n, "guesses": n} and, when a prediction is revealed, {"cloud": [points, …]} with
the points [[x, y], …] of each guess.
Followers get frames as in `hess_explorer.protocol.messages`: the description of the picture, and its states.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from hess_explorer.protocol.messages import number
from hess_explorer.protocol.specs import MAX_QUERY

CODE = r"[2-9A-HJ-NP-Z]{6}"
"""Regular expression for the code of a room: no letter or digit that is easily mistaken for another one."""

MAX_POINTS = 40
"""Maximum number of points of a guessed curve, as in "pictures/guess.js"."""

_NAME = re.compile(r"[\w-]{8,40}")
_LONGEST = 200
"""Maximum length of a key, and of the name of a lesson or picture."""
_MOST_STEPS = 1000


@dataclass(frozen=True)
class Open:
    """A request to open a room."""


@dataclass(frozen=True)
class Lead:
    """A request to be the lecturer of a room.

    Attributes
    ----------
    key : str
        Key of the room, which only its lecturer has received.
    """

    key: str


@dataclass(frozen=True)
class Follow:
    """A request to follow the lecturer.

    Attributes
    ----------
    name : str
        Random name of the page.
    """

    name: str


@dataclass(frozen=True)
class Show:
    """The state, lesson step and picture on the lecturer's page.

    Attributes
    ----------
    query : str
        Query of the state.
    lesson : str
        Name of the lesson, "" for none.
    step : int
        Number of its step, from 1.
    revealed : bool
        True if the prediction of the step is revealed.
    picture : str
        Name of the enlarged picture, "" for none.
    """

    query: str
    lesson: str = ""
    step: int = 0
    revealed: bool = False
    picture: str = ""


@dataclass(frozen=True)
class Guess:
    """A guess at a step of the lesson.

    Attributes
    ----------
    step : int
        Number of the step, from 1.
    points : tuple of (float, float)
        Clicked points (x, y) on the axes of the picture, 1 to `MAX_POINTS`.
    """

    step: int
    points: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class End:
    """A request to end the room."""


Message = Open | Lead | Follow | Show | Guess | End


def parse(message: Any) -> Message | None:
    """Return the message that decoded JSON contains, or None if it is not a message."""
    match message:
        case {"open": True}:
            return Open()
        case {"lead": str(key)} if len(key) <= _LONGEST:
            return Lead(key)
        case {"follow": str(name)} if _NAME.fullmatch(name):
            return Follow(name)
        case {"end": True}:
            return End()
        case {"show": dict(shown)}:
            return _show(shown)
        case {"guess": list(points), "step": int(step)} if 0 < len(points) <= MAX_POINTS:
            found = [point for point in map(_point, points) if point is not None]
            return Guess(step, tuple(found)) if len(found) == len(points) else None
    return None


def _show(message: dict[str, Any]) -> Show | None:
    match message:
        case {
            "query": str(query),
            "lesson": str(lesson),
            "step": int(step),
            "revealed": bool(revealed),
            "picture": str(picture),
        } if len(query) <= MAX_QUERY and max(len(lesson), len(picture)) <= _LONGEST and 0 <= step <= _MOST_STEPS:
            return Show(query, lesson, step, revealed, picture)
    return None


def _point(raw: Any) -> tuple[float, float] | None:
    match raw:
        case [x, y] if all(map(math.isfinite, point := (number(x), number(y)))):
            return point
    return None
