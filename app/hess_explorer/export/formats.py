"""Formats of files, and how large and long figures and films may be: for commands, server and `SceneState.save`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["FILM_WIDTHS", "FORMATS", "SECONDS", "SERVED_SECONDS", "WIDTHS", "Bounds", "Format", "Wish", "holding"]


class Bounds(NamedTuple):
    """Of a number."""

    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.low:g} to {self.high:g}"


class Format(NamedTuple):
    """What a file holds (data, figure, film, the whole state or a program), its media type, its words in the dialog."""

    holds: str
    media: str
    words: str = ""


FORMATS: Mapping[str, Format] = {
    "csv": Format("data", "text/csv; charset=utf-8", "CSV: data, every digit"),
    "json": Format("data", "application/json", "JSON: data, every digit"),
    "png": Format("figure", "image/png", "PNG, 300 dots an inch"),
    "svg": Format("figure", "image/svg+xml; charset=utf-8", "SVG"),
    "pdf": Format("figure", "application/pdf", "PDF"),
    "webm": Format("film", "video/webm", "WebM: a film of the motion"),
    "mp4": Format("film", "video/mp4", "MP4: a film of the motion"),
    "gif": Format("film", "image/gif", "GIF: a film of the motion, for slides"),
    "html": Format("state", "text/html; charset=utf-8", "HTML: all pictures, plays without a server"),
    "py": Format("program", "text/x-python; charset=utf-8"),
    "ipynb": Format("program", "application/x-ipynb+json"),
}
"""By the ending of the file."""

WIDTHS, FILM_WIDTHS = Bounds(20.0, 400.0), Bounds(60.0, 160.0)
"""Millimetres of a figure, and of a film, which fix how large its type is beside its lines."""
SECONDS, SERVED_SECONDS = Bounds(1.0, 60.0), Bounds(1.0, 30.0)
"""Of a film, and of one that a server makes."""


@dataclass(frozen=True)
class Wish:
    """What a file is to be: its format; of figures and films millimetres and whether in black; of films the length."""

    kind: str = "csv"
    width: float = 85.0
    black: bool = False
    seconds: float = 10.0


def holding(*what: str) -> tuple[str, ...]:
    """The formats that hold one of these."""
    return tuple(kind for kind, one in FORMATS.items() if one.holds in what)
