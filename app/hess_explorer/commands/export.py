"""`hess-explorer export`: what a picture of the page shows, as a table, a figure for paper or a film; or all of it."""

from __future__ import annotations

import sys
from collections.abc import Callable

from hess_explorer.export.formats import FILM_WIDTHS, SECONDS, WIDTHS, Wish, holding

from . import CommandError
from .command import Command, Options, flag, option, picture
from .output import computing, show

__all__ = ["COMMAND"]

_TEXTS = ("csv", "json", "svg", "html")


def _teller(lines: bool) -> Callable[[int, int], None]:
    """How far a film is: in lines, or in one that changes where somebody looks on."""
    seen = sys.stderr.isatty()

    def tell(done: int, of: int) -> None:
        if lines:
            print(f"{done}/{of}", file=sys.stderr, flush=True)
        elif seen:
            print(f"\rframe {done} of {of}", end="" if done < of else "\n", file=sys.stderr, flush=True)

    return tell


def _page(options: Options) -> bytes:
    from hess_explorer.page.offline import as_html

    pictures = options.picture.split(",") if options.picture else ()
    return as_html(options.state, pictures, lenient=options.lenient)[1]


def _picture(options: Options) -> bytes:
    from hess_explorer.export.file import content
    from hess_explorer.export.shown import shown

    found = shown(options.state, options.picture, lenient=options.lenient)
    wish = Wish(options.format, options.width, options.black, options.seconds)
    return content(found, wish, _teller(options.progress))


def _run(options: Options) -> None:
    if options.out is None and options.format not in _TEXTS:
        raise CommandError(f"{options.format.upper()} is no text: name a file with --out FILE.")
    # A film shows its own progress.
    with computing(told=options.format in holding("film")):
        data = _page(options) if options.format == "html" else _picture(options)
    show(data, options.out)


COMMAND = Command(
    "Compute the state that a link describes and write what one of its pictures shows: its data, every digit, as CSV "
    "or JSON, or a square figure as PNG, SVG or PDF, with bodies and clouds at the link's time, without the moving "
    "point, or a film of its motion as WebM, MP4 or GIF. HTML has all pictures of the state in one file that plays and "
    "turns without a server. Every file says link, parameters, accuracy, errors and version. Figures and films need "
    "the extra: pip install '.[export]'.",
    (
        *picture("; of HTML some with commas between, by default those that are open at first"),
        option("--format", "default: csv", choices=holding("data", "figure", "film", "state"), default=Wish.kind),
        option(
            "--width",
            f"of a figure, {WIDTHS} millimetres (default 85, a column of a journal); of a film "
            f"{FILM_WIDTHS}, at 8 pixels a millimetre",
            type=float,
            default=Wish.width,
            metavar="MM",
        ),
        option(
            "--seconds",
            f"length of a film, of all of the motion: {SECONDS} (default 10), 25 frames a second",
            type=float,
            default=Wish.seconds,
            metavar="S",
        ),
        flag("--black", "a figure or a film in black on white instead of the page's colours"),
        flag("--progress", "say on standard error, a line each, how many frames of a film there are, of how many"),
    ),
    _run,
    "--state 'h=1.2&f=0.3' --picture circle --format csv --out circle.csv",
)
