"""Make a film of a picture: frames drawn by the page at evenly spaced times, encoded by ffmpeg."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable, Generator, Mapping
from contextlib import closing
from pathlib import Path

from hess_explorer.export.formats import FILM_WIDTHS, SECONDS, FileRequest
from hess_explorer.export.motion import film_times, loop_lines, loop_times, moves
from hess_explorer.export.picture_data import PictureData
from hess_explorer.headless.drawing import bytes_of, page_of
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

_CODECS: Mapping[str, str] = {
    "webm": "-c:v libvpx-vp9 -b:v 0 -crf 30 -deadline realtime -cpu-used 6 -pix_fmt yuv420p",
    "mp4": "-c:v libx264 -preset veryfast -crf 20 -movflags +faststart+use_metadata_tags -pix_fmt yuv420p",
}
"""Options of ffmpeg for each format; thin lines stay clear, and a minute takes a few megabytes."""
_REPEATABLE = "-fflags +bitexact -flags:v +bitexact -threads 1"
"""Options of ffmpeg for the same bytes from the same frames."""

_RATE = 25
"""Frames per second."""
_PIXELS = 8
"""Pixels per millimetre."""
_PAGE_PIXELS = 120 / 25.4
"""Pixels of the page per millimetre, as in figures."""
_LOOP = 135.0
"""Width of a loop in millimetres: 1080 pixels."""


def frames(data: PictureData, request: FileRequest, times: Array) -> Generator[bytes]:
    """Yield the frame at each time as PNG: a square with title and clock above the picture, and lines below a loop.

    The frames do not depend on the speed of the machine, because the page draws each requested time.

    Parameters
    ----------
    data : PictureData
        The picture.
    request : FileRequest
        Width and colours; `loop` adds the lines below, and the colours of its page.
    times : array (n,)
        Times of the frames, in the units of the player.

    Yields
    ------
    bytes
        The frames.

    Raises
    ------
    BrowserError
        If there is no browser, or the picture cannot be drawn.
    """
    loop = request.loop
    wanted = {
        "picture": data.picture.name,
        # Encoders take even numbers of pixels.
        "side": 2 * round(0.5 * _PIXELS * (request.width if loop is None else _LOOP)),
        "ratio": _PIXELS / _PAGE_PIXELS,
        "isDark": loop is not None and loop.dark,
        "isBlack": request.black,
        "title": data.title,
        "lines": [] if loop is None else loop_lines(data, loop.home),
    }
    with page_of(data) as draw:
        for t in times:
            yield bytes_of(draw("frameUrl", {**wanted, "t": float(t)}))


def as_film(
    data: PictureData, request: FileRequest, report: Callable[[int, int], None] = lambda done, of: None
) -> bytes:
    """Return a square film of the whole motion, with link, parameters and version in the metadata.

    Parameters
    ----------
    data : PictureData
        The picture.
    request : FileRequest
        Format, "webm" or "mp4"; width in millimetres, with 8 pixels per millimetre; colours; duration in seconds.  A
        loop plays one period of a periodic motion, and another motion there and back, so that the end meets the
        beginning; it is 1080 pixels wide.
    report : callable
        Called after each frame with the number of frames done and their total.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If width or duration are not supported, nothing moves, a library is not installed, or the encoder fails.
    BrowserError
        If there is no browser, or the picture cannot be drawn.
    """
    kind, seconds = request.kind, request.seconds
    if request.loop is None:
        FILM_WIDTHS.require("A film", request.width, "mm wide")
    SECONDS.require("A film", seconds, "seconds long")
    if not moves(data):
        raise InvalidParameter(f"Nothing moves in “{data.title}” in this state: choose another picture, or a figure.")
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise InvalidParameter(
            "Films need imageio-ffmpeg: pip install 'hess-explorer[export]'. CSV and JSON work without it."
        ) from error
    count = round(_RATE * seconds)
    times = (film_times if request.loop is None else loop_times)(data, count)
    tags = {"title": data.title, "comment": data.metadata_text, "description": data.caption}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"film.{kind}"
        command = [
            imageio_ffmpeg.get_ffmpeg_exe(),
            *f"-loglevel error -f image2pipe -c:v png -framerate {_RATE} -i -".split(),
            *f"{_CODECS[kind]} {_REPEATABLE}".split(),
            *(part for name, text in tags.items() for part in ("-metadata", f"{name}={text}")),
            str(path),
        ]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as encoder:
            assert encoder.stdin is not None
            assert encoder.stderr is not None
            try:
                with closing(frames(data, request, times)) as drawn:
                    for done, picture in enumerate(drawn, 1):
                        encoder.stdin.write(picture)
                        report(done, count)
                encoder.stdin.close()
                log = encoder.stderr.read().decode(errors="replace").strip()
            except BrokenPipeError:
                log = encoder.stderr.read().decode(errors="replace").strip() or "it has ended"
            except BaseException:
                # Stop the encoder, which would otherwise keep running.
                encoder.kill()
                raise
        if encoder.returncode or not path.exists():
            reason = log.splitlines()[-1] if log else "no reason given"
            raise InvalidParameter(f"The film could not be encoded ({reason}): choose a shorter or smaller film.")
        return path.read_bytes()
