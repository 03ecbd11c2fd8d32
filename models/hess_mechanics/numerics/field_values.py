"""Values of a recorded field at a point with estimates of their round-off, or the operation that is undefined there."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import add, mul, sub, truediv
from typing import Any

import numpy as np

from hess_mechanics.numerics.expressions import FUNCTIONS, Node
from hess_mechanics.numerics.recursions import topological_order
from hess_mechanics.numerics.results import Array

__all__ = ["Undefined", "values_at", "values_with_rounding"]

_UNIT, _LARGEST = 2.0**-52, 1e200
"""Relative size of a rounding; size from which the terms of a series overflow."""
_LONGEST_TEXT, _DEEPEST_TEXT = 60, 8
_NUMPY = {"acos": "arccos", "asin": "arcsin", "atan": "arctan", "atan2": "arctan2", "pow": "power"}
_ARITHMETIC: dict[str, Callable[[Any, Any], Any]] = {"+": add, "-": sub, "*": mul, "/": truediv}


class Undefined(ArithmeticError):
    """An operation of a field without a result below 1e200; the message names it."""


def values_with_rounding(
    nodes: Sequence[Node], names: tuple[Sequence[str], Sequence[str]], y: Sequence[float], p: Sequence[float]
) -> list[tuple[float, float]]:
    """Return the values of expressions, each with an estimate of its round-off, by running error analysis.

    The estimate is a bound to first order for arithmetic.  Functions are evaluated at both ends of the error intervals
    of their arguments.

    Parameters
    ----------
    nodes : sequence of Node
        The expressions, for example the rates of a field.
    names : (sequence of str, sequence of str)
        Names of the variables and of the parameters, for messages.
    y, p : sequence of float
        Values of variables and parameters, taken as exact.

    Returns
    -------
    list of (float, float)
        Value and estimated round-off of each expression.

    Raises
    ------
    Undefined
        If an operation has no result, or one whose size is not below 1e200.
    """
    known: dict[Node, tuple[float, float]] = {}
    for node in topological_order(nodes):
        try:
            pair = _evaluated(node, [known[argument] for argument in node.arguments], y, p)
        except (ValueError, ArithmeticError):
            pair = math.nan, math.nan
        if not abs(pair[0]) < _LARGEST:
            raise Undefined(_reason(node, [known[argument][0] for argument in node.arguments], names))
        known[node] = pair
    return [known[node] for node in nodes]


def values_at(node: Node, y: Sequence[Array], p: Sequence[float]) -> Array:
    """Return the values of an expression.

    Parameters
    ----------
    node : Node
        The expression.
    y : sequence of ndarray, shape (n,)
        Values of each variable.
    p : sequence of float
        Values of the parameters.

    Returns
    -------
    ndarray, shape (n,)
        The values; NaN or ∞ where they are undefined.
    """
    known: dict[Node, Array | float] = {}
    with np.errstate(all="ignore"):
        for one in topological_order([node]):
            arguments: list[Any] = [known[argument] for argument in one.arguments]
            match one.operation:
                case "number":
                    known[one] = float(one.value)
                case "variable" | "parameter":
                    known[one] = (y if one.operation == "variable" else p)[one.value]
                case "start" | "carried":
                    known[one] = arguments[0]
                case "negative":
                    known[one] = -arguments[0]
                case _:
                    function = _ARITHMETIC.get(one.operation) or getattr(np, _NUMPY.get(one.operation, one.operation))
                    known[one] = function(*map(np.asarray, arguments))
    return np.broadcast_to(np.asarray(known[node], float), np.shape(y[0])).copy()


def _evaluated(
    node: Node, arguments: list[tuple[float, float]], y: Sequence[float], p: Sequence[float]
) -> tuple[float, float]:
    if node.operation == "number":
        return float(node.value), 0.0
    if node.operation in ("variable", "parameter"):
        return float((y if node.operation == "variable" else p)[node.value]), 0.0
    values, errors = zip(*arguments, strict=True)
    if node.operation in ("start", "carried"):
        return arguments[0]
    if node.operation == "negative":
        return -values[0], errors[0]
    if node.operation in FUNCTIONS:
        function = FUNCTIONS[node.operation]
        value = function(*values)
        signs = (-1.0, 1.0) if any(errors) else ()
        moved = (abs(function(*(x + sign * dx for x, dx in arguments)) - value) for sign in signs)
        return value, max(moved, default=0.0) + _UNIT * abs(value)
    (a, b), (da, db) = values, errors
    value = _ARITHMETIC[node.operation](a, b)
    error = {
        "+": da + db,
        "-": da + db,
        "*": abs(a) * db + abs(b) * da,
        "/": (da + abs(value) * db) / abs(b) if node.operation == "/" else 0.0,
    }[node.operation]
    return value, error + _UNIT * abs(value)


def _reason(node: Node, arguments: list[float], names: tuple[Sequence[str], Sequence[str]]) -> str:
    """Return the reason why the operation is undefined, as the end of a sentence."""
    texts = [_text(argument, names) for argument in node.arguments]
    if node.operation == "/" and arguments[1] == 0.0:
        return f"divides by {texts[1]}, which is 0"
    if node.operation in FUNCTIONS and node.operation not in ("exp", "sinh", "cosh"):
        values = ", ".join(f"{value:.6g}" for value in arguments)
        return f"takes {node.operation} of {', '.join(texts)}, which is {values}"
    return f"exceeds the range of double precision in {_text(node, names)}"


def _text(node: Node, names: tuple[Sequence[str], Sequence[str]]) -> str:
    """Return an expression as its author could have written it, shortened."""
    text = _written(node, names, _DEEPEST_TEXT)
    text = _bare(text)
    return text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}…"


def _bare(text: str) -> str:
    """Return an expression without its outermost parentheses."""
    return text[1:-1] if text[0] == "(" else text


def _written(node: Node, names: tuple[Sequence[str], Sequence[str]], depth: int) -> str:
    if node.operation == "number":
        return f"{node.value:g}"
    if node.operation in ("variable", "parameter"):
        return str(names[node.operation == "parameter"][node.value])
    if not depth:
        return "…"
    texts = [_written(argument, names, depth - 1) for argument in node.arguments]
    if node.operation in ("start", "carried"):
        return texts[0]
    if node.operation == "negative":
        return f"(-{texts[0]})"
    if node.operation in FUNCTIONS:
        return f"{node.operation}({', '.join(map(_bare, texts))})"
    return f"({f' {node.operation} '.join(texts)})"
