"""`hess-explorer export`: a picture of the page as a table, figure or film, or the whole state as HTML."""

from __future__ import annotations

import sys
from collections.abc import Callable

from hess_explorer.export.formats import FILM_WIDTHS, SECONDS, WIDTHS, FileRequest, Loop, holding

from . import CommandError
from .command import Command, Options, flag, option, picture
from .output import computing, show

__all__ = ["COMMAND"]

_TEXTS = ("csv", "json", "svg", "html")


def _progress_printer(lines: bool) -> Callable[[int, int], None]:
    """Return a function that prints the progress of a film: as lines, or as one changing line in a terminal."""
    seen = sys.stderr.isatty()

    def report(done: int, of: int) -> None:
        if lines:
            print(f"{done}/{of}", file=sys.stderr, flush=True)
        elif seen:
            print(f"\rframe {done} of {of}", end="" if done < of else "\n", file=sys.stderr, flush=True)

    return report


def _page(options: Options) -> bytes:
    from hess_explorer.offline.pages import state_page

    pictures = options.picture.split(",") if options.picture else ()
    return state_page(options.state, pictures, lenient=options.lenient)[1]


def _picture(options: Options) -> bytes:
    from hess_explorer.export.file import content
    from hess_explorer.export.picture_data import picture_data

    found = picture_data(options.state, options.picture, lenient=options.lenient)
    loop = Loop(options.loop == "dark", options.page) if options.loop else None
    request = FileRequest(options.format, options.width, options.black, options.seconds, loop)
    return content(found, request, _progress_printer(options.progress))


def _run(options: Options) -> None:
    if options.out is None and options.format not in _TEXTS:
        raise CommandError(f"{options.format.upper()} is a binary format: name a file with --out FILE.")
    # A film prints its own progress.
    with computing(own_progress=options.format in holding("film")):
        data = _page(options) if options.format == "html" else _picture(options)
    show(data, options.out)


COMMAND = Command(
    "Export a picture of the state that a link describes: its data in full precision as CSV or JSON; a square figure "
    "as PNG, SVG or PDF, with bodies and clouds at the time of the link and without the moving point; or a film of the "
    "motion as WebM, MP4 or GIF. HTML contains several pictures of the state in one interactive file that needs no "
    "server. Every file contains link, parameters, accuracy, errors and version. Figures and films require: pip "
    "install 'hess-explorer[export]'.",
    (
        *picture("; for HTML a list with commas, by default those open at first"),
        option(
            "--format",
            "file format (default: csv)",
            choices=holding("data", "figure", "film", "state"),
            default=FileRequest.kind,
        ),
        option(
            "--width",
            f"width in millimetres (default 85, a journal column): {WIDTHS} for a figure, {FILM_WIDTHS} for a film, "
            "which has 8 pixels per millimetre",
            type=float,
            default=FileRequest.width,
            metavar="MM",
        ),
        option(
            "--seconds",
            f"duration of a film of the whole motion, {SECONDS} seconds (default 10), 25 frames per second",
            type=float,
            default=FileRequest.seconds,
            metavar="S",
        ),
        option(
            "--loop",
            "a film that repeats itself, 1080 pixels wide with a caption and the link: one period of a periodic "
            "motion, otherwise there and back",
            choices=("light", "dark"),
            default=None,
        ),
        option("--page", "address of the page, for the link in a loop", default="", metavar="URL"),
        flag("--black", "draw in black on white instead of the colours of the page"),
        flag("--progress", "print the progress of a film to stderr, one line per frame"),
    ),
    _run,
    "--state 'h=1.2&f=0.3' --picture circle --format csv --out circle.csv",
)
