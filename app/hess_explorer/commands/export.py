"""`hess-explorer export`: what a picture of the page shows, as a table or as a figure for paper."""

from __future__ import annotations

import argparse
from pathlib import Path
from urllib.parse import urlencode

from . import CommandError
from .output import computing, show, write_file
from .shot import state_of

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "export", help="what a picture of the page shows, as CSV, JSON, PNG, SVG or PDF",
        description="Compute the state that a link describes and write what one of its pictures shows: its data, every "
                    "digit, as CSV or JSON, or a square figure as PNG, SVG or PDF, with bodies and clouds at the "
                    "link's time, without the moving point. Every file says link, parameters, accuracy, errors and "
                    "version. Figures need the extra: "
                    "pip install '.[export]'.",
        epilog="Example: hess-explorer export --state 'h=1.2&f=0.3' --picture circle --format csv --out circle.csv")
    parser.add_argument("--state", type=state_of, default={}, metavar="QUERY",
                        help="what follows ? in a link to the page (default: its first view)")
    parser.add_argument("--picture", default="", metavar="NAME",
                        help="the name of the picture, as in pictures=… of a link that embeds (default: the first)")
    parser.add_argument("--format", choices=("csv", "json", "png", "svg", "pdf"), default="csv", help="default: csv")
    parser.add_argument("--width", type=float, default=85.0, metavar="MM",
                        help="of a figure, 20 to 400 millimetres (default 85, a column of a journal)")
    parser.add_argument("--black", action="store_true", help="a figure in black on white instead of the page's colours")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write to this file instead of standard output")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    if options.out is None and options.format in ("png", "pdf"):
        raise CommandError(f"A {options.format.upper()} is no text: name a file with --out FILE.")
    with computing():
        from hess_explorer.export.file import content
        from hess_explorer.export.shown import shown

        found = shown(urlencode(options.state), options.picture)
        data = content(found, options.format, options.width, options.black)
    if options.out is not None:
        write_file(options.out, data)
    else:
        show(data)
