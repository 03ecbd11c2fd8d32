"""Write results of commands as strict JSON, CSV or text, to standard output or a file."""

from __future__ import annotations

import argparse
import json
import os
import sys
import textwrap
import threading
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hess_explorer.commands import CommandError

if TYPE_CHECKING:
    from hess_mechanics.numerics.labelled import Result

__all__ = ["LONG", "PATIENCE", "computing", "require_file", "show", "write", "write_file"]

LONG = 2.0
"""Seconds after which a command reports that it is still running."""
PATIENCE = "Still computing; Ctrl-C ends it."
_ROWS = 20
"""Most rows of a table in text."""


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
    """Report after `LONG` seconds that the command is still running."""
    timer = threading.Timer(LONG, print, (PATIENCE,), {"file": sys.stderr, "flush": True})
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def require_file(options: argparse.Namespace, text: Sequence[str]) -> None:
    """Raise `CommandError` for a binary format without a file; text : the formats that are not binary."""
    if options.out is None and options.format not in text:
        raise CommandError(f"{options.format.upper()} is a binary format: name a file with --out FILE.")


def write(options: argparse.Namespace, result: Result, about: Mapping[str, Any], notes: Sequence[str] = ()) -> None:
    """Write a result in the chosen format; about : what was computed, notes : remarks in full sentences.

    Raises `ModelError` if a library is missing, and `CommandError` if the file cannot be written.
    """
    writers = {"text": _text, "json": _json, "csv": _csv, "netcdf": _netcdf}
    show(writers[options.format](result, about, list(notes)), options.out)


def _plain(value: Any) -> Any:
    """Return numbers and arrays of NumPy, and complex numbers, as JSON has them."""
    return [value.real, value.imag] if isinstance(value, complex) else value.tolist()


def _strict(named: Mapping[str, Any], notes: list[str]) -> Iterator[tuple[str, str]]:
    """Yield the values as strict JSON, with null for numbers that are not finite, then the notes, also on these."""
    for name, value in {**named, "notes": notes}.items():
        lost: list[str] = []
        known = json.loads(json.dumps(value, default=_plain), parse_constant=lost.append)
        if lost:
            notes.append(f"{name}: null stands for a number that is missing or exceeds the range of double precision.")
        yield name, json.dumps(known, ensure_ascii=False, allow_nan=False)


def _json(result: Result, about: Mapping[str, Any], notes: list[str]) -> bytes:
    """Return the result as `xarray.Dataset.from_dict` reads it, and what was computed."""
    known = result.labels()
    arrays = {
        part: {
            name: {"dims": dims, "attrs": {"units": known.units.get(name, "")}, "data": values}
            for name, (dims, values) in named.items()
        }
        for part, named in (("coords", known.coords), ("data_vars", known.variables))
    }
    strict = _strict({**about, "attrs": known.facts, **arrays}, notes)
    return ("{\n" + ",\n".join(f'  "{name}": {value}' for name, value in strict) + "\n}\n").encode()


def _csv(result: Result, about: Mapping[str, Any], notes: list[str]) -> bytes:
    known = result.labels()
    strict = _strict({**about, **known.facts, "units": known.units}, notes)
    comments = "".join(f"# {name}: {value}\n" for name, value in strict)
    table: str = result.to_pandas().to_csv(index=False, lineterminator="\n")
    return f"{comments}{table}".encode()


def _netcdf(result: Result, about: Mapping[str, Any], notes: list[str]) -> bytes:
    """Return a file of NetCDF 3, which SciPy writes; its names are ASCII, `long_name` has the symbols."""
    data = result.to_xarray()
    for name, one in data.variables.items():
        one.attrs["long_name"] = name
    data.attrs = {
        _ascii(name): value if isinstance(value, (str, float)) else json.dumps(value, default=_plain)
        for name, value in {**about, **data.attrs, "notes": notes}.items()
    }
    return bytes(data.rename({name: _ascii(name) for name in {*data.variables, *data.dims}}).to_netcdf(engine="scipy"))


def _ascii(name: str) -> str:
    """Return the name with Greek letters written out: omega1 for ω₁."""
    return "".join(
        char if char.isascii() else unicodedata.name(char).rpartition(" ")[2].lower()
        for char in unicodedata.normalize("NFKD", name).replace("−", "-").replace("/", "_")
    )


def _text(result: Result, about: Mapping[str, Any], notes: list[str]) -> bytes:
    lines, errors = [], about.get("errors", {})
    for name, value in {**about, **result.labels().facts}.items():
        if name != "errors":
            words = _words(value, errors if name == "numbers" else {})
            lines += textwrap.wrap(f"{name}: {words}", 100, subsequent_indent="  ")
    frame = result.to_pandas()
    if not frame.empty:
        lines += ["", frame.to_string(index=False, max_rows=_ROWS, float_format="{:.9g}".format)]
    if len(frame) > _ROWS:
        lines.append(f"{len(frame)} rows; --format csv has all of them.")
    return "\n".join([*lines, *notes, ""]).encode()


def _words(value: Any, errors: Mapping[str, float]) -> str:
    if isinstance(value, Mapping):
        off = {name: f" ± {error:.1g}" for name, error in errors.items()}
        return ", ".join(f"{name} = {_words(one, {})}{off.get(name, '')}" for name, one in value.items())
    return f"{value:.12g}" if isinstance(value, float) else str(value)


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
