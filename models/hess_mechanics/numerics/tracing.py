"""Derivation of the Taylor recursion of a vector field, written in Python as the paper prints it.

`trace` calls field(y, p) once with symbols that record the operations.  Taylor coefficients of sums are sums, those of
a product are Cauchy products q_k = Σ_m a_m b_(k−m).  Hence the recorded field is brought into the form

    ẏ = rates(y, q),   linear in the series y and in products q of two of them,

which holds at every order k and gives (k+1) y_(k+1).  Factors that are sums of variables are multiplied out.  Any other
factor and every quotient become auxiliary series, computed at each order in stages.  A stage is linear in the
variables, in the results of earlier stages, and in products of these.  For z = r/d it is z_k = (r_k − (d z)_k)/d_0,
where (d z)_k is taken without the still unknown term d_0 z_k.

Expressions in the parameters alone are computed once, and so is `constant(x)`, by which the author of a field declares
that x does not change along a motion.  Expressions keep the form in which they were written, so that a common factor
has the same round-off everywhere.

A function of the state, such as u = sin x, becomes a further variable, whose rate is arithmetic again: u̇ = cos(x) ẋ.
Its value at the start of each step is computed by the function itself, so that it does not drift.  Hence kernels need
functions at order 0 only.

A field may use arithmetic and these functions, without conditions.  Its expressions can be differentiated
(`derivative`).  A field may return further expressions after its rates; their series are computed along with the
motion.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import add, mul, sub, truediv
from typing import Any, NoReturn

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.unrolled import items

__all__ = ["FUNCTIONS", "Field", "NotTraceable", "Recursion", "Symbol", "check", "constant", "derivative", "trace"]

Field = Callable[[Sequence[Any], Sequence[Any]], Sequence[Any]]
"""field(y, p) → ẏ in arithmetic and `FUNCTIONS`."""


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
    """A field with conditions, or with functions that have no Taylor recursion here."""


@dataclass(frozen=True)
class Recursion:
    """The Taylor recursion of a field.

    variables, parameters : lengths of y and p.
    stages : number of auxiliary series of each stage; they follow the variables in y.
    pairs : indices into y of the two factors of each product.
    constants : number of values that are constant during a step; they follow the parameters in p.
    observed : number of series that the field returns after its rates.
    functions : number of functions of the state, which follow the variables in y and the rates of these.
    source : Python source of `rates(y, q, p, one)` and, if needed, of `stage0(y, q, p, one)`, … and `constants(y, p)`;
        each returns a tuple.  one : the series of the number 1, which is 1 at order 0 and 0 at all others.
        `started(y, p)` returns the functions at a state, and `extended(y, p)` the rates of variables and functions in
        plain arithmetic.
    """

    variables: int
    parameters: int
    stages: tuple[int, ...]
    pairs: tuple[tuple[int, int], ...]
    constants: int
    source: str
    observed: int = 0
    functions: int = 0

    @property
    def moving(self) -> int:
        """Number of series with a rate: variables and functions."""
        return self.variables + self.functions

    @property
    def known(self) -> list[int]:
        """Number of series known before the first stage and after each stage; those with a rate come first."""
        return [self.moving + sum(self.stages[:i]) for i in range(len(self.stages) + 1)]

    @property
    def is_quadratic(self) -> bool:
        """True if the recursion needs products of variables and functions only."""
        return not self.stages and not self.constants


def constant(x: Any) -> Any:
    """Return x and declare that it does not change along a motion.

    A traced field uses its value at the start of a step for the whole step.
    """
    return x.at_start() if isinstance(x, Symbol) else x


def derivative(x: Any, y: Symbol) -> Any:
    """Return ∂x/∂y for an expression x of a traced field and one of its variables y: a symbol, or the number 0.

    An expression that is constant along a motion (`constant`) still depends on the initial state.
    """
    if not isinstance(x, Symbol):
        return 0
    found = x.tape.derivative(x.node, y.node)
    return 0 if found is x.tape.number(0) else Symbol(x.tape, found)


def trace(field: Field, variables: int, parameters: int, observed: int = 0) -> Recursion:
    """Return the Taylor recursion of a field.

    variables, parameters : lengths of y and p; observed : number of expressions that it returns after its rates.
    Raises `NotTraceable` if the field uses anything but arithmetic and `FUNCTIONS`.
    """
    tape, found = _record(field, variables, parameters, observed)
    functions = tape.functions(found, variables)
    rates = [*found[:variables], *functions.values(), *found[variables:]]
    plain = _Series(tape, variables, [*functions], multiplies_out=True).recursion(rates, parameters)
    if not plain.stages:
        return plain
    return _Series(tape, variables, [*functions], multiplies_out=False).recursion(rates, parameters)


def check(field: Field, variables: int, parameters: int) -> None:
    """Raise `NotTraceable` if the field cannot be traced, or does not return one rate for each variable."""
    _record(field, variables, parameters, 0)


def _record(field: Field, variables: int, parameters: int, observed: int) -> tuple[_Tape, list[_Node]]:
    """Return the tape of a field, and the nodes that it returns."""
    tape = _Tape()
    y = tuple(Symbol(tape, tape.leaf("variable", i)) for i in range(variables))
    p = tuple(Symbol(tape, tape.leaf("parameter", i)) for i in range(parameters))
    try:
        rates = [tape.lifted(rate) for rate in field(y, p)]
    except NotTraceable:
        raise
    except (TypeError, ValueError, AttributeError, ArithmeticError, LookupError) as error:
        raise NotTraceable(f"This field cannot be traced: {error}. {_ALLOWED}") from error
    if len(rates) != variables + observed:
        raise NotTraceable(
            f"This field has {variables} variables and returns {len(rates) - observed} rates: return one for each."
        )
    return tape, rates


_ALLOWED = (
    "Use +, −, *, /, powers, and NumPy's sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, arcsin, arccos, arctan and "
    "arctan2 of numbers, variables and parameters, without conditions, and unpack as many variables and parameters as "
    "the system has."
)


@dataclass(frozen=True, eq=False)
class _Node:
    """An operation; equal operations on a tape are the same object.

    value : value of a "number", index of a "variable", "parameter" or "series"; moves : True if the result changes
    during a step; started : True if it depends on the values of the variables at the start of a step.
    """

    operation: str
    arguments: tuple[_Node, ...]
    value: Any
    moves: bool
    started: bool


class _Tape:
    """The operations of a trace, each stored once."""

    def __init__(self) -> None:
        self._nodes: dict[tuple[Any, ...], _Node] = {}
        self._derivatives: dict[tuple[_Node, _Node | None], _Node] = {}
        self._rates: Sequence[_Node] = ()

    def _node(self, operation: str, arguments: tuple[_Node, ...], value: Any, moves: bool, started: bool) -> _Node:
        key = (operation, *map(id, arguments), value)
        return self._nodes.setdefault(key, _Node(operation, arguments, value, moves, started))

    def leaf(self, operation: str, value: Any) -> _Node:
        return self._node(operation, (), value, operation not in ("number", "parameter"), False)

    def number(self, value: float) -> _Node:
        # −0.0 and 0.0 are one number, and so are an integer and the equal float.
        return self.leaf("number", int(value) if value == int(value) and abs(value) < 2**53 else float(value))

    def lifted(self, x: Any) -> _Node:
        """Return the node of a symbol or a number.  Raises `NotTraceable` for anything else."""
        if isinstance(x, Symbol):
            return x.node
        if isinstance(x, _Number) and math.isfinite(x):
            return self.number(x.item() if isinstance(x, np.generic) else x)
        raise NotTraceable(f"This field cannot be traced: {x!r} is not a finite number. {_ALLOWED}")

    def start(self, a: _Node) -> _Node:
        return self._node("start", (a,), None, False, True) if a.moves else a

    def apply(self, operation: str, a: _Node, b: _Node) -> _Node:
        """Return a + b, a − b, a b or a/b, simplified if an operand is 0 or 1.  Raises `NotTraceable` for a/0."""
        zero, one = self.number(0), self.number(1)
        if operation == "/" and b is zero:
            raise NotTraceable("This field cannot be traced: it divides by 0.")
        if a.operation == b.operation == "number":
            found = _ARITHMETIC[operation](a.value, b.value)
            # 1/3 stays a quotient: its double would be wrong in arithmetic with more digits.
            if found == _ARITHMETIC[operation](Fraction(a.value), Fraction(b.value)):
                return self.number(found)
        if b is zero and operation in "+-":
            return a
        if a is zero and operation in "+-":
            return b if operation == "+" else self.negative(b)
        if zero in (a, b):
            return zero
        if b is one and operation in "*/":
            return a
        if operation == "/" and b.operation == "pow":
            # The inverse is shared by all quotients, and costs no product.
            return self.apply("*", a, self.power(b.arguments[0], self.negative(b.arguments[1])))
        if operation == "*" and a is b and a.operation == "sqrt":
            return a.arguments[0]
        if a is one and operation == "*":
            return b
        return self._node(operation, (a, b), None, a.moves or b.moves, a.started or b.started)

    def negative(self, a: _Node) -> _Node:
        if a.operation == "number":
            return self.number(-a.value)
        return a.arguments[0] if a.operation == "negative" else self._node("negative", (a,), None, a.moves, a.started)

    def power(self, a: _Node, exponent: _Node) -> _Node:
        """Return a to the power of a number or another expression."""
        n = exponent.value if exponent.operation == "number" else None
        if a.operation in ("sqrt", "pow") and isinstance(n, int):
            # A power of a power: r³ with r = √x costs no product.
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

    def call(self, function: str, *arguments: _Node) -> _Node:
        """Return a function of expressions."""
        if function == "carried" and arguments[0].operation in ("variable", *FUNCTIONS):
            return arguments[0]
        moves = any(argument.moves for argument in arguments)
        # One of parameters only is computed once in each step.
        return self._node(function, arguments, None, moves, not moves or any(one.started for one in arguments))

    def functions(self, results: Sequence[_Node], variables: int) -> dict[_Node, _Node]:
        """Return the functions of the state in a field that returns these results, with their rates."""
        self._rates = results[:variables]
        found: dict[_Node, _Node] = {}
        waiting = list(results)
        seen: set[_Node] = set()
        while waiting:
            node = waiting.pop()
            if node in seen:
                continue
            seen.add(node)
            if node.moves and node.operation in _RATES:
                found[node] = self.derivative(node)
                waiting.append(found[node])
            else:
                waiting += node.arguments
        return found

    def derivative(self, x: _Node, y: _Node | None = None) -> _Node:
        """Return ∂x/∂y for a variable y, or by default the rate of x along the motion."""
        if (x, y) not in self._derivatives:
            self._derivatives[x, y] = self._derive(x, y)
        return self._derivatives[x, y]

    def _derive(self, x: _Node, y: _Node | None) -> _Node:
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
            return self.lifted(_RATES[x.operation](*(Symbol(self, node) for node in (x, *x.arguments, *inner))))
        (a, b), (da, db) = x.arguments, inner
        if x.operation == "*":
            return self.apply("+", self.apply("*", da, b), self.apply("*", a, db))
        return self.apply("/", self.apply("-", da, self.apply("*", x, db)), b)

    def linear(self, operation: str, *arguments: _Node, signs: tuple[int, ...] = ()) -> _Node:
        """Return a node of the recursion: "one", "product", "scaled", or "sum" with a sign, 1 or −1, for each term."""
        return self._node(operation, arguments, signs, True, False)


def _operators(sign: str) -> tuple[Callable[[Symbol, Any], Any], Callable[[Symbol, Any], Any]]:
    """Return the methods of an operation: with the symbol on the left, and on the right."""
    return lambda one, other: one.combined(sign, one, other), lambda one, other: one.combined(sign, other, one)


class Symbol:
    """A variable, a parameter, or an expression in them, as a traced field sees it."""

    __slots__ = ("node", "tape")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, tape: _Tape, node: _Node) -> None:
        self.tape, self.node = tape, node

    def combined(self, operation: str, left: Any, right: Any) -> Any:
        """Return the symbol of an operation on two symbols or numbers."""
        if not all(isinstance(x, Symbol | _Number) for x in (left, right)):
            return NotImplemented
        return Symbol(self.tape, self.tape.apply(operation, self.tape.lifted(left), self.tape.lifted(right)))

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
        return Symbol(self.tape, self.tape.power(self.node, self.tape.lifted(exponent)))

    def __rpow__(self, base: Any) -> Any:
        if not isinstance(base, _Number):
            return NotImplemented
        return Symbol(self.tape, self.tape.power(self.tape.lifted(base), self.node))

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
        """Return its value at the start of a step, see `constant`."""
        return Symbol(self.tape, self.tape.start(self.node))

    def _refuse(self, *_: Any) -> NoReturn:
        raise NotTraceable(
            "This field cannot be traced: it compares its variables or parameters, or passes them to a function that "
            f"takes floats only, as those of `math` do. {_ALLOWED} For a motion with cases, find the event with "
            "`section(body, state, plane, end, level)` and go on from it with a system for the next case."
        )

    __bool__ = __float__ = __int__ = __index__ = __complex__ = __abs__ = __round__ = _refuse
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = _refuse
    __mod__ = __floordiv__ = __rmod__ = __rfloordiv__ = __matmul__ = __rmatmul__ = _refuse


def _function_of(name: str) -> Callable[..., Symbol]:
    """Return the method of `Symbol` for a function, which NumPy calls for arrays of objects."""

    def call(self: Symbol, *others: Any) -> Symbol:
        return Symbol(self.tape, self.tape.call(name, self.node, *map(self.tape.lifted, others)))

    return call


for _name in _RATES:
    setattr(Symbol, _name, _function_of(_name))
    setattr(Symbol, _name.replace("a", "arc", 1) if _name[0] == "a" else _name, _function_of(_name))


class _Series:
    """The expressions of a tape, rewritten in terms of series and their products."""

    def __init__(self, tape: _Tape, variables: int, functions: Sequence[_Node], multiplies_out: bool) -> None:
        self._tape, self._multiplies_out = tape, multiplies_out
        self._functions = {node: variables + i for i, node in enumerate(functions)}
        self._variables = variables + len(functions)  # all series with a rate
        self._one = tape.linear("one")
        self._lowered: dict[_Node, _Node] = {}
        self._rules: list[_Node] = []  # of the auxiliary series
        self._places: dict[_Node, int] = {}
        self._divided: set[_Node] = set()  # the products d·z of the quotients

    def lowered(self, node: _Node) -> _Node:
        """Return the node as a sum of series and products with constant factors."""
        if node not in self._lowered:
            self._lowered[node] = self._lower(node)
        return self._lowered[node]

    def _lower(self, node: _Node) -> _Node:
        if not node.moves:
            return self._scaled(node, self._one)
        if node.operation == "variable":
            return self._tape.leaf("series", node.value)
        if node in self._functions:
            return self._tape.leaf("series", self._functions[node])
        if node.operation == "negative":
            return self._sum((-1, self.lowered(node.arguments[0])))
        a, b = node.arguments
        if node.operation in "+-":
            return self._sum((1, self.lowered(a)), (1 if node.operation == "+" else -1, self.lowered(b)))
        if node.operation == "*":
            if not a.moves or not b.moves:
                factor, series = (a, b) if not a.moves else (b, a)
                return self._scaled(factor, self.lowered(series))
            return self._product(self.lowered(a), self.lowered(b))
        if not b.moves:
            return self._scaled(self._tape.apply("/", self._tape.number(1), b), self.lowered(a))
        return self._quotient(self.lowered(a), b)

    def _sum(self, *signed: tuple[int, _Node]) -> _Node:
        terms: list[tuple[int, _Node]] = []
        for sign, form in signed:
            terms += [(sign * own, term) for own, term in _terms(form)]
        if [sign for sign, _ in terms] == [1]:
            return terms[0][1]
        return self._tape.linear("sum", *(term for _, term in terms), signs=tuple(sign for sign, _ in terms))

    def _scaled(self, factor: _Node, series: _Node) -> _Node:
        if series.operation == "scaled":
            factor, series = self._tape.apply("*", factor, series.arguments[0]), series.arguments[1]
        if factor.operation == "negative" or (factor.operation == "number" and factor.value < 0):
            return self._sum((-1, self._scaled(self._tape.negative(factor), series)))
        return series if factor is self._tape.number(1) else self._tape.linear("scaled", factor, series)

    def _product(self, a: _Node, b: _Node) -> _Node:
        for factor, other in ((a, b), (b, a)):
            if factor is self._one:
                return other
            if factor.operation == "scaled":
                return self._scaled(factor.arguments[0], self._product(factor.arguments[1], other))
        for factor, other in ((a, b), (b, a)):
            if factor.operation == "sum" and factor.value[0] < 0:
                # Normalise the sign, so that x and −x are the same factor.
                return self._sum((-1, self._product(self._sum((-1, factor)), other)))
        for factor, other in ((a, b), (b, a)):
            if factor.operation == "sum" and self._multiplies_out and self._is_of_variables(factor):
                return self._sum(*((sign, self._product(term, other)) for sign, term in _terms(factor)))
        left, right = sorted((self._series(a), self._series(b)), key=lambda node: node.value)
        return self._tape.linear("product", left, right)

    def _is_of_variables(self, form: _Node) -> bool:
        if form.operation == "series":
            return bool(form.value < self._variables)
        if form.operation == "scaled":
            return self._is_of_variables(form.arguments[1])
        return form is self._one or (form.operation == "sum" and all(map(self._is_of_variables, form.arguments)))

    def _series(self, form: _Node) -> _Node:
        """Return a series that has this form."""
        if form.operation == "series":
            return form
        if form not in self._places:
            self._places[form] = self._variables + len(self._rules)
            self._rules.append(form)
        return self._tape.leaf("series", self._places[form])

    def _quotient(self, numerator: _Node, divisor: _Node) -> _Node:
        d = self._series(self.lowered(divisor))
        inverse = self._tape.apply("/", self._tape.number(1), self._tape.start(divisor))
        z = self._tape.leaf("series", self._variables + len(self._rules))
        product = self._tape.linear("product", d, z)
        self._divided.add(product)
        self._rules.append(self._scaled(inverse, self._sum((-1, product), (1, numerator))))
        return z

    def _levels(self) -> list[int]:
        """Return the stage of each auxiliary series, later than those of all series that its rule needs."""
        levels: list[int] = []
        for i, rule in enumerate(self._rules):
            needed = [node.value - self._variables for node in _below([rule]) if node.operation == "series"]
            levels.append(1 + max((levels[j] for j in needed if 0 <= j != i), default=-1))
        return levels

    def recursion(self, rates: Sequence[_Node], parameters: int) -> Recursion:
        """Return the recursion of a field with these rates."""
        forms = [self.lowered(rate) for rate in rates]
        # Keep only the series that the rates need: an unused intermediate result costs nothing.
        used = self._used(forms)
        levels = self._levels()
        order = sorted(used, key=lambda i: (levels[i], i))
        stages = [[i for i in order if levels[i] == level] for level in sorted({levels[i] for i in order})]
        places = {i: i for i in range(self._variables)}
        places |= {self._variables + i: self._variables + at for at, i in enumerate(order)}
        rules = [[self._rules[i] for i in stage] for stage in stages]
        everything = _below([*forms, *(rule for stage in rules for rule in stage)])
        products = [node for node in everything if node.operation == "product"]
        kept = [
            node
            for node in dict.fromkeys(node.arguments[0] for node in everything if node.operation == "scaled")
            if node.started
        ]

        names: dict[_Node, str] = {}
        late = {self._one: 0}
        for node in everything:
            if node.operation == "series":
                names[node] = f"y[{places[node.value]}]"
                late[node] = 0 if node.value < self._variables else 2 + 2 * levels[node.value - self._variables]
        for node in everything:
            if node.operation == "product":
                # The product in the rule of a quotient depends on the divisor only.
                late[node] = 1 + (min if node in self._divided else max)(late[factor] for factor in node.arguments)
        names |= {node: f"q[{j}]" for j, node in enumerate(products)} | {self._one: "one"}
        names |= {node: f"p[{parameters + j}]" for j, node in enumerate(kept)}
        functions = []
        for i, (stage, rule) in enumerate(zip(stages, rules, strict=True)):
            functions.append(_function(f"stage{i}(y, q, p, one)", rule, names, late))
            # Later stages use these results instead of computing them again.
            names |= {self._rules[j]: f"y[{places[self._variables + j]}]" for j in stage}
        functions.insert(0, _function("rates(y, q, p, one)", forms, names, late))
        at_start = {node: f"y[{i}]" for node, i in self._functions.items()}
        if kept:
            functions.append(_function("constants(y, p)", kept, at_start, {}))
        if self._functions:
            functions.append(_function("started(y, p)", [*self._functions], {}, {}))
            functions.append(_function("extended(y, p)", rates[: self._variables], at_start, {}))
        pairs = tuple((places[a.value], places[b.value]) for a, b in (node.arguments for node in products))
        return Recursion(
            self._variables - len(self._functions),
            parameters,
            tuple(map(len, stages)),
            pairs,
            len(kept),
            "\n\n".join(functions),
            len(rates) - self._variables,
            len(self._functions),
        )

    def _used(self, forms: Sequence[_Node]) -> list[int]:
        found: dict[int, None] = {}
        waiting = list(forms)
        while waiting:
            for node in _below([waiting.pop()]):
                i = node.value - self._variables if node.operation == "series" else -1
                if i >= 0 and i not in found:
                    found[i] = None
                    waiting.append(self._rules[i])
        return list(found)


def _below(roots: Iterable[_Node]) -> list[_Node]:
    """Return all nodes of these expressions, each once and after its arguments."""
    found: dict[_Node, None] = {}

    def visit(node: _Node) -> None:
        if node not in found:
            for argument in node.arguments:
                visit(argument)
            found[node] = None

    for root in roots:
        visit(root)
    return list(found)


def _terms(form: _Node) -> list[tuple[int, _Node]]:
    """Return the terms of a form with their signs."""
    return list(zip(form.value, form.arguments, strict=True)) if form.operation == "sum" else [(1, form)]


def _function(head: str, results: Sequence[_Node], names: dict[_Node, str], late: dict[_Node, int]) -> str:
    """Return the source of a function that returns these expressions.

    names : names of known expressions; late : stage at which each series and product becomes known.  In a sum the term
    that is known last comes last, so that the processor need not wait for it earlier.
    """
    latest = dict(late)

    def when(node: _Node) -> int:
        if node not in latest:
            latest[node] = max(map(when, node.arguments), default=0)
        return latest[node]

    uses = Counter(id(result) for result in results)
    seen: set[_Node] = set()

    def count(node: _Node) -> None:
        if node not in seen and node not in names:
            seen.add(node)
            uses.update(map(id, node.arguments))
            for argument in node.arguments:
                count(argument)

    for result in results:
        count(result)
    lines: list[str] = []
    texts = dict(names)

    def text(node: _Node) -> str:
        if node not in texts:
            written = _written(node, text, when)
            if uses[id(node)] > 1 and node.arguments and node.operation != "start":
                lines.append(f"    t{len(lines)} = {written}")
                written = f"t{len(lines) - 1}"
            texts[node] = written
        return texts[node]

    values = [text(result) for result in results]
    return "\n".join([f"def {head}:", *lines, f"    return ({items(values)})"])


def _written(node: _Node, text: Callable[[_Node], str], when: Callable[[_Node], int]) -> str:
    """Return the source of an expression; every number is written as a float, so that Numba sees one type."""
    if node.operation in ("variable", "parameter"):
        return f"{'y' if node.operation == 'variable' else 'p'}[{node.value}]"
    if node.operation == "number":
        return f"({float(node.value)!r})" if node.value < 0 else repr(float(node.value))
    if node.operation == "sum":
        terms = sorted(_terms(node), key=lambda term: when(term[1]))
        # A leading minus costs a negation: among the terms known first, put a positive one in front.
        first = next((term for term in terms if term[0] > 0 and when(term[1]) == when(terms[0][1])), terms[0])
        terms.remove(first)
        rest = "".join(f" {'+' if sign > 0 else '-'} {text(term)}" for sign, term in terms)
        return f"({'' if first[0] > 0 else '-'}{text(first[1])}{rest})"
    arguments = [text(argument) for argument in node.arguments]
    if node.operation in ("start", "carried"):
        return arguments[0]
    if node.operation in FUNCTIONS:
        return f"{node.operation}({', '.join(arguments)})"
    if node.operation == "negative":
        return f"(-{arguments[0]})"
    sign = "*" if node.operation == "scaled" else node.operation
    return f"({arguments[0]} {sign} {arguments[1]})"
