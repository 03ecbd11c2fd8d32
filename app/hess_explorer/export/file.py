"""Write a picture in any of the file formats."""

from __future__ import annotations

from collections.abc import Callable

from hess_explorer.export.figure import as_file
from hess_explorer.export.film import as_film
from hess_explorer.export.formats import FORMATS, FileRequest
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.table import as_csv, as_json

__all__ = ["content"]


def content(
    found: PictureData, request: FileRequest, report: Callable[[int, int], None] = lambda done, of: None
) -> bytes:
    """Return the contents of the file; report : progress callback of `as_film`.  Raises `InvalidParameter`."""
    holds = FORMATS[request.kind].holds
    if holds == "film":
        return as_film(found, request.kind, request.width, request.black, request.seconds, report, request.loop)
    if holds == "figure":
        return as_file(found, request.kind, request.width, request.black)
    return (as_csv if request.kind == "csv" else as_json)(found).encode()
