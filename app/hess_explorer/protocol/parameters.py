"""Parameters of a page: their specification, and their form in the URL.

The URL holds the whole state under a version.  Nothing in it is trusted: each key is checked
and clamped by itself, and what had to be changed is said in a note.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args
from urllib.parse import parse_qsl, urlencode

__all__ = [
    "CLIENT", "GROUPS", "MAX_QUERY", "VERSION", "Choice", "Group", "Link", "Names", "Number", "Places", "Spec", "Value",
    "Values", "decode", "encode", "places", "written",
]

VERSION = "1"
MAX_QUERY = 2000

Group = Literal["Body", "State", "Computation"]
GROUPS: tuple[Group, ...] = get_args(Group)
"""The controls of a scene are folded in these, in this order."""

Value = float | str
Values = Mapping[str, Value]


@dataclass(frozen=True)
class Number:
    """A number with a slider over `softbounds`; values within `bounds` may be typed.

    The words are those of the library param.
    means : what number it is, where its label does not say that: a scene takes from another one what means the same.
    """

    name: str
    symbol: str
    label: str
    default: float
    softbounds: tuple[float, float]
    step: float
    bounds: tuple[float, float]
    doc: str = ""
    group: Group = "State"
    means: str = ""

    def read(self, text: str) -> tuple[float, str | None]:
        """The value that a text from outside means, and a note where it had to be changed."""
        try:
            value = float(text)
        except ValueError:
            return self.default, f"{self.symbol} was not a number and is {self.default:g} now."
        return self.admit(value)

    def admit(self, value: float) -> tuple[float, str | None]:
        """The value clamped to what may be, and a note where it was."""
        if not math.isfinite(value):
            return self.default, f"{self.symbol} was not finite and is {self.default:g} now."
        low, high = self.bounds
        clamped = min(max(value, low), high)
        if clamped != value:
            return clamped, f"{self.symbol} lies between {low:g} and {high:g}: it is {clamped:g} now."
        return value, None


@dataclass(frozen=True)
class Choice:
    """One of a fixed list of names."""

    name: str
    label: str
    options: tuple[str, ...]
    default: str
    doc: str = ""
    group: Group = "Computation"

    def read(self, text: str) -> tuple[str, str | None]:
        """The option of that name, or the default and a note (which does not repeat the text)."""
        if text in self.options:
            return text, None
        return self.default, f"{self.label} was not one of {', '.join(self.options)}: it is {self.default} now."


@dataclass(frozen=True)
class Places:
    """Points chosen with the mouse in a picture, as a text "x,y;x,y": at most `most` within `low` … `high`.

    They have no control of their own.
    """

    name: str
    label: str
    most: int
    low: tuple[float, float]
    high: tuple[float, float]
    default: str = ""

    def read(self, text: str) -> tuple[str, str | None]:
        """The last `most` of the points, as a text; the default and a note where it is none."""
        try:
            pairs = [tuple(map(float, pair.split(","))) for pair in text.split(";") if pair]
            inside = all(low <= value <= high for pair in pairs
                         for value, low, high in zip(pair, self.low, self.high, strict=True))
        except ValueError:
            inside = False
        if not inside:
            return self.default, f"{self.label} could not be read: what it is at first is shown."
        return written(pairs[-self.most:]), None


@dataclass(frozen=True)
class Names:
    """At most `most` of a fixed list of names, as a text "a,b".  They have no control of their own."""

    name: str
    label: str
    options: tuple[str, ...]
    most: int
    default: str = ""

    def read(self, text: str) -> tuple[str, str | None]:
        """The first `most` of the names, each once; a note where one is not of the list, the default if all are not."""
        names = list(dict.fromkeys(name for name in text.split(",") if name))
        known = [name for name in names if name in self.options]
        note = (f"{self.label} may be {', '.join(self.options)}: what the link names besides is left out."
                if len(known) < len(names) else None)
        return ",".join(known[:self.most]) or (self.default if note else ""), note


def written(places: Sequence[tuple[float, ...]]) -> str:
    """The text of these points."""
    return ";".join(",".join(f"{value:.10g}" for value in place) for place in places)


def places(text: Value) -> list[tuple[float, float]]:
    """The points that an admitted text names."""
    pairs = (pair.split(",") for pair in str(text).split(";") if pair)
    return [(float(x), float(y)) for x, y in pairs]


Spec = Number | Choice | Places | Names

CLIENT: tuple[Number, ...] = (
    Number("t", "t", "Time", 0.0, (0.0, 1000.0), 0.0, (0.0, 1e6)),
    Number("speed", "speed", "Speed", 1.0, (0.25, 8.0), 0.0, (0.25, 8.0)),
    Number("az", "azimuth", "Azimuth of the sphere", 0.6, (-3.1416, 3.1416), 0.0, (-3.1416, 3.1416)),
    Number("el", "elevation", "Elevation of the sphere", 0.35, (-1.5708, 1.5708), 0.0, (-1.5708, 1.5708)),
)
"""Keys of the URL that the browser itself keeps, besides the pictures enlarged: they need no computation."""


def _text(value: Value) -> str:
    return value if isinstance(value, str) else repr(float(value))


def encode(scene: str, values: Values) -> str:
    """The query of these values of a scene, version first."""
    return urlencode([("v", VERSION), ("scene", scene), *((name, _text(value)) for name, value in values.items())])


class Link:
    """A query from outside, read once.

    notes : what had to be changed in it, and what is wrong with all of it, each once; given : its keys and their texts.
    """

    def __init__(self, query: str) -> None:
        self.given: Mapping[str, str] = {}
        self.notes: list[str] = []
        if len(query) > MAX_QUERY:
            self.notes.append(f"The link was longer than {MAX_QUERY} characters and was not read.")
            return
        self.given = dict(parse_qsl(query.lstrip("?"), keep_blank_values=True))
        if self.given.get("v", VERSION) != VERSION:
            self.notes.append("The link is of another version of this page: what it says may mean something else here.")

    def value(self, spec: Spec) -> Value:
        """The value of a parameter, its default where the link says nothing."""
        if spec.name not in self.given:
            return spec.default
        value, note = spec.read(self.given[spec.name])
        if note:
            self.notes.append(note)
        return value

    def values(self, specs: Sequence[Spec]) -> dict[str, Value]:
        """The values of all of these."""
        return {spec.name: self.value(spec) for spec in specs}


def decode(query: str, specs: Sequence[Spec]) -> tuple[dict[str, Value], list[str]]:
    """The values of all specs from a query, defaults where it has none, and notes on what was changed."""
    link = Link(query)
    return link.values(specs), link.notes
