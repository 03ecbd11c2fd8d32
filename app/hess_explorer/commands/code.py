"""`hess-explorer code`: the lines of Python that compute and draw what the page shows."""

from __future__ import annotations

import argparse
from pathlib import Path
from urllib.parse import urlencode

from .output import computing, show, write_file
from .shot import state_of

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "code", help="the lines of Python that compute and draw what the page shows",
        description="Print the few lines of Python that compute and draw what a picture of the page shows in the state "
                    "that a link describes. They leave the numbers in `data`, by the names of the CSV of "
                    "`hess-explorer export` and equal to them bit for bit; or write a notebook of them.",
        epilog="Example: hess-explorer code --state 'h=1.2&f=0.3' --picture circle > circle.py")
    parser.add_argument("--state", type=state_of, default={}, metavar="QUERY",
                        help="what follows ? in a link to the page (default: its first view)")
    parser.add_argument("--picture", default="", metavar="NAME",
                        help="the name of the picture, as in pictures=… of a link that embeds (default: the first)")
    parser.add_argument("--format", choices=("py", "ipynb"), default="py", help="py (default) or ipynb, a notebook")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write to this file instead of standard output")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_explorer.export.notebook import PROGRAMS
        from hess_explorer.export.shown import address

        text = PROGRAMS[options.format](address(urlencode(options.state), options.picture))
    if options.out is not None:
        write_file(options.out, text.encode())
    else:
        show(text.encode())
