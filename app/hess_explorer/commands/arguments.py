"""Types of arguments: numbers, lists of numbers, ranges of times, states."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from typing import NoReturn
from urllib.parse import parse_qsl, urlencode

__all__ = ["integer", "number", "samples", "shown", "state_of", "vector"]

_SHOWN, _MAX_STATE = 60, 2000


def shown(text: str) -> str:
    """The text quoted for a message: shortened, with control characters escaped."""
    return repr(text if len(text) <= _SHOWN else text[:_SHOWN] + "…")


def _refuse(text: str, why: str) -> NoReturn:
    raise argparse.ArgumentTypeError(f"{shown(text)} {why}")


def number(text: str) -> float:
    """One finite number."""
    try:
        value = float(text)
    except ValueError:
        _refuse(text, "is not a number; write it like 1.5 or -2e-3")
    if not math.isfinite(value):
        _refuse(text, "is not a finite number; write one like 1.5 or -2e-3")
    return value


def integer(low: int, high: int) -> Callable[[str], int]:
    """The type of a whole number from `low` to `high`."""

    def parse(text: str) -> int:
        # No bound here has more than ten digits.
        if not (text.isascii() and text.isdigit() and len(text) <= 10 and low <= int(text) <= high):
            _refuse(text, f"is not a whole number from {low} to {high}")
        return int(text)

    return parse


def vector(names: str) -> Callable[[str], tuple[float, ...]]:
    """The type of a comma list with one number for each of the names ("w1,w2")."""
    count = names.count(",") + 1

    def parse(text: str) -> tuple[float, ...]:
        parts = text.split(",")
        if len(parts) != count:
            _refuse(text, f"has length {len(parts)}; write {count} numbers {names}")
        return tuple(number(part) for part in parts)

    return parse


def state_of(text: str) -> str:
    """Return the query of a link, or of what follows ? in one, encoded.  Raises `argparse.ArgumentTypeError`."""
    from hess_explorer.protocol.parameters import query_in

    if len(text) > _MAX_STATE:
        raise argparse.ArgumentTypeError(f"the state has {len(text)} characters; at most {_MAX_STATE} are allowed")
    query = query_in(text)
    try:
        return urlencode(parse_qsl(query, keep_blank_values=True, strict_parsing=bool(query)))
    except ValueError:
        _refuse(text, "is not a state; write it like 'h=1.2&f=0.3'")


def samples(text: str) -> list[float]:
    """A comma list, or `lo:hi:n` for n evenly spaced numbers from lo to hi."""
    from hess_mechanics.dynamics.orbit import MAX_SAMPLES

    if ":" not in text:
        parts = text.split(",")
        if len(parts) > MAX_SAMPLES:
            _refuse(text, f"has {len(parts)} numbers; at most {MAX_SAMPLES} are allowed")
        return [number(part) for part in parts]
    ends = text.split(":")
    if len(ends) != 3:
        _refuse(text, "is not a range; write it lo:hi:n, like 0:10:101")
    low, high = number(ends[0]), number(ends[1])
    count = integer(2, MAX_SAMPLES)(ends[2])
    # Weighted, not stepped: both ends are exact, and hi − lo cannot overflow.
    return [low * ((count - 1 - i) / (count - 1)) + high * (i / (count - 1)) for i in range(count)]
