"""`hess-explorer code`: the lines of Python that compute and draw what the page shows."""

from __future__ import annotations

from hess_explorer.export.formats import holding

from .command import Command, Options, option, picture
from .output import computing, show

__all__ = ["COMMAND"]


def _run(options: Options) -> None:
    with computing():
        from hess_explorer.export.notebook import PROGRAMS
        from hess_explorer.export.shown import address

        text = PROGRAMS[options.format](address(options.state, options.picture, lenient=options.lenient))
    show(text.encode(), options.out)


COMMAND = Command(
    "Print the few lines of Python that compute and draw what a picture of the page shows in the state that a link "
    "describes. They leave the numbers in `data`, by the names of the CSV of `hess-explorer export` and equal to them "
    "bit for bit; or write a notebook of them.",
    (*picture(), option("--format", "py (default) or ipynb, a notebook", choices=holding("program"), default="py")),
    _run,
    "--state 'h=1.2&f=0.3' --picture circle > circle.py",
)
