"""Atomic writing of files: a file is complete or absent."""

from __future__ import annotations

import os
import shutil
import uuid
from contextlib import suppress
from pathlib import Path

__all__ = ["write_atomically"]


def write_atomically(path: str | Path, content: bytes, modified: float | None = None) -> None:
    """Write a file atomically: an earlier version stays unchanged until the new version is complete.

    Parameters
    ----------
    path : str or Path
        Path of the file; a link still points to its file afterwards.
    content : bytes
        The new content.
    modified : float, optional
        Time of modification, in seconds since 1970.  By default the present.

    Raises
    ------
    OSError
        If the file cannot be written, for example because the disk is full; no part of it is left.
    """
    # Write to the target of a symbolic link, which keeps the link.
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        # A device or pipe has no previous content to protect.
        target.write_bytes(content)
        return
    part = target.with_name(f".{uuid.uuid4().hex}.part")
    try:
        with part.open("xb") as file:
            file.write(content)
            file.flush()
            # Some file systems report a full disk only on fsync.
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
            # Name the target instead of the temporary file in the message.
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise
