"""Expressions that a traced field records: operations on variables and parameters, with their derivatives.

Not for users.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import add, mul, sub, truediv
from typing import Any, NoReturn

import numpy as np

from hess_mechanics.errors import InvalidParameter

__all__ = ["ALLOWED", "FUNCTIONS", "Node", "NotTraceable", "Symbol", "Tape"]


_Number = int | float | np.integer | np.floating
_ARITHMETIC: dict[str, Callable[[Any, Any], Any]] = {"+": add, "-": sub, "*": mul, "/": truediv}


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "acos": math.acos,
    "asin": math.asin,
    "atan": math.atan,
    "atan2": math.atan2,
    "cos": math.cos,
    "cosh": math.cosh,
    "exp": math.exp,
    "log": math.log,
    "pow": math.pow,
    "sin": math.sin,
    "sinh": math.sinh,
    "sqrt": math.sqrt,
    "tan": math.tan,
    "tanh": math.tanh,
}
"""Functions that a field may use, by the names in the source of a recursion."""

_RATES: dict[str, Callable[..., Any]] = {
    "acos": lambda u, x, dx: -dx / (1 - x * x).sqrt(),
    "asin": lambda u, x, dx: dx / (1 - x * x).sqrt(),
    "atan": lambda u, x, dx: dx / (1 + x * x),
    "atan2": lambda u, y, x, dy, dx: (x * dy - y * dx) / (x * x + y * y),
    "cos": lambda u, x, dx: -x.sin() * dx,
    "cosh": lambda u, x, dx: x.sinh() * dx,
    "exp": lambda u, x, dx: u * dx,
    "log": lambda u, x, dx: dx / x.carried(),
    "pow": lambda u, x, a, dx, da: a * (u / x.carried()) * dx + u * x.log() * da,
    "sin": lambda u, x, dx: x.cos() * dx,
    "sinh": lambda u, x, dx: x.cosh() * dx,
    "sqrt": lambda u, x, dx: 0.5 * (dx / u),
    "tan": lambda u, x, dx: (1 + u * u) * dx,
    "tanh": lambda u, x, dx: (1 - u * u) * dx,
    "carried": lambda u, x, dx: dx,
}
"""The rate of each function u of x from x and the rate of x, in arithmetic and functions.  `carried(x)` is x itself,
followed as a variable of its own: a quotient then waits for fewer products."""


class NotTraceable(InvalidParameter, TypeError):
    """A field that cannot be traced: it has conditions, functions not in `FUNCTIONS`, or a wrong number of rates."""


ALLOWED = (
    "Use +, −, *, /, powers, and NumPy's sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, arcsin, arccos, arctan and "
    "arctan2 of numbers, variables and parameters, without conditions, and unpack as many variables and parameters as "
    "the system has."
)


@dataclass(frozen=True, eq=False)
class Node:
    """An operation; equal operations on a tape are the same object.

    Attributes
    ----------
    operation : str
        "number", "variable", "parameter", "series", "start", "negative", an arithmetic sign, the name of a function, or
        an operation of `Tape.linear`.
    arguments : tuple of Node
        The operands.
    value : object
        Value of a "number", index of a "variable", "parameter" or "series", signs of the terms of a "sum"; otherwise
        None or ().
    moves : bool
        True if the result changes during a step.
    uses_start : bool
        True if it depends on the variables at the start of a step, or on a function of parameters alone.
    """

    operation: str
    arguments: tuple[Node, ...]
    value: Any
    moves: bool
    uses_start: bool


class Tape:
    """The operations of a trace, each stored once."""

    def __init__(self) -> None:
        self._nodes: dict[tuple[Any, ...], Node] = {}
        self._derivatives: dict[tuple[Node, Node | None], Node] = {}
        self._rates: Sequence[Node] = ()
        self.positive: set[Node] = set()

    def _node(self, operation: str, arguments: tuple[Node, ...], value: Any, moves: bool, started: bool) -> Node:
        key = (operation, *map(id, arguments), value)
        return self._nodes.setdefault(key, Node(operation, arguments, value, moves, started))

    def leaf(self, operation: str, value: Any) -> Node:
        """Return the node of a number, a variable, a parameter or a series."""
        return self._node(operation, (), value, operation not in ("number", "parameter"), False)

    def number(self, value: float) -> Node:
        """Return the node of a number."""
        # −0.0 and 0.0 are one number, and so are an integer and the equal float.
        return self.leaf("number", int(value) if value == int(value) and abs(value) < 2**53 else float(value))

    def node_of(self, x: Any) -> Node:
        """Return the node of a symbol or a finite number.  Raises `NotTraceable` for anything else."""
        if isinstance(x, Symbol):
            return x.node
        if isinstance(x, _Number) and math.isfinite(x):
            return self.number(x.item() if isinstance(x, np.generic) else x)
        raise NotTraceable(f"This field cannot be traced: {x!r} is not a finite number. {ALLOWED}")

    def start(self, a: Node) -> Node:
        """Return the value of a at the start of a step; a itself if it does not change during a step."""
        return self._node("start", (a,), None, False, True) if a.moves else a

    def apply(self, operation: str, a: Node, b: Node) -> Node:
        """Return a + b, a − b, a b or a/b, simplified if an operand is 0 or 1.  Raises `NotTraceable` for a/0."""
        zero, one = self.number(0), self.number(1)
        if operation == "/" and b is zero:
            raise NotTraceable("This field cannot be traced: it divides by the number 0; correct the divisor.")
        if a.operation == b.operation == "number":
            value = _ARITHMETIC[operation](a.value, b.value)
            # Keep 1/3 as a quotient: its double would be wrong in arithmetic with more digits.
            if value == _ARITHMETIC[operation](Fraction(a.value), Fraction(b.value)):
                return self.number(value)
        if b is zero and operation in "+-":
            return a
        if a is zero and operation in "+-":
            return b if operation == "+" else self.negative(b)
        if zero in (a, b):
            return zero
        if b is one and operation in "*/":
            return a
        if operation == "/" and b.operation == "pow":
            # All quotients share the inverse of a divisor, which needs no series product.
            return self.apply("*", a, self.power(b.arguments[0], self.negative(b.arguments[1])))
        if operation == "*" and a is b and a.operation == "sqrt":
            return a.arguments[0]
        if a is one and operation == "*":
            return b
        return self._node(operation, (a, b), None, a.moves or b.moves, a.uses_start or b.uses_start)

    def negative(self, a: Node) -> Node:
        """Return −a."""
        if a.operation == "number":
            return self.number(-a.value)
        return (
            a.arguments[0] if a.operation == "negative" else self._node("negative", (a,), None, a.moves, a.uses_start)
        )

    def power(self, a: Node, exponent: Node) -> Node:
        """Return a to the power of a number or another expression."""
        n = exponent.value if exponent.operation == "number" else None
        if a.operation in ("sqrt", "pow") and isinstance(n, int):
            # Simplify a power of a power: r³ with r = √x needs no series product.
            inner = a.arguments[1] if a.operation == "pow" else self.number(0.5)
            return self.power(a.arguments[0], self.apply("*", inner, exponent))
        if n == 0.5:
            return self.call("sqrt", a)
        if exponent.moves:
            return self.call("exp", self.apply("*", exponent, self.call("log", a)))
        if not isinstance(n, int):
            return self.call("pow", a, exponent)
        if n < 0:
            return self.apply("/", self.number(1), self.power(a, self.number(-n)))
        if n < 2:
            return a if n else self.number(1)
        half = self.power(a, self.number(n // 2))
        square = self.apply("*", half, half)
        return self.apply("*", square, a) if n % 2 else square

    def call(self, function: str, *arguments: Node) -> Node:
        """Return a function of expressions."""
        if function == "carried" and arguments[0].operation in ("variable", *FUNCTIONS):
            return arguments[0]
        moves = any(argument.moves for argument in arguments)
        # A function of parameters only is computed once per step.
        return self._node(function, arguments, None, moves, not moves or any(one.uses_start for one in arguments))

    def functions(self, results: Sequence[Node], variables: int) -> dict[Node, Node]:
        """Return the functions of the state in a field that returns these results, with their rates."""
        self._rates = results[:variables]
        rates: dict[Node, Node] = {}
        waiting = list(results)
        seen: set[Node] = set()
        while waiting:
            node = waiting.pop()
            if node in seen:
                continue
            seen.add(node)
            if node.moves and node.operation in _RATES:
                rates[node] = self.derivative(node)
                waiting.append(rates[node])
            else:
                waiting += node.arguments
        return rates

    def derivative(self, x: Node, y: Node | None = None) -> Node:
        """Return ∂x/∂y for a variable y, or by default the rate of x along the motion."""
        if (x, y) not in self._derivatives:
            self._derivatives[x, y] = self._derive(x, y)
        return self._derivatives[x, y]

    def _derive(self, x: Node, y: Node | None) -> Node:
        if y is None and not x.moves:
            return self.number(0)
        if not x.arguments:
            return self._rates[x.value] if y is None else self.number(1 if x is y else 0)
        inner = [self.derivative(argument, y) for argument in x.arguments]
        if x.operation == "start":
            return inner[0]
        if x.operation == "negative":
            return self.negative(inner[0])
        if x.operation in "+-":
            return self.apply(x.operation, *inner)
        if x.operation in _RATES:
            if all(one is self.number(0) for one in inner):
                return self.number(0)
            return self.node_of(_RATES[x.operation](*(Symbol(self, node) for node in (x, *x.arguments, *inner))))
        (a, b), (da, db) = x.arguments, inner
        if x.operation == "*":
            return self.apply("+", self.apply("*", da, b), self.apply("*", a, db))
        return self.apply("/", self.apply("-", da, self.apply("*", x, db)), b)

    def linear(self, operation: str, *arguments: Node, signs: tuple[int, ...] = ()) -> Node:
        """Return a node of the recursion: "one", "product", "scaled", or "sum" with a sign, 1 or −1, for each term."""
        return self._node(operation, arguments, signs, True, False)


def _operators(sign: str) -> tuple[Callable[[Symbol, Any], Any], Callable[[Symbol, Any], Any]]:
    """Return the methods of an operation: with the symbol on the left, and on the right."""
    return lambda one, other: one.combine(sign, one, other), lambda one, other: one.combine(sign, other, one)


class Symbol:
    """A variable, a parameter, or an expression in them, as a traced field sees it."""

    __slots__ = ("node", "tape")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, tape: Tape, node: Node) -> None:
        self.tape, self.node = tape, node

    def combine(self, operation: str, left: Any, right: Any) -> Any:
        """Return the symbol of an operation on two symbols or numbers; `NotImplemented` for other operands."""
        if not all(isinstance(x, Symbol | _Number) for x in (left, right)):
            return NotImplemented
        return Symbol(self.tape, self.tape.apply(operation, self.tape.node_of(left), self.tape.node_of(right)))

    __add__, __radd__ = _operators("+")
    __sub__, __rsub__ = _operators("-")
    __mul__, __rmul__ = _operators("*")
    __truediv__, __rtruediv__ = _operators("/")

    def __neg__(self) -> Symbol:
        return Symbol(self.tape, self.tape.negative(self.node))

    def __pos__(self) -> Symbol:
        return self

    def __pow__(self, exponent: Any) -> Any:
        if not isinstance(exponent, Symbol | _Number):
            return NotImplemented
        return Symbol(self.tape, self.tape.power(self.node, self.tape.node_of(exponent)))

    def __rpow__(self, base: Any) -> Any:
        if not isinstance(base, _Number):
            return NotImplemented
        return Symbol(self.tape, self.tape.power(self.tape.node_of(base), self.node))

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **given: Any) -> Any:
        """Leave functions and arithmetic to the methods of this class, for each element of an array."""
        if method != "__call__" or given:
            return NotImplemented
        return ufunc(*(np.asarray(x).astype(object) for x in inputs))

    @property
    def moves(self) -> bool:
        """True if the expression changes during a step."""
        return self.node.moves

    def at_start(self) -> Symbol:
        """Return the symbol of the value at the start of a step, see `tracing.constant`."""
        return Symbol(self.tape, self.tape.start(self.node))

    def as_positive(self) -> Symbol:
        """Return this symbol, and record that it has no zero, see `tracing.positive`."""
        self.tape.positive.add(self.node)
        return self

    def _refuse(self, *_: Any) -> NoReturn:
        raise NotTraceable(
            "This field cannot be traced: it compares its variables or parameters, or passes them to a function that "
            f"takes floats only, as those of `math` do. {ALLOWED} For a motion with cases, find the event with "
            "`section(body, start, plane, duration)` and go on from it with a system for the next case."
        )

    __bool__ = __float__ = __int__ = __index__ = __complex__ = __abs__ = __round__ = _refuse
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = _refuse
    __mod__ = __floordiv__ = __rmod__ = __rfloordiv__ = __matmul__ = __rmatmul__ = _refuse


def _function_of(name: str) -> Callable[..., Symbol]:
    """Return the method of `Symbol` for a function, which NumPy calls for arrays of objects."""

    def call(self: Symbol, *others: Any) -> Symbol:
        return Symbol(self.tape, self.tape.call(name, self.node, *map(self.tape.node_of, others)))

    return call


for _name in _RATES:
    setattr(Symbol, _name, _function_of(_name))
    setattr(Symbol, _name.replace("a", "arc", 1) if _name[0] == "a" else _name, _function_of(_name))
