"""Numbers written as a user writes them: pi/3, sqrt(2), 1/7.

What is read comes from outside: numbers, + − * / **, parentheses, pi, e and elementary functions, of bounded length,
evaluated by a library that runs no code.
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

__all__ = ["FUNCTIONS", "MOST", "NotANumber", "evaluate"]

MOST = 100
"""So many characters are read."""

FUNCTIONS: Mapping[str, Callable[..., float]] = {
    name: getattr(math, name)
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
} | {"abs": abs}

_NAMES = {"pi": math.pi, "π": math.pi, "e": math.e}
_KINDS = (ast.Expr, ast.Constant, ast.Name, ast.UnaryOp, ast.BinOp, ast.Call)
# The power of floats: that of whole numbers may have millions of digits.
_OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
# No quotes, commas, dots or brackets but those of numbers: nothing else than numbers can be made of these.
_TEXT = re.compile(
    r"(?>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![\w.])|[A-Za-zπ]+[0-9]*(?![\w.])|[-+*/()]|\s)+"
)


class NotANumber(ValueError):
    """A text that has no value as a number; the message says what is allowed."""


def evaluate(text: str) -> float:
    """The finite value of an expression.

    Raises
    ------
    NotANumber : it is too long, cannot be read, or has no finite value.
    """
    text = text.strip().replace("−", "-").replace("^", "**").replace("·", "*")
    if len(text) > MOST:
        raise NotANumber(f"At most {MOST} characters are read.")
    if not _TEXT.fullmatch(text):
        raise NotANumber("This is not a number: type one like 1.5, 1e-8, pi/3, sqrt(2) or 1/7.")
    evaluator = SimpleEval(operators=_OPERATORS, functions=dict(FUNCTIONS), names=_NAMES)
    evaluator.nodes = {kind: evaluator.nodes[kind] for kind in _KINDS}
    try:
        # Python warns of what it may mean, and such is refused anyway.
        with warnings.catch_warnings(action="error"):
            value = evaluator.eval(text)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise TypeError
        value = float(value)
    except (ArithmeticError, ValueError):
        value = math.nan
    except (InvalidExpression, SyntaxError, TypeError, RecursionError, MemoryError, Warning):
        raise NotANumber(
            "This is no number and no expression that can be read: + − * / **, parentheses, pi, e and "
            f"{', '.join(FUNCTIONS)} are known."
        ) from None
    if not math.isfinite(value):
        raise NotANumber("This has no finite value: change the expression.")
    return value
