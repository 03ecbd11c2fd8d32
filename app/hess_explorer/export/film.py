"""Make a film of a picture: frames at evenly spaced times, with the moving point, encoded by ffmpeg."""

from __future__ import annotations

import subprocess
import tempfile
import textwrap
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hess_explorer.export.figure import STYLE, draw_moving, draw_still, in_black
from hess_explorer.export.formats import FILM_WIDTHS, SECONDS, Loop
from hess_explorer.export.loop import WIDTH, footer, in_dark, loop_times, on_dark
from hess_explorer.export.moment import end
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.plots import densities
from hess_explorer.views.body import BodyInSpace
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import as_it_is
from hess_explorer.views.poisson_sphere import Sphere
from hess_explorer.views.torus_in_space import TorusInSpace
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.artist import Artist

__all__ = ["RATE", "as_film", "moves", "pictures_at", "times_of"]

_CODECS: Mapping[str, str] = {
    "webm": "-c:v libvpx-vp9 -b:v 0 -crf 30 -deadline realtime -cpu-used 6 -pix_fmt yuv420p",
    "mp4": "-c:v libx264 -preset veryfast -crf 20 -movflags +faststart+use_metadata_tags -pix_fmt yuv420p",
    # A palette from the film itself, which has few colours.
    "gif": "-filter_complex split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none",
}
"""Options of ffmpeg for each format; thin lines stay clear, and a minute takes a few megabytes."""

RATE = 25
"""Frames per second."""
_PIXELS = 8
"""Pixels per millimetre."""
_INCH = 25.4
_AXIS, _LETTER, _CLOCK = 13.0, 1.75, 11
"""Width of the axis labels and of a letter in millimetres; length of the clock in letters, including a space."""


def moves(data: PictureData) -> bool:
    """Return True if the picture changes with time."""
    picture = data.picture
    follows = (
        bool(picture.followers)
        or bool(densities(data))
        or isinstance(picture, (BodyInSpace, CloudPlane, TorusInSpace))
        or (isinstance(picture, Sphere) and ("orbit" in picture.looks or bool(picture.clouds)))
    )
    return follows and end(data.columns) > 0.0


def times_of(data: PictureData, seconds: float) -> Array:
    """Return the times of the frames (n,), which spread the whole motion over `seconds`, both ends included."""
    return np.linspace(0.0, end(data.columns), round(RATE * seconds))


def pictures_at(
    data: PictureData, times: Array, width: float = 85.0, black: bool = False, loop: Loop | None = None
) -> Iterator[Array]:
    """Yield the RGB image (n, n, 3) of each frame, n even.  Static parts are drawn only once.

    loop : adds the lines below a loop, in the colours of its page.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    side = _side(width) / (_PIXELS * _INCH)
    dark = loop is not None and loop.dark
    colour = in_dark if dark else in_black if black else as_it_is
    with mpl.rc_context({**STYLE, **(on_dark() if dark else {})}):
        figure = Figure(figsize=(side, side), dpi=_PIXELS * _INCH, layout="constrained")
        canvas = FigureCanvasAgg(figure)
        frame = figure.add_subplot()
        draw_still(frame, data, colour)
        frame.set_title(_title(data.title, width), loc="left", y=1.0, fontsize="medium")
        clock = frame.set_title("t = 0", loc="right", y=1.0, fontsize="medium")
        if loop is not None:
            figure.supxlabel(footer(data, loop.home), x=0.02, ha="left", fontsize=6.5, parse_math=False)
        canvas.draw()
        # Keep this layout; only the clock is redrawn in each frame.
        clock.set_text("")
        figure.set_layout_engine("none")
        canvas.draw()
        still = canvas.copy_from_bbox(figure.bbox)
        before = set(frame.get_children())
        for t in times:
            canvas.restore_region(still)
            draw_moving(frame, data, colour, float(t), point=True)
            clock.set_text(f"t = {t:.2f}")
            moving: list[Artist] = [one for one in frame.get_children() if one not in before]
            for one in [*sorted(moving, key=lambda artist: artist.get_zorder()), clock]:
                frame.draw_artist(one)
            yield np.asarray(canvas.buffer_rgba())[..., :3]
            for one in moving:
                one.remove()


def _side(width: float) -> int:
    """Return the side of a frame in pixels, an even number."""
    return 2 * round(0.5 * _PIXELS * width)


def _title(title: str, width: float) -> str:
    """Return the title on one line with the clock, or wrapped above it if there is not enough room."""
    room = int((width - _AXIS) / _LETTER)
    return title if len(title) + _CLOCK <= room else textwrap.fill(title, room) + "\n"


def as_film(
    data: PictureData,
    kind: str,
    width: float = 85.0,
    black: bool = False,
    seconds: float = 10.0,
    report: Callable[[int, int], None] = lambda done, of: None,
    loop: Loop | None = None,
) -> bytes:
    """Return a square film of the whole motion, whose tags contain link, parameters and version.

    Parameters
    ----------
    data : PictureData
        The picture and its data.
    kind : str
        "webm", "mp4" or "gif".
    width : float
        Width in millimetres, with 8 pixels per millimetre.
    black : bool
        True for black on white instead of the colours of the page.
    seconds : float
        Duration in seconds.
    report : callable
        Called after each frame with the number of frames done and their total.
    loop : Loop or None
        Play one period of a periodic motion, and another motion there and back, so that the end meets the beginning.
        A loop is 1080 pixels wide, whatever the width.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If format, width or duration are not supported, nothing moves, or a library is not installed.
    """
    width = width if loop is None else WIDTH
    if kind not in _CODECS:
        raise InvalidParameter(f"{kind!r} is not a film format: choose one of {', '.join(_CODECS)}.")
    FILM_WIDTHS.require("A film", width, "mm wide")
    SECONDS.require("A film", seconds, "seconds long")
    if not moves(data):
        raise InvalidParameter(f"Nothing moves in “{data.title}” in this state: choose another picture, or a figure.")
    try:
        import imageio_ffmpeg
        import matplotlib  # noqa: F401
    except ImportError as error:
        raise InvalidParameter(
            "Films need Matplotlib and imageio-ffmpeg: pip install 'hess-explorer[export]'. CSV and JSON work without "
            "them."
        ) from error
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"film.{kind}"
        times = times_of(data, seconds) if loop is None else loop_times(data, round(RATE * seconds))
        tags = {"title": data.title, "comment": data.metadata_text, "description": data.caption}
        command = [
            imageio_ffmpeg.get_ffmpeg_exe(),
            *f"-loglevel error -f rawvideo -pix_fmt rgb24 -s {_side(width)}x{_side(width)} -r {RATE} -i -".split(),
            *f"{_CODECS[kind]} -threads 1".split(),
            *(part for name, text in tags.items() for part in ("-metadata", f"{name}={text}")),
            str(path),
        ]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as encoder:
            assert encoder.stdin is not None
            assert encoder.stderr is not None
            try:
                for done, picture in enumerate(pictures_at(data, times, width, black, loop), 1):
                    encoder.stdin.write(picture.tobytes())
                    report(done, len(times))
                encoder.stdin.close()
                log = encoder.stderr.read().decode(errors="replace").strip()
            except BrokenPipeError:
                log = encoder.stderr.read().decode(errors="replace").strip() or "it has ended"
            except BaseException:
                # Do not leave the encoder running.
                encoder.kill()
                raise
        if encoder.returncode or not path.exists():
            raise InvalidParameter(f"The film could not be encoded ({log.splitlines()[-1] if log else 'no reason'}).")
        film = path.read_bytes()
        return _commented(film, "\n".join(tags.values())) if kind == "gif" else film


def _commented(gif: bytes, text: str) -> bytes:
    """Insert a comment, which ffmpeg does not write, after the header and the global palette of a GIF."""
    head, data = 13 + (3 << (gif[10] % 8 + 1) if gif[10] & 0x80 else 0), text.encode()
    parts = [data[i : i + 255] for i in range(0, len(data), 255)]
    return gif[:head] + b"\x21\xfe" + b"".join(bytes([len(part)]) + part for part in parts) + b"\0" + gif[head:]
