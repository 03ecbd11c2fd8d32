"""Parameters of a page: their specification, and their form in the URL.

The URL holds the whole state under a version.  Nothing in it is trusted: each key is checked
and clamped by itself, and what had to be changed is said in a note.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from urllib.parse import parse_qsl, urlencode, urlsplit

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.parameters import Group, Parameter

__all__ = [
    "CLIENT",
    "MAX_QUERY",
    "PAGE_KEYS",
    "VERSION",
    "Choice",
    "Link",
    "Names",
    "Number",
    "Places",
    "Spec",
    "Value",
    "Values",
    "decode",
    "encode",
    "places",
    "query_in",
    "refusal",
    "written",
]

VERSION = "1"
MAX_QUERY = 2000
_SHORT = 60
"""So many characters of what a link says are repeated in a message."""

Value = float | str
Values = Mapping[str, Value]


@dataclass(frozen=True)
class Number(Parameter):
    """A parameter with a slider over `softbounds`; values within `bounds` may be typed."""

    def read(self, text: str) -> tuple[float, str | None]:
        """The value that a text from outside means, and a note where it had to be changed."""
        try:
            value = float(text)
        except ValueError:
            return self._default("a number")
        return self.admit(value)

    def admit(self, value: float) -> tuple[float, str | None]:
        """The value clamped to what may be, and a note where it was."""
        if not math.isfinite(value):
            return self._default("finite")
        low, high = self.bounds
        clamped = min(max(value, low), high)
        if clamped != value:
            return clamped, f"{self.symbol} lies {self.range}: it is {clamped:g} now."
        return value, None

    def _default(self, what: str) -> tuple[float, str]:
        return self.default, f"{self.symbol} was not {what}, but lies {self.range}: it is {self.default:g} now."


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
        """The last `most` of the points, as a text; the default where it is none; a note where it had to be changed."""
        try:
            pairs = [tuple(map(float, pair.split(","))) for pair in text.split(";") if pair]
            inside = all(
                low <= value <= high
                for pair in pairs
                for value, low, high in zip(pair, self.low, self.high, strict=True)
            )
        except ValueError:
            inside = False
        if not inside:
            low, high = (",".join(f"{value:g}" for value in corner) for corner in (self.low, self.high))
            return self.default, (
                f"{self.label} could not be read as points x,y;x,y from {low} to {high}: what it is at first is shown."
            )
        note = f"{self.label} may be {self.most} at most: the last are kept." if len(pairs) > self.most else None
        return written(pairs[-self.most :]), note


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
        note = (
            f"{self.label} may be {', '.join(self.options)}, {self.most} at most: what the link names besides is "
            "left out."
            if len(known) < len(names) or len(known) > self.most
            else None
        )
        return ",".join(known[: self.most]) or (self.default if note else ""), note


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

PAGE_KEYS = (
    "v",
    "scene",
    *(spec.name for spec in CLIENT),
    "large",
    "theme",
    "present",
    "embed",
    "pictures",
    "controls",
    "lesson",
    "step",
)
"""Keys of the URL that are no parameters of a scene."""


def _text(value: Value) -> str:
    return value if isinstance(value, str) else repr(float(value))


def encode(scene: str, values: Values) -> str:
    """The query of these values of a scene, version first."""
    return urlencode([("v", VERSION), ("scene", scene), *((name, _text(value)) for name, value in values.items())])


def refusal(note: str) -> str:
    """Return the sentence of a note on what was wrong, without what was put in its place, which follows a colon."""
    return f"{note.partition(': ')[0].removesuffix('.')}."


def query_in(link: str) -> str:
    """Return the query of a whole link, or of what follows ? in one."""
    parts = urlsplit(link)
    return parts.query if parts.scheme or link.startswith("?") else link


class Link:
    """A query from outside, read once.

    Parameters
    ----------
    query : what follows ? in a link.
    lenient : whether what is wrong is put right and noted; else it is refused.

    notes : what had to be changed in it, and what is wrong with all of it, each once; given : its keys and their texts.

    Raises
    ------
    InvalidParameter : it is read strictly and something in it is wrong; so do its methods.
    """

    def __init__(self, query: str, lenient: bool = True) -> None:
        self.given: Mapping[str, str] = {}
        self.notes: list[str] = []
        self._lenient = lenient
        if len(query) > MAX_QUERY:
            self.note(f"The link was longer than {MAX_QUERY} characters: it was not read.")
            return
        pairs = parse_qsl(query.lstrip("?"), keep_blank_values=True)
        self.given = dict(pairs)
        if not lenient:
            self._refuse_repeated([name for name, _ in pairs])
        if self.given.get("v", VERSION) != VERSION:
            self.note("The link is of another version of this page: what it says may mean something else here.")

    def note(self, note: str, given: str = "") -> None:
        """Note what had to be changed, or refuse it; given : what the link says there."""
        if not self._lenient:
            raise InvalidParameter(f"{given}{refusal(note).removesuffix('.')}; {_REMEDY}")
        if note not in self.notes:
            self.notes.append(note)

    def value(self, spec: Spec) -> Value:
        """The value of a parameter, its default where the link says nothing."""
        if spec.name not in self.given:
            return spec.default
        text = self.given[spec.name]
        value, note = spec.read(text)
        if note:
            self.note(note, f"{_short(f'{spec.name}={text}')} cannot be used: ")
        return value

    def values(self, specs: Sequence[Spec]) -> dict[str, Value]:
        """The values of all of these."""
        return {spec.name: self.value(spec) for spec in specs}

    def require(self, scene: str, names: Sequence[str]) -> None:
        """Refuse a key that is neither one of these names, of a scene, nor one of the page; leniently it is ignored."""
        unknown = [name for name in self.given if name not in names and name not in PAGE_KEYS]
        if unknown and not self._lenient:
            raise InvalidParameter(
                f"The scene {scene} has no parameter {_short(unknown[0])}, but {', '.join(names)}; {_REMEDY}"
            )

    def _refuse_repeated(self, names: list[str]) -> None:
        twice = [name for name in names if names.count(name) > 1]
        if twice:
            raise InvalidParameter(f"The link says {_short(twice[0])} more than once; {_REMEDY}")


_REMEDY = "correct it, or have it put right with --lenient (in Python lenient=True)."


def _short(text: str) -> str:
    return repr(text if len(text) <= _SHORT else f"{text[:_SHORT]}…")


def decode(query: str, specs: Sequence[Spec]) -> tuple[dict[str, Value], list[str]]:
    """The values of all specs from a query, defaults where it has none, and notes on what was changed."""
    link = Link(query)
    return link.values(specs), link.notes
