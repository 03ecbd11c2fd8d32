"""`hess-explorer shot`: take a screenshot of the page in a given state."""

from __future__ import annotations

from pathlib import Path

from .arguments import integer
from .command import STATE, Command, Options, option
from .output import write_file


def _run(options: Options) -> None:
    from hess_explorer.headless.screenshot import screenshot

    if not options.lenient:
        # An invalid state is an error here, whereas the page corrects it.
        from hess_explorer.export.picture_data import address
        from hess_explorer.page.opening import opening

        address(options.state)
        opening(options.state, lenient=False)
    write_file(options.out, screenshot(options.state, tuple(options.size)))


COMMAND = Command(
    "Take a screenshot of the page with a headless Chromium and save it as PNG.  The state may contain theme=dark.",
    (
        *STATE,
        option(
            "--size",
            "width and height in pixels, each from 200 to 8000 (default 1600 950)",
            nargs=2,
            type=integer(200, 8000),
            default=(1600, 950),
            metavar=("W", "H"),
        ),
        option("out", "the PNG file to write", type=Path, metavar="FILE"),
    ),
    _run,
    "--state 'h=1.2&f=0.3' --size 1600 950 out.png",
)
