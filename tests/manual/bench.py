"""`python tests/manual/bench.py`: compare the speed with other integrators, or measure the levels of accuracy."""

import argparse
import json
import sys
from importlib.util import find_spec
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.commands import CommandError
from hess_explorer.commands.command import Command, flag, option
from hess_explorer.commands.output import show, write_file

WORKS = ("A", "A2", "B", "B2", "C", "D")
TARGETS = (1e-3, 1e-6, 1e-9, 1e-12)
_PICTURES = (".svg", ".png")


def _works(text):
    names = tuple(text.split(","))
    for name in names:
        if name not in WORKS:
            raise argparse.ArgumentTypeError(f"{name!r} is not a work; choose from {','.join(WORKS)}")
    return tuple(name for name in WORKS if name in names)


def _computations(text):
    from hess_mechanics.catalogue import catalogue, find
    from hess_mechanics.errors import ModelError

    chosen = text.split(",")
    try:
        # A name without a system stands for all systems.
        return tuple(
            key
            for one in chosen
            for key in ([every for every in catalogue() if every.split(" ")[0] == one] or [find(one).key])
        )
    except ModelError as error:
        raise argparse.ArgumentTypeError(str(error).removesuffix(".")) from error


def _targets(text):
    targets = {float(part) for part in text.split(",")}
    if min(targets) <= 0.0:
        raise argparse.ArgumentTypeError(f"{text!r} has an error that is not positive; write it like 1e-6,1e-9")
    return tuple(sorted(targets, reverse=True))


def _picture(text):
    path = Path(text)
    if path.suffix not in _PICTURES:
        raise argparse.ArgumentTypeError(f"{text!r} is not a picture; end the name in {' or '.join(_PICTURES)}")
    return path


def _progress(text):
    print(f"{text} …", file=sys.stderr, flush=True)


def _run_trade(options):
    from hess_mechanics.catalogue import catalogue
    from manual.integrators.trade import Row, as_json, by_kind, heading, line_of, trade_of_catalogue

    in_text = options.format == "text"
    if in_text:
        show(heading().encode())
    rows = []
    failed = []
    for row in trade_of_catalogue(options.computations or catalogue(), 1 if options.quick else 3, _progress):
        if isinstance(row, Row):
            rows.append(row)
        else:
            failed.append(row)
        # At once: minutes of measuring are not lost with what fails later.
        if in_text:
            show(line_of(row).encode())
    show((f"\n{by_kind(rows)}" if in_text else _json(as_json(rows))).encode())
    if failed:
        raise CommandError("; ".join(f"{one.name} could not be measured ({one.why})" for one in failed))


def _json(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def _run(options):
    if options.trade:
        _run_trade(options)
        return
    from manual.integrators.threads import one_each

    one_each()
    if options.picture is not None:
        # Better now than after minutes of measuring.
        _require_matplotlib()
    from manual.integrators.report import as_json, as_text
    from manual.integrators.run import run

    report = run(options.works, options.targets, options.quick, _progress)
    show(as_text(report).encode())
    if options.json is not None:
        write_file(options.json, _json(as_json(report)).encode())
    if options.picture is not None:
        from manual.integrators.picture import draw

        write_file(options.picture, draw(report, options.picture.suffix))


def _require_matplotlib():
    if find_spec("matplotlib") is None:
        raise CommandError("--picture needs Matplotlib: pip install 'hess-explorer[bench]'.")


COMMAND = Command(
    "Do the same works with this project and with the other integrators that are installed (pip install "
    "'hess-explorer[bench]'), measure each result's error against stored exact ones, and time the cheapest setting of "
    "each that keeps the error asked for.  Some minutes; the table goes to standard output.",
    (
        option("--works", "from A,A2,B,B2,C,D (default: all)", type=_works, default=WORKS, metavar="LIST"),
        option(
            "--targets", "largest errors (default 1e-3,1e-6,1e-9,1e-12)", type=_targets, default=TARGETS, metavar="LIST"
        ),
        flag("--quick", "few repeats: a trial, not a measurement"),
        option("--json", "write everything measured to this file", type=Path, metavar="FILE"),
        flag("--trade", "instead: cost and error of each accuracy level, for the computations of the catalogue"),
        option(
            "--computations",
            'with --trade: these, such as orbit,circle-map or "orbit suslov" (default: all)',
            type=_computations,
            metavar="LIST",
        ),
        option(
            "--format",
            "with --trade: a table (default), or computation, kind, level, ms, error as JSON",
            choices=("text", "json"),
            default="text",
        ),
        option("--picture", "draw time over error (.svg or .png)", type=_picture, metavar="FILE"),
    ),
    _run,
    "--works A,C --targets 1e-6,1e-9 --picture bench.svg",
)


def main(words=None):
    """Run the benchmark and return its exit status."""
    try:
        options = COMMAND.parsed("bench.py", words)
        options.run(options)
    except CommandError as error:
        print(f"bench.py: {error}", file=sys.stderr)
        return error.status
    return 0


if __name__ == "__main__":
    sys.exit(main())
