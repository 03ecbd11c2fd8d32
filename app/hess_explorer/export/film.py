"""A picture in motion as a film: its figure at even times, with the moving point, encoded by ffmpeg."""

from __future__ import annotations

import subprocess
import tempfile
import textwrap
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hess_explorer.export.figure import STYLE, draw_moving, draw_still, in_black
from hess_explorer.export.formats import FILM_WIDTHS, SECONDS
from hess_explorer.export.moment import end
from hess_explorer.export.plots import densities
from hess_explorer.export.shown import Shown
from hess_explorer.views.body import BodyInSpace
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import as_it_is
from hess_explorer.views.poisson_sphere import Sphere
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.artist import Artist

__all__ = ["RATE", "as_film", "moves", "pictures_at", "times_of"]

_CODECS: Mapping[str, str] = {
    "webm": "-c:v libvpx-vp9 -b:v 0 -crf 30 -deadline realtime -cpu-used 6 -pix_fmt yuv420p",
    "mp4": "-c:v libx264 -preset veryfast -crf 20 -movflags +faststart+use_metadata_tags -pix_fmt yuv420p",
    # The colours of the film itself, which are few.
    "gif": "-filter_complex split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none",
}
"""What ffmpeg is told for each format: thin lines stay clear, and a minute of them is some megabytes."""

RATE = 25
"""Frames a second."""
_PIXELS = 8
"""For a millimetre."""
_INCH = 25.4
_AXIS, _LETTER, _CLOCK = 13.0, 1.75, 11
"""Millimetres of what is written beside a plot, and of a letter; the letters of the clock, with the space before it."""


def moves(shown: Shown) -> bool:
    """Whether something moves in the picture of this state."""
    picture = shown.picture
    follows = (
        bool(picture.followers)
        or bool(densities(shown))
        or isinstance(picture, (BodyInSpace, CloudPlane))
        or (isinstance(picture, Sphere) and ("orbit" in picture.looks or bool(picture.clouds)))
    )
    return follows and end(shown.columns) > 0.0


def times_of(shown: Shown, seconds: float) -> Array:
    """The times of the frames, (n,): all of the motion in so many seconds, its first and its last moment included."""
    return np.linspace(0.0, end(shown.columns), round(RATE * seconds))


def pictures_at(shown: Shown, times: Array, width: float = 85.0, black: bool = False) -> Iterator[Array]:
    """Red, green, blue (n, n, 3) of each frame; n is even.  What stands still is drawn once."""
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    side = _side(width) / (_PIXELS * _INCH)
    colour = in_black if black else as_it_is
    with mpl.rc_context(dict(STYLE)):
        figure = Figure(figsize=(side, side), dpi=_PIXELS * _INCH, layout="constrained")
        canvas = FigureCanvasAgg(figure)
        frame = figure.add_subplot()
        draw_still(frame, shown, colour)
        frame.set_title(_title(shown.title, width), loc="left", y=1.0, fontsize="medium")
        clock = frame.set_title("t = 0", loc="right", y=1.0, fontsize="medium")
        canvas.draw()
        # The places are those of this layout; the clock is drawn anew.
        clock.set_text("")
        figure.set_layout_engine("none")
        canvas.draw()
        still = canvas.copy_from_bbox(figure.bbox)
        before = set(frame.get_children())
        for t in times:
            canvas.restore_region(still)
            draw_moving(frame, shown, colour, float(t), point=True)
            clock.set_text(f"t = {t:.2f}")
            moving: list[Artist] = [one for one in frame.get_children() if one not in before]
            for one in [*sorted(moving, key=lambda artist: artist.get_zorder()), clock]:
                frame.draw_artist(one)
            yield np.asarray(canvas.buffer_rgba())[..., :3]
            for one in moving:
                one.remove()


def _side(width: float) -> int:
    """Pixels, an even number."""
    return 2 * round(0.5 * _PIXELS * width)


def _title(title: str, width: float) -> str:
    """In lines beside the clock, or above it where there is no room for both."""
    room = int((width - _AXIS) / _LETTER)
    return title if len(title) + _CLOCK <= room else textwrap.fill(title, room) + "\n"


def as_film(
    shown: Shown,
    kind: str,
    width: float = 85.0,
    black: bool = False,
    seconds: float = 10.0,
    tell: Callable[[int, int], None] = lambda done, of: None,
) -> bytes:
    """The whole motion in so many seconds, as WebM, MP4 or GIF, square, 8 pixels a millimetre; its tags say the facts.

    tell : is told after each frame how many there are, and of how many.

    Raises
    ------
    InvalidParameter : no such format, width or length, nothing moves, or the libraries are not installed.
    """
    if kind not in _CODECS:
        raise InvalidParameter(f"{kind!r} is no format of a film: choose one of {', '.join(_CODECS)}.")
    for value, bounds, what in ((width, FILM_WIDTHS, "mm wide"), (seconds, SECONDS, "seconds long")):
        if not bounds.low <= value <= bounds.high:
            raise InvalidParameter(f"A film is {bounds} {what}, not {value:g}.")
    if not moves(shown):
        raise InvalidParameter(f"Nothing moves in “{shown.title}” in this state: choose another picture, or a figure.")
    try:
        import imageio_ffmpeg
        import matplotlib  # noqa: F401
    except ImportError as error:
        raise InvalidParameter(
            "Films need Matplotlib and imageio-ffmpeg: pip install 'hess-explorer[export]'. CSV and JSON need nothing."
        ) from error
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"film.{kind}"
        times = times_of(shown, seconds)
        tags = {"title": shown.title, "comment": shown.said, "description": shown.caption}
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
                for done, picture in enumerate(pictures_at(shown, times, width, black), 1):
                    encoder.stdin.write(picture.tobytes())
                    tell(done, len(times))
                encoder.stdin.close()
                said = encoder.stderr.read().decode(errors="replace").strip()
            except BrokenPipeError:
                said = encoder.stderr.read().decode(errors="replace").strip() or "it has ended"
            except BaseException:
                # Stopped: nothing is left behind.
                encoder.kill()
                raise
        if encoder.returncode or not path.exists():
            raise InvalidParameter(f"The film could not be encoded ({said.splitlines()[-1] if said else 'no reason'}).")
        film = path.read_bytes()
        return _commented(film, "\n".join(tags.values())) if kind == "gif" else film


def _commented(gif: bytes, text: str) -> bytes:
    """With a comment, which ffmpeg does not write, behind the header and the colours of all frames."""
    head, data = 13 + (3 << (gif[10] % 8 + 1) if gif[10] & 0x80 else 0), text.encode()
    parts = [data[i : i + 255] for i in range(0, len(data), 255)]
    return gif[:head] + b"\x21\xfe" + b"".join(bytes([len(part)]) + part for part in parts) + b"\0" + gif[head:]
