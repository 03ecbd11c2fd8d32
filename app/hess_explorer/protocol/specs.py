"""Parameters of the page: their specification and their form in the URL.

The URL holds the whole state and a version.  It is untrusted: each key is checked and clamped by itself, and each
change is reported in a note.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal
from urllib.parse import parse_qsl, urlencode, urlsplit

from hess_explorer.protocol.formulas import polynomial
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.parameters import Group, Parameter, plain

VERSION = "1"
MAX_QUERY = 2000
_SHORT = 60
"""Maximum number of characters of a link that a message quotes."""
_MOST_NAMES = 3
"""Maximum number of keys that a message names."""

Value = float | str
Values = Mapping[str, Value]


@dataclass(frozen=True)
class NumberSpec(Parameter):
    """A numeric parameter; its slider covers `softbounds`, and typed values may lie anywhere within `bounds`."""

    def read(self, raw: Value) -> tuple[float, str | None]:
        """Return the number in an untrusted text, and a note if it was changed.

        The number is clamped to `bounds`; a text that is not a finite number gives the default.
        """
        try:
            value = float(raw)
        except (ValueError, OverflowError):
            value = math.nan
        if not math.isfinite(value):
            return self.default, f"{self.symbol} must be a finite number {self.range}: set to {plain(self.default)}."
        low, high = self.bounds
        clamped = min(max(value, low), high)
        if clamped != value:
            return clamped, f"{self.symbol} must lie {self.range}: set to {plain(clamped)}."
        return value, None


@dataclass(frozen=True)
class ChoiceSpec:
    """A parameter whose value is one of a fixed list of names.

    Attributes
    ----------
    name : str
        Key in links.
    label : str
        Label of the control.
    options : tuple of str
        Allowed values.
    default : str
        Default value.
    doc : str
        Meaning, in a sentence.
    group : str
        Group of controls.
    """

    name: str
    label: str
    options: tuple[str, ...]
    default: str
    doc: str = ""
    group: Group | Literal["Swarm", "Chart"] = "Computation"

    def read(self, raw: Value) -> tuple[str, str | None]:
        """Return the option of that name and None; otherwise the default and a note.

        The note does not quote the text, which is untrusted.
        """
        if raw in self.options:
            return str(raw), None
        return self.default, f"{self.label} must be one of {', '.join(self.options)}: set to {self.default}."


@dataclass(frozen=True)
class Formula:
    """A parameter whose value is a formula as a text.

    Attributes
    ----------
    name, label, default, doc, group
        As in `ChoiceSpec`.
    parse : callable
        Parses the formula; raises `InvalidParameter` for an invalid text.
    """

    name: str
    label: str
    default: str
    doc: str = ""
    group: Group = "Body"
    parse: Callable[[str], object] = polynomial

    def read(self, raw: Value) -> tuple[str, str | None]:
        """Return the formula without surrounding spaces; if it is invalid, the default and a note."""
        text = str(raw).strip()
        try:
            self.parse(text)
        except InvalidParameter as error:
            return self.default, f"{self.label}: {str(error).removesuffix('.')}: it was ignored."
        return text, None


@dataclass(frozen=True)
class Points:
    """Points chosen with the mouse in a picture, as a text "x,y;x,y"; they have no control.

    Attributes
    ----------
    name, label, default
        As in `ChoiceSpec`.
    most : int
        Maximum number of points.
    low, high : tuple of float
        Corners (x, y) of the rectangle that contains them, bounds included.
    """

    name: str
    label: str
    most: int
    low: tuple[float, float]
    high: tuple[float, float]
    default: str = ""

    def read(self, raw: Value) -> tuple[str, str | None]:
        """Return the last `most` points as a text, and a note if others were dropped.

        For an invalid text, or a point outside the rectangle, return the default and a note.
        """
        text = str(raw)
        try:
            pairs = [tuple(map(float, pair.split(","))) for pair in text.split(";") if pair]
            inside = bool(pairs) == bool(text) and all(
                low <= value <= high
                for pair in pairs
                for value, low, high in zip(pair, self.low, self.high, strict=True)
            )
        except ValueError:
            inside = False
        if not inside:
            low, high = (",".join(map(plain, corner)) for corner in (self.low, self.high))
            return self.default, (f"{self.label} must be points x,y;x,y from {low} to {high}: the default is shown.")
        note = f"{self.label} can hold at most {self.most}: the last ones are kept." if len(pairs) > self.most else None
        return points_text(pairs[-self.most :]), note


@dataclass(frozen=True)
class Names:
    """At most `most` names from a fixed list, as a text "a,b"; they have no control.

    Attributes
    ----------
    name, label, options, default
        As in `ChoiceSpec`.
    most : int
        Maximum number of names.
    """

    name: str
    label: str
    options: tuple[str, ...]
    most: int
    default: str = ""

    def read(self, raw: Value) -> tuple[str, str | None]:
        """Return the first `most` known names without duplicates, and a note if a name was dropped.

        Without any known name, return the default; for an empty text, return "".
        """
        names = list(dict.fromkeys(name for name in str(raw).split(",") if name))
        known = [name for name in names if name in self.options]
        note = (
            f"{self.label} may be {', '.join(self.options)}, at most {self.most}: other names in the link are ignored."
            if len(known) < len(names) or len(known) > self.most
            else None
        )
        return ",".join(known[: self.most]) or (self.default if note else ""), note


def points_text(points: Sequence[tuple[float, ...]]) -> str:
    """Return the points as a text "x,y;x,y", with up to 10 significant digits."""
    return ";".join(",".join(f"{value:.10g}" for value in point) for point in points)


def points_of(text: Value) -> list[tuple[float, float]]:
    """Return the points (x, y) of a text that `Points.read` has returned."""
    pairs = (pair.split(",") for pair in str(text).split(";") if pair)
    return [(float(x), float(y)) for x, y in pairs]


ControlSpec = NumberSpec | ChoiceSpec | Formula
"""Parameters with a control."""

Spec = ControlSpec | Points | Names

CLIENT: tuple[NumberSpec, ...] = (
    NumberSpec("t", "t", "Time", 0.0, (0.0, 1000.0), 0.0, (0.0, 1e6)),
    NumberSpec("speed", "speed", "Speed", 1.0, (0.25, 8.0), 0.0, (0.25, 8.0)),
    NumberSpec("az", "azimuth", "Azimuth of the sphere", 0.6, (-3.1416, 3.1416), 0.0, (-3.1416, 3.1416)),
    NumberSpec("el", "elevation", "Elevation of the sphere", 0.35, (-1.5708, 1.5708), 0.0, (-1.5708, 1.5708)),
)
"""Keys of the URL that the browser keeps; they need no computation."""

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
"""Keys of the URL that are not parameters of a scene."""


def _text(value: Value) -> str:
    return value if isinstance(value, str) else repr(float(value))


def encode(scene: str, values: Values) -> str:
    """Return the query of a link to a state, with the version first."""
    return urlencode([("v", VERSION), ("scene", scene), *((name, _text(value)) for name, value in values.items())])


def refusal(note: str) -> str:
    """Return the error message of a note: the part before the last colon, without the substituted value."""
    requirement, _, correction = note.rpartition(": ")
    return f"{(requirement or correction).removesuffix('.')}."


def query_in(link: str) -> str:
    """Return the query of a link, which may be a full URL or its query, with or without "?"."""
    parts = urlsplit(link)
    return parts.query if parts.scheme or link.startswith("?") else link


class Link:
    """An untrusted query, parsed.

    Parameters
    ----------
    query : str
        The part of a link after "?".
    lenient : bool
        True to correct errors and append a note for each; False to raise an error.

    Attributes
    ----------
    texts : mapping of str to str
        The texts of the query by key.
    notes : list of str
        The corrections, without duplicates.

    Raises
    ------
    InvalidParameter
        If the query is invalid and `lenient` is False.  The methods raise it as well.
    """

    def __init__(self, query: str, lenient: bool = True) -> None:
        self.texts: Mapping[str, str] = {}
        self.notes: list[str] = []
        self._lenient = lenient
        if len(query) > MAX_QUERY:
            self.note(f"The link is longer than {MAX_QUERY} characters: it was ignored.")
            return
        pairs = parse_qsl(query.lstrip("?"), keep_blank_values=True)
        self.texts = dict(pairs)
        names = [name for name, _ in pairs]
        twice = _quote(name for name in self.texts if names.count(name) > 1)
        if twice and lenient:
            self.notes.append(f"The link contains {twice} more than once: the last value is used.")
        elif twice:
            raise InvalidParameter(f"The link contains {twice} more than once; {_REMEDY}")
        if self.texts.get("v", VERSION) != VERSION:
            self.note("The link was made by another version of this page: its values may have another meaning here.")

    def note(self, note: str, quotation: str = "") -> None:
        """Append a note on a correction; raise `InvalidParameter` unless the link is lenient.

        Parameters
        ----------
        note : str
            The requirement, and the value that was set instead.
        quotation : str
            Quotation from the link, for the error message.
        """
        if not self._lenient:
            raise InvalidParameter(f"{quotation}{refusal(note).removesuffix('.')}; {_REMEDY}")
        if note not in self.notes:
            self.notes.append(note)

    def value(self, spec: Spec) -> Value:
        """Return the value of a parameter; the default if the link does not contain it."""
        if spec.name not in self.texts:
            return spec.default
        text = self.texts[spec.name]
        value, note = spec.read(text)
        if note:
            self.note(note, f"{_short(f'{spec.name}={text}')} cannot be used: ")
        return value

    def values(self, specs: Sequence[Spec]) -> dict[str, Value]:
        """Return the values of several parameters by name."""
        return {spec.name: self.value(spec) for spec in specs}

    def require(self, scene: str, specs: Sequence[Spec]) -> None:
        """Check that each key belongs to the scene or to the page; note unknown keys, or raise an error."""
        names = [spec.name for spec in specs]
        unknown = _quote(name for name in self.texts if name not in names and name not in PAGE_KEYS)
        if unknown:
            others = "" if self._lenient else f", only {', '.join(names)}"
            self.note(f"The scene {scene} has no parameter {unknown}{others}: ignored.")


_REMEDY = "correct it, or use --lenient (in Python lenient=True) to have it corrected."


def _short(text: str) -> str:
    return repr(text if len(text) <= _SHORT else f"{text[:_SHORT]}…")


def _quote(names: Iterable[str]) -> str:
    """Return the first names in quotation marks, each up to the first character that no name contains."""
    return ", ".join(_short(re.sub(r"[^\w#.-].*", "…", name, flags=re.DOTALL)) for name in [*names][:_MOST_NAMES])


def decode(query: str, specs: Sequence[Spec]) -> tuple[dict[str, Value], list[str]]:
    """Return the values of parameters in a query by name, with defaults for missing ones, and notes on corrections."""
    link = Link(query)
    return link.values(specs), link.notes
