"""Location of the browser's files: next to the packages in a checkout, inside this package once installed."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

_HERE = Path(__file__).resolve().parent
STATIC = next(folder for folder in (_HERE / "static", _HERE.parents[1] / "static") if folder.is_dir())


@cache
def modules_path() -> str:
    """Return the URL folder of the modules, relative to the page; its name contains a hash of modules and images."""
    digest = hashlib.sha256()
    for file in sorted([*STATIC.glob("*/*.js"), *STATIC.glob("thumbnails/*.jpg")]):
        digest.update(file.relative_to(STATIC).as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
    return f"modules-{digest.hexdigest()[:16]}"
