"""Images of a lesson: files in its folder, sent to the page as `data:` URLs."""

from __future__ import annotations

import base64
from pathlib import Path
from urllib.parse import unquote

MAX_ONE = 300 * 1024
"""Maximum size of an image in bytes."""
MAX_ALL = 2 * 1024 * 1024
"""Maximum size of all images of a lesson in bytes; an image counts each time that it is shown."""

_FORMATS = "png, jpeg and webp"


class ImageError(ValueError):
    """An image cannot be shown; the message contains the reason and a remedy."""


class Images:
    """The images of one lesson by the target that its Markdown names, as `data:` URLs.

    Parameters
    ----------
    folder : Path or None
        Folder of the lesson; None for a text without a file, which may not have images.

    Attributes
    ----------
    urls : dict of str to str
        URLs of the images by target.
    """

    def __init__(self, folder: Path | None) -> None:
        self._folder = folder
        self._total = 0
        self.urls: dict[str, str] = {}

    def add(self, target: str) -> None:
        """Read the image file at a target and store its URL.  Raises `ImageError` if it cannot be shown."""
        raw = self._read(target)
        kind = _kind(raw)
        if kind is None:
            what = "an SVG" if b"<svg" in raw[:1024].lower() else "in an unknown format"
            raise ImageError(f"the image is {what}: {_FORMATS} are allowed.")
        self._total += len(raw)
        if self._total > MAX_ALL:
            raise ImageError(f"a lesson may have at most {MAX_ALL // 1024**2} MB of images; leave some out.")
        self.urls[target] = f"data:image/{kind};base64,{base64.b64encode(raw).decode('ascii')}"

    def _read(self, target: str) -> bytes:
        if self._folder is None:
            raise ImageError("images are not allowed in this text: leave them out.")
        if ":" in target or "\\" in target or target.startswith(("/", "?", "#")):
            raise ImageError("an image is a file beside the lesson, like ![A wheel](wheel.png).")
        folder = self._folder.resolve()
        try:
            path = (folder / unquote(target)).resolve()
            if not path.is_relative_to(folder):
                raise ImageError("the image is outside the folder of the lesson: put it beside the lesson.")
            if not path.is_file():
                raise ImageError("there is no such file beside the lesson: put it there, or correct the name.")
            with path.open("rb") as file:
                raw = file.read(MAX_ONE + 1)
        except ImageError:
            raise
        # A file name may contain a zero byte, be too long, or lead into a cycle of links.
        except (OSError, RuntimeError, ValueError) as error:
            raise ImageError("the image cannot be read: check its name and permissions.") from error
        if len(raw) > MAX_ONE:
            raise ImageError(f"the image has more than {MAX_ONE // 1024} kB: reduce its size.")
        return raw


def _kind(raw: bytes) -> str | None:
    """Return the type of an image by its first bytes, or None."""
    if raw.startswith(b"\x89PNG\r\n\x1a\n"):
        return "png"
    if raw.startswith(b"\xff\xd8\xff"):
        return "jpeg"
    return "webp" if raw.startswith(b"RIFF") and raw[8:12] == b"WEBP" else None
