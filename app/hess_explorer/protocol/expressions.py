"""Evaluate numbers that a user types as expressions: pi/3, sqrt(2), 1/7.

The text is untrusted.  Only numbers, + − * / **, parentheses, pi, e and elementary functions are accepted, up to a
maximum length; simpleeval evaluates the expression without running code.
"""

from __future__ import annotations

import ast
import math
import operator
import re
import warnings
from collections.abc import Callable, Mapping
from typing import Any

from simpleeval import InvalidExpression, SimpleEval

MAX_LENGTH = 100
"""Maximum length of an expression in characters, after `to_python`."""

FUNCTIONS: Mapping[str, Callable[..., float]] = {
    name: getattr(math, name)
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
} | {"abs": abs}

_NAMES = {"pi": math.pi, "π": math.pi, "e": math.e}
_KINDS = (ast.Expr, ast.Constant, ast.Name, ast.UnaryOp, ast.BinOp, ast.Call)
# `math.pow` returns floats; `**` could compute integers with millions of digits.
_OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
# Without quotes, commas and brackets, and with dots only in numbers, a text can only produce numbers.
_TEXT = re.compile(
    r"(?>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![\w.])|[A-Za-zπ]+[0-9]*(?![\w.])|[-+*/()]|\s)+"
)


class NotANumber(ValueError):
    """The text has no finite value; the message contains the reason and a remedy."""


class Unreadable(Exception):
    """The text is not an allowed expression."""


def to_python(text: str) -> str:
    """Return an expression in Python: without surrounding spaces, "−" as "-", "·" as "*", "^" as "**"."""
    return text.strip().replace("−", "-").replace("^", "**").replace("·", "*")


def calculate(
    text: str,
    operators: Mapping[type[ast.AST], Callable[..., Any]],
    names: Mapping[str, Any],
    functions: Mapping[str, Callable[..., Any]],
) -> Any:
    """Return the value of an expression of numbers, names, operators and functions, without running other code.

    Parameters
    ----------
    text : str
        The expression, see `to_python`.
    operators : mapping of type to callable
        Functions of the allowed operators, by the classes of `ast`.
    names, functions : mapping of str
        Allowed names and functions.

    Returns
    -------
    object
        The value, of any type.

    Raises
    ------
    Unreadable
        If the text is not such an expression.
    ArithmeticError, ValueError
        As raised by operators and functions.
    """
    evaluator = SimpleEval(operators=dict(operators), functions=dict(functions), names=dict(names))
    evaluator.nodes = {kind: evaluator.nodes[kind] for kind in _KINDS}
    try:
        # Python warns about suspicious syntax; such expressions are rejected.
        with warnings.catch_warnings(action="error"):
            return evaluator.eval(text)
    except (InvalidExpression, SyntaxError, TypeError, RecursionError, MemoryError, Warning) as error:
        raise Unreadable(str(error)) from None


def evaluate(text: str) -> float:
    """Return the value of an expression.

    Parameters
    ----------
    text : str
        The expression, for example "2*pi/3"; "^" means a power.

    Returns
    -------
    float
        The value, always finite.

    Raises
    ------
    NotANumber
        If the text is too long, cannot be parsed, or has no finite value.
    """
    text = to_python(text)
    if len(text) > MAX_LENGTH:
        raise NotANumber(f"The expression is longer than {MAX_LENGTH} characters: shorten it.")
    if not _TEXT.fullmatch(text):
        raise NotANumber("This is not a number: type one like 1.5, 1e-8, pi/3, sqrt(2) or 1/7.")
    try:
        value = calculate(text, _OPERATORS, _NAMES, FUNCTIONS)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise Unreadable
        value = float(value)
    except (ArithmeticError, ValueError):
        value = math.nan
    except Unreadable:
        raise NotANumber(
            f"This is not a valid expression: use numbers, + − * / **, parentheses, pi, e and {', '.join(FUNCTIONS)}."
        ) from None
    if not math.isfinite(value):
        raise NotANumber("The value is not finite: change the expression.")
    return value
