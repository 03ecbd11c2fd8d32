"""Elementary functions of all numbers on which a field is evaluated.

NumPy's own functions take floats, arrays and the symbols of a traced field.  These also take the numbers of any library
that has functions of these names, such as SymPy and mpmath, for checks.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np

__all__ = [
    "acos", "asin", "atan", "atan2", "cos", "cosh", "exp", "log", "sin", "sinh", "sqrt", "tan", "tanh",
]  # fmt: skip


_DOC = """Return {name} of numbers, arrays or symbols.

Parameters
----------
*arguments : number, ndarray or symbol
    Arguments of the function, in radians if they are angles.

Returns
-------
number, ndarray or symbol
    The value.
"""


def _function(name: str) -> Callable[..., Any]:
    def call(*arguments: Any) -> Any:
        libraries = (sys.modules.get(type(x).__module__.partition(".")[0]) for x in arguments)
        return getattr(next((one for one in libraries if hasattr(one, name)), np), name)(*arguments)

    call.__name__ = call.__qualname__ = name
    call.__doc__ = _DOC.format(name=name)
    return call


acos, asin, atan, atan2 = (_function(name) for name in ("acos", "asin", "atan", "atan2"))
cos, cosh, exp, log = (_function(name) for name in ("cos", "cosh", "exp", "log"))
sin, sinh, sqrt, tan, tanh = (_function(name) for name in ("sin", "sinh", "sqrt", "tan", "tanh"))
