"""File formats, and the limits of figures and films, for commands, server and `SceneState.save`."""

from __future__ import annotations

import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple


class Bounds(NamedTuple):
    """Smallest and largest allowed value of a number."""

    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.low:g} to {self.high:g}"

    def require(self, thing: str, value: Any, words: str) -> None:
        """Raise `InvalidParameter` unless the value is a number within the limits.

        Parameters
        ----------
        thing : str
            Subject of the error message.
        value : object
            The value.
        words : str
            Words after the limits in the error message, such as "mm wide".
        """
        from hess_mechanics.errors import InvalidParameter

        if not (isinstance(value, int | float) and self.low <= value <= self.high):
            raise InvalidParameter(f"{thing} must be {self} {words}, not {reprlib.repr(value)}.")


class Format(NamedTuple):
    """A file format.

    Attributes
    ----------
    content : str
        Category: "data", "figure", "film", "state" or "program".
    media : str
        Media type.
    words : str
        Label in the dialog; empty if the dialog does not offer it.
    """

    content: str
    media: str
    words: str = ""


FORMATS: Mapping[str, Format] = {
    "csv": Format("data", "text/csv; charset=utf-8", "CSV: data, every digit"),
    "json": Format("data", "application/json", "JSON: data, every digit"),
    "png": Format("figure", "image/png", "PNG, 300 dots per inch"),
    "svg": Format("figure", "image/svg+xml; charset=utf-8", "SVG"),
    "pdf": Format("figure", "application/pdf", "PDF"),
    "webm": Format("film", "video/webm", "WebM: a film of the motion"),
    "mp4": Format("film", "video/mp4", "MP4: a film of the motion, for slides"),
    "html": Format("state", "text/html; charset=utf-8", "HTML: all pictures, plays without a server"),
    "py": Format("program", "text/x-python; charset=utf-8"),
    "ipynb": Format("program", "application/x-ipynb+json"),
}
"""File formats by suffix."""

WIDTHS, FILM_WIDTHS = Bounds(20.0, 400.0), Bounds(60.0, 160.0)
"""Width of a figure and of a film in millimetres; it determines the relative size of text and lines."""
SECONDS, SERVED_SECONDS = Bounds(1.0, 60.0), Bounds(1.0, 30.0)
"""Duration in seconds of a film, and of a film that a server makes."""


class Loop(NamedTuple):
    """A film that repeats itself, 1080 pixels wide.

    Attributes
    ----------
    dark : bool
        True for the dark colours of the page.
    home : str
        Address of the page, for the link below the picture.
    """

    dark: bool = False
    home: str = ""


@dataclass(frozen=True)
class FileRequest:
    """A requested file.

    Attributes
    ----------
    kind : str
        Suffix of the file, a key of `FORMATS`.
    width : float
        Width of a figure or film in millimetres.
    black : bool
        True for black on white.
    seconds : float
        Duration of a film in seconds.
    loop : Loop or None
        Settings of a film that repeats itself; None for other files.
    """

    kind: str = "csv"
    width: float = 85.0
    black: bool = False
    seconds: float = 10.0
    loop: Loop | None = None


def formats_of(*what: str) -> tuple[str, ...]:
    """Return the suffixes of the formats of some categories, in the order of `FORMATS`."""
    return tuple(kind for kind, one in FORMATS.items() if one.content in what)
