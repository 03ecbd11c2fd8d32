"""Where the browser's files are: beside the packages in a checkout, inside this one once installed."""

from __future__ import annotations

import hashlib
from pathlib import Path

__all__ = ["MODULES", "STATIC", "modules_path"]

_HERE = Path(__file__).resolve().parent
STATIC = next(folder for folder in (_HERE / "static", _HERE.parents[1] / "static") if folder.is_dir())

MODULES = r"(?:page|controls|pictures)/[a-z_]+\.js|page/handout\.css"
"""A regular expression for the paths of JavaScript modules in that folder, and of the styles of what is printed."""


def modules_path() -> str:
    """The folder of their URL, relative to the page's: another one when any of them has changed."""
    digest = hashlib.sha256()
    for file in sorted([*STATIC.glob("*/*.js"), STATIC / "page/handout.css"]):
        digest.update(file.relative_to(STATIC).as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
    return f"modules-{digest.hexdigest()[:16]}"
