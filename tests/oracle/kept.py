"""Stored results of slow computations, looked up by their call in "oracle_values.json"."""

import hashlib
import json
import time
from decimal import Decimal
from functools import wraps
from pathlib import Path

import numpy as np

from hess_mechanics import systems
from hess_mechanics.dynamics.system import System

KEPT_IN = Path(__file__).with_name("oracle_values.json")
KEPT = json.loads(KEPT_IN.read_text()) if KEPT_IN.exists() else {}
"""Question → [seconds that it took, answer]; see `asked`."""
ANSWERED = {}
"""The same of what had to be computed."""
FUNCTIONS = {}


def plain(value):
    """Convert a value to JSON types, with all its digits."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if hasattr(value, "digits"):
        return value.digits
    if isinstance(value, System):
        return value.name
    return str(value) if isinstance(value, Decimal | np.longdouble) else value


def asked(function, arguments):
    """Return the key of a call; very long arguments are replaced by their hash."""
    question = json.dumps([function.__name__, *map(plain, arguments)])
    if len(question) < 4000:
        return question
    return json.dumps([function.__name__, {"sha256": hashlib.sha256(question.encode()).hexdigest()}])


def kept(read):
    """A function whose answers are looked up where they are kept; `read` makes an answer of what JSON has."""

    def of(function):
        @wraps(function)
        def answer(*arguments, **named):
            question = asked(function, [*arguments, *named.values()])
            if question in KEPT:
                return read(KEPT[question][1])
            start = time.process_time()
            found = function(*arguments, **named)
            ANSWERED[question] = [round(time.process_time() - start, 1), found]
            return found

        FUNCTIONS[function.__name__] = function
        return answer

    return of


def found_anew(question):
    """Compute the result of a call again, as JSON types."""
    name, *arguments = json.loads(question)
    if name in ("orbit_in_decimals", "orbits_in_long_double"):
        arguments[0] = systems()[arguments[0]]
    return plain(FUNCTIONS[name](*arguments))
