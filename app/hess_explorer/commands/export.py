"""`hess-explorer export`: a picture as a table, figure, film or program, or a state or lesson as an HTML page."""

from __future__ import annotations

import sys
from pathlib import Path

from hess_explorer.export.formats import FILM_WIDTHS, FORMATS, SECONDS, WIDTHS, FileRequest, Loop, formats_of

from . import CommandError
from .command import Command, Options, flag, integer_option, option, picture
from .output import long_computation, show


def _print(done: int, of: int) -> None:
    print(f"{done}/{of}", file=sys.stderr, flush=True)


def _page(options: Options) -> bytes:
    from hess_explorer.offline.html import HOME
    from hess_explorer.offline.pages import state_page

    pictures = options.picture.split(",") if options.picture else ()
    return state_page(
        options.state,
        pictures,
        options.vary,
        grid=options.grid,
        home=options.page or HOME,
        lenient=options.lenient,
        report=_print if options.progress else None,
    )[1]


def _lesson(options: Options) -> bytes:
    from hess_explorer.lessons import package_lessons
    from hess_explorer.lessons.reading import read_file
    from hess_explorer.offline.html import HOME
    from hess_explorer.offline.pages import lesson_page

    path = Path(options.lesson)
    lesson = read_file(path) if path.suffix == ".md" else package_lessons().get(options.lesson)
    if lesson is None:
        raise CommandError(
            f"There is no lesson {options.lesson!r}: name a Markdown file or one of {', '.join(package_lessons())}."
        )
    report = _print if options.progress else None
    return lesson_page(lesson, options.values, home=options.page or HOME, report=report)


def _program(options: Options) -> bytes:
    from hess_explorer.export.notebook import PROGRAMS
    from hess_explorer.export.picture_data import address

    return PROGRAMS[options.format](address(options.state, options.picture, lenient=options.lenient)).encode()


def _picture(options: Options) -> bytes:
    from hess_explorer.export.picture_data import picture_data
    from hess_explorer.headless.file import content

    found = picture_data(options.state, options.picture, lenient=options.lenient)
    loop = Loop(options.loop == "dark", options.page) if options.loop else None
    request = FileRequest(options.format, options.width, options.black, options.seconds, loop)
    return content(found, request, *([_print] if options.progress else []))


def _run(options: Options) -> None:
    is_page = options.format in formats_of("state")
    if (options.vary or options.lesson) and not is_page:
        raise CommandError("Sliders and lessons need a page: add --format html.")
    with long_computation(own_progress=options.progress):
        if is_page:
            data = (_lesson if options.lesson else _page)(options)
        else:
            data = (_program if options.format in formats_of("program") else _picture)(options)
    show(data, options.out)


COMMAND = Command(
    "Export a picture of the state that a link describes: its data in full precision as CSV or JSON; a figure as PNG, "
    "SVG or PDF, at the time of the link; a film of the motion as WebM or MP4; or the Python code that computes and "
    "draws it, as PY or as a notebook, IPYNB, with the columns of the CSV file and the same values to the last bit. A "
    "headless browser draws films, and spheres, bodies, tori and clouds. HTML is an interactive page in one file that "
    "needs no server: pictures of the state, whose sliders move if they are named by --vary, or a lesson. Every file "
    "contains link, parameters, accuracy, errors and version. Figures and films require: pip install "
    "'hess-explorer[export]'; playwright install chromium.",
    (
        *picture("; for HTML a list with commas, by default those open at first"),
        option(
            "--format",
            "file format (default: csv)",
            choices=[*FORMATS],
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
        option(
            "--vary",
            "HTML: a slider that moves in the file, as NAME=LOW:HIGH:COUNT (default 40 values); may be repeated",
            action="append",
            default=[],
            metavar="SLIDER",
        ),
        flag("--grid", "HTML: all combinations of the sliders; by default each has its own line through the state"),
        option("--lesson", "HTML: a lesson, by its name or its Markdown file", default="", metavar="LESSON"),
        integer_option("--values", 2, 400, "HTML: number of values of each slider of a lesson", default=40),
        option("--page", "address of the explorer, for the links in a loop or a page", default="", metavar="URL"),
        flag("--black", "draw in black on white instead of the colours of the page"),
        flag("--progress", "print the progress of a film or page to stderr, one line per frame or state"),
    ),
    _run,
    "--state 'h=1.2&f=0.3' --picture circle --format csv --out circle.csv",
)
