"""Arguments of commands: numbers, lists of numbers, ranges, states, Python files."""

from __future__ import annotations

import argparse
import math
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn, TypeVar
from urllib.parse import parse_qsl, urlencode

from . import CommandError

__all__ = ["assigned", "defined", "ends", "integer", "listed", "number", "run_file", "shown", "state_of"]

T = TypeVar("T")
_SHOWN, _MAX_STATE = 60, 2000


def run_file(path: str | Path) -> dict[str, Any]:
    """Return the names that a Python file of the user defines.  Raises `CommandError` if it stops."""
    try:
        return runpy.run_path(str(path))
    except OSError as error:
        raise CommandError(f"{shown(str(path))} cannot be read ({error.strerror}): choose another file.") from error
    # Whatever the user's code raises.
    except Exception as error:
        raise CommandError(f"{shown(str(path))} stops with {type(error).__name__}: {error}.") from error


def defined(text: str, kind: str, fits: Callable[[Any], bool]) -> Any:
    """Return the object FILE.py:NAME of a Python file of the user.

    kind : its kind in words; fits(object) : whether it is one.  Raises `CommandError`.
    """
    path, _, name = text.rpartition(":")
    found = run_file(path).get(name)
    if not fits(found):
        raise CommandError(f"{shown(path)} defines no {kind} {shown(name)}: write it like mine.py:{name}.")
    return found


def shown(text: str) -> str:
    """Return the text quoted for a message, shortened and with control characters escaped."""
    return repr(text if len(text) <= _SHOWN else text[:_SHOWN] + "…")


def _refuse(text: str, why: str) -> NoReturn:
    raise argparse.ArgumentTypeError(f"{shown(text)} {why}")


def number(text: str) -> float:
    """Return the text as a finite number."""
    try:
        value = float(text)
    except ValueError:
        _refuse(text, "is not a number; write it like 1.5 or -2e-3")
    if not math.isfinite(value):
        _refuse(text, "is not a finite number; write one like 1.5 or -2e-3")
    return value


def integer(low: int, high: int) -> Callable[[str], int]:
    """Return the argument type of an integer from `low` to `high`, which have at most ten digits."""

    def parse(text: str) -> int:
        if not (text.isascii() and text.isdigit() and len(text) <= 10 and low <= int(text) <= high):
            _refuse(text, f"is not a whole number from {low} to {high}")
        return int(text)

    return parse


def assigned(value: Callable[[str], T], example: str) -> Callable[[str], tuple[str, T]]:
    """Return the argument type of NAME=VALUE; value : type of the value; example : for the error message."""

    def parse(text: str) -> tuple[str, T]:
        name, _, given = text.partition("=")
        if not (name and given):
            _refuse(text, f"is not a parameter; write it like {example}")
        return name, value(given)

    return parse


def state_of(text: str) -> str:
    """Return the encoded query of a link, which may lack the part up to "?"."""
    from hess_explorer.protocol.specs import query_in

    if len(text) > _MAX_STATE:
        raise argparse.ArgumentTypeError(f"the state has {len(text)} characters; at most {_MAX_STATE} are allowed")
    query = query_in(text)
    try:
        return urlencode(parse_qsl(query, keep_blank_values=True, strict_parsing=bool(query)))
    except ValueError:
        _refuse(text, "is not a state; write it like 'h=1.2&f=0.3'")


def ends(text: str) -> tuple[float, float, int]:
    """Return the numbers of lo:hi:n."""
    parts = text.split(":")
    if len(parts) != 3:
        _refuse(text, "is not a range; write it lo:hi:n, like 0:10:101")
    return number(parts[0]), number(parts[1]), integer(2, 9_999_999_999)(parts[2])


def listed(text: str) -> list[float]:
    """Return the numbers of a comma-separated list."""
    return [number(part) for part in text.split(",")]
