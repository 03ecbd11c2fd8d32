"""`hess-explorer site`: build a folder of pages that needs no server."""

from __future__ import annotations

import sys
from pathlib import Path

from .command import Command, Options, integer_option, option
from .output import long_computation, show


def _run(options: Options) -> None:
    from hess_explorer.offline.html import HOME
    from hess_explorer.offline.site import build

    def report(name: str, done: int, of: int) -> None:
        print(f"{done}/{of} {name}", file=sys.stderr, flush=True)

    with long_computation(own_progress=True):
        sizes = build(
            options.folder,
            options.names,
            count=options.values,
            home=options.page or HOME,
            report=report,
        )
    lines = [f"{size:>12,} bytes  {path}" for path, size in sorted(sizes.items())]
    total = f"{sum(sizes.values()):>12,} bytes: open {options.folder / 'index.html'}"
    show("\n".join([*lines, total, ""]).encode())


COMMAND = Command(
    "Build a folder of pages that works without a server, from a disk, on any host and inside other pages: all "
    "lessons, each scene with its two main sliders, which move through computed states, and a page of links.",
    (
        option("folder", "the folder; files of an earlier site are replaced", type=Path, metavar="OUT"),
        option(
            "--pages", "only these lessons and scenes, by name", nargs="+", default=[], dest="names", metavar="NAME"
        ),
        integer_option("--values", 2, 400, "number of values of a slider", default=40),
        option("--page", "address of the explorer, for the links in the pages", default="", metavar="URL"),
    ),
    _run,
    "course-pages --pages limit-cycles-and-locking suslov-hess --values 20",
)
