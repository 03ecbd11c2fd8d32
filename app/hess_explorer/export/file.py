"""A picture of a state as a file of any of the formats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from hess_explorer.export.figure import FORMATS, as_file
from hess_explorer.export.film import FILMS, as_film
from hess_explorer.export.shown import Shown
from hess_explorer.export.table import as_csv, as_json

__all__ = ["Wish", "content"]


@dataclass(frozen=True)
class Wish:
    """What a file is to be: its format; of figures and films millimetres and whether in black; of films the length."""

    kind: str = "csv"
    width: float = 85.0
    black: bool = False
    seconds: float = 10.0


def content(found: Shown, wish: Wish, tell: Callable[[int, int], None] = lambda done, of: None) -> bytes:
    """The bytes of the file; tell : as of `as_film`.  Raises `InvalidParameter`."""
    if wish.kind in FILMS:
        return as_film(found, wish.kind, wish.width, wish.black, wish.seconds, tell)
    if wish.kind in FORMATS:
        return as_file(found, wish.kind, wish.width, wish.black)
    return (as_csv if wish.kind == "csv" else as_json)(found).encode()
