"""Results of commands as strict JSON, CSV or text, on standard output or in a file."""

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
    "columns",
    "computing",
    "quality",
    "show",
    "table",
    "text",
    "whether_body",
    "write",
    "write_file",
]

LONG = 2.0
"""Seconds after which a command says that it goes on."""
PATIENCE = "Still computing; Ctrl-C ends it."


Compute = Callable[[argparse.Namespace], "Answer"]


@dataclass(frozen=True)
class Answer:
    """What a command computed.

    series : columns of equal length, one row for each sample, None where there is no value (null, in CSV an empty
    field), and no number that is none.
    facts : everything else; notes : sentences.
    columns : the heading of the table in CSV, if not the names of the series.
    """

    series: Mapping[str, Sequence[Any]]
    facts: Mapping[str, Any]
    notes: Sequence[str] = ()
    columns: Sequence[str] = ()


def table(compute: Compute) -> Callable[[argparse.Namespace], None]:
    """Return the function that computes an answer and writes it in the chosen format, to the chosen place."""

    def run(options: argparse.Namespace) -> None:
        with computing():
            answer = compute(options)
        write(options, answer)

    return run


def text(compute: Callable[[argparse.Namespace], str]) -> Callable[[argparse.Namespace], None]:
    """Return the function that computes a text and writes it to the chosen place."""

    def run(options: argparse.Namespace) -> None:
        with computing():
            found = compute(options)
        show(f"{found}\n".encode(), options.out)

    return run


@contextmanager
def computing(told: bool = False) -> Iterator[None]:
    """Turn an error of the mechanics into a `CommandError`, and say on standard error when it takes long.

    told : how far it is is said already.
    """
    import numpy as np

    from hess_mechanics import ModelError

    try:
        # The mechanics check their results for overflow themselves: NumPy's warnings would only be noise.
        with np.errstate(all="ignore"), nullcontext() if told else _patience():
            yield
    except ModelError as error:
        raise CommandError(str(error)) from error
    except ArithmeticError as error:
        # Plain Python arithmetic overflows with an exception where NumPy's gives ∞.
        raise CommandError("These numbers leave the range of double precision; choose less extreme ones.") from error


@contextmanager
def _patience() -> Iterator[None]:
    """Say after a while that it goes on and how it is ended; in a terminal with the seconds, and not for good."""
    done, seen, begun = threading.Event(), sys.stderr.isatty(), time.monotonic()

    def tell() -> None:
        if done.wait(LONG):
            return
        if not seen:
            print(PATIENCE, file=sys.stderr, flush=True)
            return
        while True:
            print(f"\r{PATIENCE} {time.monotonic() - begun:.0f} s", end="", file=sys.stderr, flush=True)
            if done.wait(1.0):
                break
        # Back to the first column, and clear the line.
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)

    teller = threading.Thread(target=tell, name="patience", daemon=True)
    teller.start()
    try:
        yield
    finally:
        done.set()
        teller.join()


def quality(result: CircleMap | Cloud | Orbit | Period | Scattering | SectionCrossings | Spectrum) -> dict[str, Any]:
    """How exact a result is and what it cost, as every command reports it."""
    drift = getattr(result, "drift", None)
    return {
        "error_estimate": result.error_estimate,
        **({} if drift is None else {"drift": dict(drift)}),
        "status": str(result.status),
        "level": result.level,
        "steps": result.cost.steps,
        "wall_ms": result.cost.wall_ms,
    }


def columns(result: Result) -> dict[str, list[Any]]:
    """Return the numbers of a result by their names: coordinates, then variables."""
    known = result.labels()
    return {name: values.tolist() for name, (_, values) in {**known.coords, **known.variables}.items()}


def whether_body(check: BodyCheck) -> dict[str, Any]:
    """Whether a rigid body can have these moments of inertia."""
    return {"is_body": check.is_body, "body": check.sentence}


def _strict(value: Any) -> Any:
    """The value (numbers, strings, lists, dicts) with None for every number that JSON cannot represent."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _strict(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_strict(part) for part in value]
    return value


def _is_number(value: Any) -> bool:
    """Whether it is finite, or no float; of a list all that is in it."""
    if isinstance(value, list):
        return all(map(_is_number, value))
    return not isinstance(value, float) or math.isfinite(value)


def write(options: argparse.Namespace, answer: Answer) -> None:
    """Write the answer in the chosen format, to the chosen place.

    Raises
    ------
    CommandError : a number of a series leaves the range of double precision, or the file cannot be written.
    """
    series, facts = answer.series, answer.facts
    for name, column in series.items():
        if not all(map(_is_number, column)):
            raise CommandError(
                f"{name}: a number leaves the range of double precision; choose less extreme parameters "
                "or another time span."
            )
    strict = {key: _strict(value) for key, value in facts.items()}
    lost = [
        f"{key}: null stands for a number beyond the range of double precision."
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
    # Words have no commas.
    return ",".join("" if one is None else one if isinstance(one, str) else repr(one) for one in flat)


def show(data: bytes, out: Path | None = None) -> None:
    """Write to that file, or else to standard output, in UTF-8 whatever its encoding: names like ω1 need it."""
    if out is not None:
        write_file(out, data)
        return
    try:
        sys.stdout.buffer.write(data)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader (`| head`) has closed the pipe; Python must not try to flush the rest at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def write_file(path: Path, data: bytes) -> None:
    """Write the whole file.  Raises `CommandError`."""
    try:
        path.write_bytes(data)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise CommandError(f"{str(path)!r} cannot be written ({reason}); choose another file.") from error
