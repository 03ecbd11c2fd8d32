"""Write a picture as a table, or a plot as a figure."""

from __future__ import annotations

from hess_explorer.export.figure import as_file
from hess_explorer.export.formats import FileRequest
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.table import as_csv, as_json

__all__ = ["content"]


def content(data: PictureData, request: FileRequest) -> bytes:
    """Return the contents of the file.  Raises `InvalidParameter`."""
    if request.kind in ("csv", "json"):
        return (as_csv if request.kind == "csv" else as_json)(data).encode()
    return as_file(data, request.kind, request.width, request.black)
