"""Arguments of commands: whole numbers, NAME=VALUE, states, Python files."""

from __future__ import annotations

import argparse
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar
from urllib.parse import parse_qsl, urlencode

from . import CommandError

T = TypeVar("T")


def run_file(path: str | Path) -> dict[str, Any]:
    """Run a Python file of the user and return its names.  Raises `CommandError` if the file raises an exception."""
    try:
        return runpy.run_path(str(path))
    # The user's code may raise any exception.
    except Exception as error:
        raise CommandError(f"{str(path)!r} failed with {type(error).__name__}: {error}.") from error


def user_object(text: str, kind: str, fits: Callable[[Any], bool]) -> Any:
    """Return the object FILE.py:NAME of a Python file of the user.

    Parameters
    ----------
    text : str
        File and name.
    kind : str
        Kind of the object, for the error message.
    fits : callable
        `fits(object)` returns True if the object is of this kind.

    Returns
    -------
    object
        The object.

    Raises
    ------
    CommandError
        If the file raises an exception or defines no such object.
    """
    path, _, name = text.rpartition(":")
    found = run_file(path).get(name)
    if not fits(found):
        raise CommandError(
            f"{path!r} defines no {kind} {name!r}: define it there, or write FILE:NAME with another name."
        )
    return found


def integer(low: int, high: int) -> Callable[[str], int]:
    """Return the argument type of an integer from `low` to `high`, both included."""

    # argparse names the type in its message if `int` raises ValueError.
    def integer(text: str) -> int:
        if not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"{text} is not a whole number from {low} to {high}")
        return int(text)

    return integer


def assignment_of(value: Callable[[str], T]) -> Callable[[str], tuple[str, T]]:
    """Return the argument type of NAME=VALUE, where `value` converts the text of the value."""

    def assignment(text: str) -> tuple[str, T]:
        name, given = text.split("=", 1)
        return name, value(given)

    return assignment


def state(text: str) -> str:
    """Return the URL-encoded query of a link, which may lack the part up to "?"."""
    from hess_explorer.protocol.specs import query_in

    query = query_in(text)
    return urlencode(parse_qsl(query, keep_blank_values=True, strict_parsing=bool(query)))
