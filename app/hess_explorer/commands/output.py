"""Write results of commands as text, strict JSON, CSV or NetCDF, to standard output or a file."""

from __future__ import annotations

import argparse
import json
import os
import sys
import threading
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from hess_explorer.commands import CommandError

LONG = 2.0
"""Seconds after which a command reports that it is still running."""
PATIENCE = "Still computing; Ctrl-C ends it."
_ROWS = 20
"""Largest number of rows of a table that is printed as text."""
_NULLS = "null stands for a number that is missing or exceeds the range of double precision."


@contextmanager
def long_computation(own_progress: bool = False) -> Iterator[None]:
    """Print a message to stderr if the block takes longer than `LONG`, and convert an overflow to `CommandError`.

    Parameters
    ----------
    own_progress : bool
        True if the command prints its own progress, so that no message is needed.
    """
    import numpy as np

    timer = threading.Timer(LONG, print, (PATIENCE,), {"file": sys.stderr, "flush": True})
    timer.daemon = True
    if not own_progress:
        timer.start()
    try:
        # `hess_mechanics` checks its results for overflow itself, so NumPy's warnings would be noise.
        with np.errstate(all="ignore"):
            yield
    except ArithmeticError as error:
        # Python floats raise an exception on overflow, whereas NumPy returns ∞.
        raise CommandError("These numbers exceed the range of double precision: choose less extreme ones.") from error
    finally:
        timer.cancel()


def write(
    options: argparse.Namespace,
    table: Any,
    facts: Mapping[str, Any],
    data: Callable[[], Any],
    notes: Sequence[str] = (),
) -> None:
    """Write a result in the chosen format.

    Parameters
    ----------
    options : argparse.Namespace
        Options `format` and `out` of the command.
    table : pandas.DataFrame
        The columns.
    facts : mapping of str to object
        All other results, by name.
    data : callable
        Returns the columns as an xarray.Dataset.
    notes : sequence of str
        Remarks in full sentences.

    Raises
    ------
    CommandError
        If the output cannot be written.
    """
    lost: list[str] = []
    known = _strict(facts, lost)
    known["notes"] = [*notes, *([_NULLS] if lost else [])]
    if options.format == "json":
        known |= _strict({str(name): column.tolist() for name, column in table.items()}, [])
    lines = {name: json.dumps(value, ensure_ascii=False, allow_nan=False) for name, value in known.items()}
    if options.format == "netcdf":
        written = _netcdf(data(), lines)
    elif options.format == "text":
        written = _text(table, facts, notes).encode()
    elif options.format == "csv":
        comments = "".join(f"# {name}: {value}\n" for name, value in lines.items())
        written = (comments + str(table.to_csv(index=False, lineterminator="\n"))).encode()
    else:
        inner = ",\n".join(f'  "{name}": {value}' for name, value in lines.items())
        written = f"{{\n{inner}\n}}\n".encode()
    show(written, options.out)


def _plain(value: Any) -> Any:
    """Convert NumPy numbers, arrays and complex numbers to types of JSON."""
    return [value.real, value.imag] if isinstance(value, complex) else value.tolist()


def _strict(values: Mapping[str, Any], missing: list[str]) -> dict[str, Any]:
    """Return the values as types of JSON, with null for each NaN or ∞, which is appended to `missing` as text."""
    known: dict[str, Any] = json.loads(json.dumps(values, default=_plain), parse_constant=missing.append)
    return known


def _netcdf(data: Any, attributes: Mapping[str, str]) -> bytes:
    """Return a NetCDF 3 file, written by SciPy; its names are ASCII, `long_name` has the symbols."""
    for name, one in data.variables.items():
        one.attrs["long_name"] = name
    data.attrs = attributes
    names = {name: _ascii(str(name)) for name in {*data.variables, *data.dims}}
    return bytes(data.rename(names).to_netcdf(engine="scipy"))


def _ascii(name: str) -> str:
    """Spell out Greek letters in a name: omega1 for ω₁."""
    return "".join(
        char if char.isascii() else unicodedata.name(char).rpartition(" ")[2].lower()
        for char in unicodedata.normalize("NFKD", name).replace("−", "-").replace("/", "_")
    )


def _text(table: Any, facts: Mapping[str, Any], notes: Sequence[str]) -> str:
    lines = []
    for name, value in facts.items():
        lines += [f"{name}: {_words(value)}"] if value != {} else []
    if not table.empty:
        lines += ["", table.to_string(index=False, max_rows=_ROWS, na_rep="–", float_format="{:.9g}".format)]
    if len(table) > _ROWS:
        lines.append(f"{len(table)} rows; --format csv has all of them.")
    return "\n".join([*lines, *notes, ""])


def _words(value: Any) -> str:
    if isinstance(value, Mapping):
        return ", ".join(f"{name} = {_words(one)}" for name, one in value.items())
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def show(data: bytes, out: Path | None = None) -> None:
    """Write data to a file, or to standard output as bytes, because names such as ω1 need UTF-8.

    Raises `CommandError` if the data cannot be written, or are binary and standard output is a terminal.
    """
    if out is not None:
        write_file(out, data)
        return
    if sys.stdout.isatty() and b"\0" in data:
        raise CommandError("This is a binary format: name a file with --out FILE.")
    try:
        sys.stdout.buffer.write(data)
        sys.stdout.flush()
    except OSError as error:
        # Redirect stdout, because Python flushes the rest at exit and would fail again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        # The reader, such as `head`, may close the pipe early.
        if not isinstance(error, BrokenPipeError):
            raise CommandError(f"Cannot write to standard output ({error.strerror}): use --out FILE.") from error


def write_file(path: Path, data: bytes) -> None:
    """Write a file atomically: an earlier version stays until the new one is complete.  Raises `CommandError`."""
    from hess_mechanics.numerics.files import write_atomically

    try:
        write_atomically(path, data)
    except OSError as error:
        raise CommandError(f"Cannot write {str(path)!r} ({error.strerror}): choose another file.") from error
