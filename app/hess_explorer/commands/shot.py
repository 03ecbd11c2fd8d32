"""`hess-explorer shot`: take a screenshot of the page in a given state."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from urllib.parse import parse_qsl, urlencode

from . import CommandError
from .arguments import shown
from .command import STATE, Command, Options, flag, option
from .output import computing, write_file

__all__ = ["COMMAND"]

_SIDE = range(200, 8001)


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,5})[x×](\d{1,5})", text, re.ASCII)
    if not match or int(match[1]) not in _SIDE or int(match[2]) not in _SIDE:
        raise argparse.ArgumentTypeError(
            f"{shown(text)} is not a size; write it like 1600x950, each side from {_SIDE[0]} to {_SIDE[-1]}"
        )
    return int(match[1]), int(match[2])


def _run(options: Options) -> None:
    from hess_explorer.headless.browser import BrowserError
    from hess_explorer.headless.screenshot import ServerError, screenshot

    if not options.lenient:
        # A state that the page would have to correct is an error.
        with computing():
            from hess_explorer.export.picture_data import address
            from hess_explorer.page.opening import opening

            address(options.state)
            opening(options.state, lenient=False)
    given = dict(parse_qsl(options.state, keep_blank_values=True))
    query = urlencode({**given, "theme": "dark"} if options.dark else given)
    try:
        picture = screenshot(query, options.size, dark=options.dark)
    except (BrowserError, ServerError) as error:
        raise CommandError(str(error)) from error
    write_file(options.out, picture)


COMMAND = Command(
    "Take a screenshot of the page with a headless Chromium and save it as PNG.",
    (
        *STATE,
        option(
            "--size",
            f"width and height in pixels, each from {_SIDE[0]} to {_SIDE[-1]} (default 1600x950)",
            type=_size,
            default=(1600, 950),
            metavar="WxH",
        ),
        flag("--dark", "use the dark theme"),
        option("out", "the PNG file to write", type=Path, metavar="FILE"),
    ),
    _run,
    "--state 'h=1.2&f=0.3' --size 1600x950 out.png",
)
