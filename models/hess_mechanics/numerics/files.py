"""Files that are whole or not there."""

from __future__ import annotations

import os
import shutil
import uuid
from contextlib import suppress
from pathlib import Path

__all__ = ["write_whole"]


def write_whole(path: str | Path, content: bytes, modified: float | None = None) -> None:
    """Write a file at once: an earlier one stays as it is until the new one is complete.

    `modified` is the file's time of modification, in seconds since 1970, by default the present.

    Raises `OSError`, for example if the disk is full, and leaves no part of the new file.
    """
    # A link keeps pointing to its file.
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        # A device or pipe has no earlier content to keep.
        target.write_bytes(content)
        return
    part = target.with_name(f".{uuid.uuid4().hex}.part")
    try:
        with part.open("xb") as file:
            file.write(content)
            file.flush()
            # Some file systems report only here that the disk is full.
            os.fsync(file.fileno())
        if modified is not None:
            os.utime(part, (modified, modified))
        if target.exists():
            shutil.copymode(target, part)
        part.replace(target)
    except BaseException as error:
        with suppress(OSError):
            part.unlink()
        if isinstance(error, OSError):
            # Without the name of the part.
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise
