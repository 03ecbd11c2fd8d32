"""Formulas that a user types: polynomials such as 0.5*g1^2 − g3, and periodic drives such as cos(W*t).

The text is untrusted.  `calculate` evaluates it without running code; names stand for polynomials, so that the result
is a polynomial, with bounds on length, degree and number of terms.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

from hess_explorer.protocol.expressions import Unreadable, calculate, to_python
from hess_mechanics.errors import InvalidParameter

MAX_LENGTH = 200
"""Maximum length of a formula in characters, after its translation to Python."""
_DEGREE = 6
_LARGEST = 1e6
_NAMES = ("g1", "g2", "g3")
_NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![\w.])"
_TEXT = re.compile(rf"(?>{_NUMBER}|g[123](?![\w.])|[-+*/()]|\s)+")
_DRIVE = re.compile(rf"(?>{_NUMBER}|(?:cos|sin|phase)(?![\w.])|[-+*/()]|\s)+")

Exponents = tuple[int, int, int]


class _Terms(dict[Exponents, Any]):
    """Coefficients of a polynomial in three variables: g1, g2, g3, or cos Ωt, sin Ωt, Ωt, by their exponents."""

    def add(self, exponents: Exponents, value: Any) -> None:
        """Add a value to the coefficient of the exponents."""
        self[exponents] = self.get(exponents, 0.0) + value


_PHASE = _Terms({(0, 0, 1): 1.0})
_TURN = _Terms({(1, 0, 0): 1.0, (0, 1, 0): 1j})
"""The polynomial cos Ωt + i sin Ωt, whose n-th power has the real part cos nΩt and the imaginary part sin nΩt."""


def _of(x: Any) -> _Terms:
    return x if isinstance(x, _Terms) else _Terms({(0, 0, 0): float(x)})


def _sum(a: Any, b: Any, sign: float = 1.0) -> _Terms:
    found = _Terms(_of(a))
    for exponents, value in _of(b).items():
        found.add(exponents, sign * value)
    return found


def _product(a: Any, b: Any) -> _Terms:
    found = _Terms()
    for one, x in _of(a).items():
        for other, y in _of(b).items():
            together = (one[0] + other[0], one[1] + other[1], one[2] + other[2])
            if sum(together) > _DEGREE:
                raise InvalidParameter(f"The degree of the formula is more than {_DEGREE}: choose lower powers.")
            found.add(together, x * y)
    return found


def _quotient(a: Any, b: Any) -> _Terms:
    divisor = _of(b)
    if set(divisor) != {(0, 0, 0)} or divisor[0, 0, 0] == 0.0:
        raise InvalidParameter("The formula divides by 0 or by something other than a number: write a polynomial.")
    return _product(a, 1.0 / divisor[0, 0, 0])


def _power(a: Any, n: Any) -> _Terms:
    exponent = _of(n)
    if set(exponent) != {(0, 0, 0)} or exponent[0, 0, 0] not in range(_DEGREE + 1):
        raise InvalidParameter(f"An exponent of the formula is not a whole number from 0 to {_DEGREE}: change it.")
    found = _of(1.0)
    for _ in range(int(exponent[0, 0, 0])):
        found = _product(found, a)
    return found


_OPERATORS: Mapping[type[ast.AST], Callable[..., Any]] = {
    ast.Add: _sum,
    ast.Sub: lambda a, b: _sum(a, b, -1.0),
    ast.Mult: _product,
    ast.Div: _quotient,
    ast.Pow: _power,
    ast.USub: lambda a: _product(a, -1.0),
    ast.UAdd: operator.pos,
}


def polynomial(text: str) -> dict[Exponents, float]:
    """Return the coefficients of a polynomial in g1, g2, g3 by exponents.

    Parameters
    ----------
    text : str
        The formula, for example "0.5*g1^2 - g3"; "^" means a power.  An empty text means 0.

    Returns
    -------
    dict
        Nonzero coefficients, without the constant, by the exponents of g1, g2, g3.

    Raises
    ------
    InvalidParameter
        If the text is too long, or not a polynomial of degree 6 or less with coefficients of magnitude up to 1e6.

    Examples
    --------
    >>> polynomial("(g1 + 2)^2/2")
    {(2, 0, 0): 0.5, (1, 0, 0): 2.0}
    """
    names = {name: _Terms({(int(i == 0), int(i == 1), int(i == 2)): 1.0}) for i, name in enumerate(_NAMES)}
    plain = to_python(text).replace("γ", "g").translate(str.maketrans("₁₂₃", "123"))
    return _read(
        plain, _TEXT, names, {}, "polynomial: use numbers, g1, g2, g3, + − * / ^ and parentheses, like 0.5*g1^2 - g3"
    )


def drive(text: str) -> dict[Exponents, float]:
    """Return a polynomial in cos(n*W*t) and sin(n*W*t) as coefficients by the exponents of cos Ωt and sin Ωt.

    Parameters
    ----------
    text : str
        The formula, for example "cos(W*t) + 0.5*sin(2*W*t)"; W is Ω.  An empty text means 0.

    Returns
    -------
    dict
        Nonzero coefficients, without the constant, by (exponent of cos Ωt, exponent of sin Ωt, 0).

    Raises
    ------
    InvalidParameter
        If the text is too long, or not such a polynomial of degree 6 or less with coefficients of magnitude up to 1e6.

    Examples
    --------
    >>> drive("cos(W*t) + sin(2*W*t)")
    {(1, 0, 0): 1.0, (1, 1, 0): 2.0}
    """
    plain = re.sub(r"[WΩ]\s*\*?\s*t(?!\w)", "phase", to_python(text))
    functions = {"cos": lambda angle: _harmonic(angle, "real"), "sin": lambda angle: _harmonic(angle, "imag")}
    found = _read(
        plain,
        _DRIVE,
        {"phase": _PHASE},
        functions,
        "drive: use numbers and cos(n*W*t), sin(n*W*t), like cos(W*t) + 0.5*sin(2*W*t)",
    )
    if any(exponents[2] for exponents in found):
        raise InvalidParameter("A drive must be periodic: use t only inside cos and sin.")
    return found


def _harmonic(angle: Any, part: str) -> _Terms:
    """Return cos ("real") or sin ("imag") of n times the phase as a polynomial in cos and sin of the phase."""
    terms = _of(angle)
    n = terms.get((0, 0, 1), 0.0)
    if set(terms) != set(_PHASE) or n not in range(1, _DEGREE + 1):
        raise InvalidParameter(
            f"A cos or sin of the drive is not of n*W*t: write cos(n*W*t) and sin(n*W*t), n from 1 to {_DEGREE}."
        )
    return _Terms({exponents: getattr(value, part) for exponents, value in _power(_TURN, n).items()})


def _read(
    plain: str, allowed: re.Pattern[str], names: Mapping[str, Any], functions: Mapping[str, Any], kind: str
) -> dict[Exponents, float]:
    """Return the nonzero coefficients of a Python expression, without the constant.  Raises `InvalidParameter`."""
    if len(plain) > MAX_LENGTH:
        raise InvalidParameter(f"The formula is longer than {MAX_LENGTH} characters: shorten it.")
    if not plain:
        return {}
    try:
        if not allowed.fullmatch(plain):
            raise Unreadable
        found = _of(calculate(plain, _OPERATORS, names, functions))
    except InvalidParameter:
        raise
    except (Unreadable, ValueError, ArithmeticError):
        raise InvalidParameter(f"This is not a {kind}.") from None
    # The constant part of a potential has no effect, and that of a drive belongs to the rotors.
    kept = {exponents: value for exponents, value in found.items() if value != 0.0 and any(exponents)}
    if not all(abs(value) <= _LARGEST for value in kept.values()):
        raise InvalidParameter(f"A coefficient of the formula is larger than {_LARGEST:g}: choose smaller numbers.")
    return kept
