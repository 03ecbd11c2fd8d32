"""`hess-explorer code`: the lines of Python that compute and draw what the page shows."""

from __future__ import annotations

import argparse

from hess_explorer.export.formats import holding

from .output import add_picture, computing, show

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "code", help="the lines of Python that compute and draw what the page shows",
        description="Print the few lines of Python that compute and draw what a picture of the page shows in the state "
                    "that a link describes. They leave the numbers in `data`, by the names of the CSV of "
                    "`hess-explorer export` and equal to them bit for bit; or write a notebook of them.",
        epilog="Example: hess-explorer code --state 'h=1.2&f=0.3' --picture circle > circle.py")
    add_picture(parser)
    parser.add_argument("--format", choices=holding("program"), default="py", help="py (default) or ipynb, a notebook")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_explorer.export.notebook import PROGRAMS
        from hess_explorer.export.shown import address

        text = PROGRAMS[options.format](address(options.state, options.picture, lenient=options.lenient))
    show(text.encode(), options.out)
