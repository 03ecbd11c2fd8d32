"""`hess-explorer code`: Python code that computes and draws a picture of the page."""

from __future__ import annotations

from hess_explorer.export.formats import holding

from .command import Command, Options, option, picture
from .output import computing, show

__all__ = ["COMMAND"]


def _run(options: Options) -> None:
    with computing():
        from hess_explorer.export.notebook import PROGRAMS
        from hess_explorer.export.picture_data import address

        text = PROGRAMS[options.format](address(options.state, options.picture, lenient=options.lenient))
    show(text.encode(), options.out)


COMMAND = Command(
    "Print the Python code that computes and draws a picture of the page in the state that a link describes, or write "
    "it as a notebook. The code stores the numbers in `data`, with the column names of `hess-explorer export --format "
    "csv` and the same values to the last bit.",
    (
        *picture(),
        option("--format", "py (default) or ipynb, a notebook", choices=holding("program"), default="py"),
    ),
    _run,
    "--state 'h=1.2&f=0.3' --picture circle > circle.py",
)
