"""Where the browser's files are: beside the packages in a checkout, inside this one once installed."""

from __future__ import annotations

from pathlib import Path

__all__ = ["STATIC"]

_HERE = Path(__file__).resolve().parent
STATIC = next(folder for folder in (_HERE / "static", _HERE.parents[1] / "static") if folder.is_dir())
