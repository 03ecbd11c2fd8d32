"""Write results of commands as strict JSON, CSV or text, to standard output or a file."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hess_explorer.commands import CommandError

if TYPE_CHECKING:
    from hess_mechanics import BodyCheck, CircleMap, Orbit, SectionCrossings, Spectrum
    from hess_mechanics.chaplygin_ball.integrable_cases import Period
    from hess_mechanics.chaplygin_ball.phase_cloud import Cloud
    from hess_mechanics.numerics.labelled import Result
    from hess_mechanics.suslov.scattering import Scattering

__all__ = [
    "LONG",
    "PATIENCE",
    "Answer",
    "body_facts",
    "columns",
    "computing",
    "quality",
    "show",
    "table",
    "text",
    "write",
    "write_file",
]

LONG = 2.0
"""Seconds after which a command reports that it is still running."""
PATIENCE = "Still computing; Ctrl-C ends it."


Compute = Callable[[argparse.Namespace], "Answer"]


@dataclass(frozen=True)
class Answer:
    """The result of a command.

    Attributes
    ----------
    series : columns of equal length with finite numbers; None marks a missing value (null in JSON, empty in CSV).
    facts : all other results.
    notes : remarks in full sentences.
    columns : header of the CSV table, if it differs from the names of the series.
    """

    series: Mapping[str, Sequence[Any]]
    facts: Mapping[str, Any]
    notes: Sequence[str] = ()
    columns: Sequence[str] = ()


def table(compute: Compute) -> Callable[[argparse.Namespace], None]:
    """Return a function that computes an answer and writes it to the chosen output in the chosen format."""

    def run(options: argparse.Namespace) -> None:
        with computing():
            answer = compute(options)
        write(options, answer)

    return run


def text(compute: Callable[[argparse.Namespace], str]) -> Callable[[argparse.Namespace], None]:
    """Return a function that computes a text and writes it to the chosen output."""

    def run(options: argparse.Namespace) -> None:
        with computing():
            found = compute(options)
        show(f"{found}\n".encode(), options.out)

    return run


@contextmanager
def computing(own_progress: bool = False) -> Iterator[None]:
    """Convert errors of the mechanics to `CommandError`, and report on stderr a computation that takes long.

    own_progress : True if the command prints its own progress.
    """
    import numpy as np

    from hess_mechanics import ModelError

    try:
        # `hess_mechanics` checks its results for overflow itself, so NumPy's warnings would be noise.
        with np.errstate(all="ignore"), nullcontext() if own_progress else _patience():
            yield
    except ModelError as error:
        raise CommandError(str(error)) from error
    except ArithmeticError as error:
        # Python floats raise an exception on overflow, whereas NumPy returns ∞.
        raise CommandError("These numbers exceed the range of double precision: choose less extreme ones.") from error


@contextmanager
def _patience() -> Iterator[None]:
    """Report after `LONG` seconds that the command is still running; in a terminal also count the seconds."""
    done, seen, begun = threading.Event(), sys.stderr.isatty(), time.monotonic()

    def report() -> None:
        if done.wait(LONG):
            return
        if not seen:
            print(PATIENCE, file=sys.stderr, flush=True)
            return
        while True:
            print(f"\r{PATIENCE} {time.monotonic() - begun:.0f} s", end="", file=sys.stderr, flush=True)
            if done.wait(1.0):
                break
        # Carriage return, then clear the line.
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)

    reporter = threading.Thread(target=report, name="patience", daemon=True)
    reporter.start()
    try:
        yield
    finally:
        done.set()
        reporter.join()


def quality(result: CircleMap | Cloud | Orbit | Period | Scattering | SectionCrossings | Spectrum) -> dict[str, Any]:
    """Return the accuracy and cost of a result, which every command reports."""
    drift = getattr(result, "drift", None)
    return {
        "error_estimate": result.error_estimate,
        **({"time_error": result.time_error} if hasattr(result, "time_error") else {}),
        **({} if drift is None else {"drift": dict(drift)}),
        "status": str(result.status),
        "level": result.level,
        "steps": result.cost.steps,
        "wall_ms": result.cost.wall_ms,
    }


def columns(result: Result) -> dict[str, list[Any]]:
    """Return the columns of a result by name: coordinates, then variables."""
    known = result.labels()
    return {name: values.tolist() for name, (_, values) in {**known.coords, **known.variables}.items()}


def body_facts(check: BodyCheck) -> dict[str, Any]:
    """Return the facts of a check that a rigid body can have these moments of inertia."""
    return {"is_body": check.is_body, "body": check.sentence}


def _strict(value: Any) -> Any:
    """Return the value (numbers, strings, lists, dicts) with None in place of non-finite numbers."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _strict(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_strict(part) for part in value]
    return value


def _is_number(value: Any) -> bool:
    """Return True if the value, or each item of a list, is not a float or is finite."""
    if isinstance(value, list):
        return all(map(_is_number, value))
    return not isinstance(value, float) or math.isfinite(value)


def write(options: argparse.Namespace, answer: Answer) -> None:
    """Write the answer to the chosen output in the chosen format.

    Raises
    ------
    CommandError
        If a number of a series exceeds the range of double precision, or the file cannot be written.
    """
    series, facts = answer.series, answer.facts
    for name, column in series.items():
        if not all(map(_is_number, column)):
            raise CommandError(
                f"{name}: a number exceeds the range of double precision; choose less extreme parameters "
                "or another time span."
            )
    strict = {key: _strict(value) for key, value in facts.items()}
    lost = [
        f"{key}: null stands for a number that exceeds the range of double precision."
        for key, value in facts.items()
        if strict[key] != value
    ]
    strict["notes"] = [*answer.notes, *lost]
    if options.format == "json":
        pairs = {**series, **strict}.items()
        lines = [f"  {json.dumps(key)}: {_json(value)}" for key, value in pairs]
        written = "{\n" + ",\n".join(lines) + "\n}\n"
    else:
        rows = (_row(cells) for cells in zip(*series.values(), strict=True))
        comments = (f"# {key}: {_json(value)}" for key, value in strict.items())
        written = "\n".join([*comments, ",".join(answer.columns or tuple(series)), *rows]) + "\n"
    show(written.encode(), options.out)


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _row(cells: Sequence[Any]) -> str:
    flat = [one for cell in cells for one in (cell if isinstance(cell, list) else [cell])]
    # Strings contain no commas, so they need no quotes.
    return ",".join("" if one is None else one if isinstance(one, str) else repr(one) for one in flat)


def show(data: bytes, out: Path | None = None) -> None:
    """Write data to a file, or to standard output as bytes, because names such as ω1 need UTF-8."""
    if out is not None:
        write_file(out, data)
        return
    try:
        sys.stdout.buffer.write(data)
        sys.stdout.flush()
    except OSError as error:
        # Prevent Python from flushing the rest at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        # The reader (such as `head`) may close the pipe early.
        if not isinstance(error, BrokenPipeError):
            raise CommandError(f"Cannot write to standard output ({error.strerror}): use --out FILE.") from error


def write_file(path: Path, data: bytes) -> None:
    """Write a file, of which an earlier version stays until the new one is complete.  Raises `CommandError`."""
    from hess_mechanics.numerics.files import write_whole

    try:
        write_whole(path, data)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise CommandError(f"Cannot write {str(path)!r} ({reason}): choose another file.") from error
