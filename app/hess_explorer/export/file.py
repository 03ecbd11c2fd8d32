"""A picture of a state as a file of any of the formats."""

from __future__ import annotations

from hess_explorer.export.figure import FORMATS, as_file
from hess_explorer.export.shown import Shown
from hess_explorer.export.table import as_csv, as_json

__all__ = ["content"]


def content(found: Shown, kind: str, width: float, black: bool) -> bytes:
    """The bytes of the file; width in millimetres and black of a figure, see `as_file`.  Raises `InvalidParameter`."""
    if kind in FORMATS:
        return as_file(found, kind, width, black)
    return (as_csv if kind == "csv" else as_json)(found).encode()
