"""Derivation of the Taylor recursion of a vector field, written in Python as the paper prints it.

`trace` calls field(y, p) once with symbols that record the operations (`expressions`), and brings what they recorded
into the form of a recursion of Taylor coefficients (`recursions`).

Expressions in the parameters alone are computed once, and so is `constant(x)`, by which the author of a field declares
that x does not change along a motion.

A function of the state, such as u = sin x, becomes a further variable, whose rate is arithmetic again: u̇ = cos(x) ẋ.
Its value at the start of each step is computed by the function itself, so that it does not drift.  Hence kernels need
functions at order 0 only.

A field may use arithmetic and these functions, without conditions.  Its expressions can be differentiated
(`derivative`).  A field may return further expressions after its rates; their series are computed along with the
motion.

A step depends on two kinds of expressions whose effect the series of the state may not show.  exp(x) and tanh(x) are
constant in double precision where x is far from 0, and so are their series, whatever x does later: their arguments are
`watched`.  So are divisors: a quotient may be tiny where its divisor is large, and is regular where its numerator
vanishes with the divisor, although its series cannot start there.  A square root divides its own rate.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from hess_mechanics.numerics.expressions import ALLOWED, Node, NotTraceable, Symbol, Tape
from hess_mechanics.numerics.recursions import Recursion, Series, topological_order

__all__ = ["Field", "check", "constant", "derivative", "divergence", "expressions", "positive", "trace"]

_SATURATED = ("exp", "sinh", "cosh", "tanh")

Field = Callable[[Sequence[Any], Sequence[Any]], Sequence[Any]]
"""field(y, p) → ẏ in arithmetic and `FUNCTIONS`."""


def constant(x: Any) -> Any:
    """Return x and declare that it does not change along a motion.

    A traced field uses its value at the start of a step for the whole step.

    Parameters
    ----------
    x : object
        Expression of a field: a number, an array or a symbol.

    Returns
    -------
    object
        The same expression.
    """
    return x.at_start() if isinstance(x, Symbol) else x


def positive(x: Any) -> Any:
    """Return x and declare that it has no zero, so that a quotient by it is as regular as its series.

    Parameters
    ----------
    x : object
        Expression of a field: a number, an array or a symbol.

    Returns
    -------
    object
        The same expression.
    """
    return x.as_positive() if isinstance(x, Symbol) else x


def derivative(x: Any, y: Symbol) -> Any:
    """Return the derivative ∂x/∂y of an expression of a traced field.

    An expression that is constant along a motion (`constant`) still depends on the initial state.

    Parameters
    ----------
    x : object
        The expression.
    y : Symbol
        Variable of the field.

    Returns
    -------
    Symbol or int
        The derivative; the number 0 if x does not depend on y.
    """
    if not isinstance(x, Symbol):
        return 0
    node = x.tape.derivative(x.node, y.node)
    return 0 if node is x.tape.number(0) else Symbol(x.tape, node)


def trace(field: Field, variables: int, parameters: int, observables: int = 0) -> Recursion:
    """Return the Taylor recursion of a field.

    Parameters
    ----------
    field : Field
        The field.
    variables : int
        Number of variables y.
    parameters : int
        Number of parameters p.
    observables : int, default 0
        Number of expressions that the field returns after its rates.

    Returns
    -------
    Recursion
        The recursion.

    Raises
    ------
    NotTraceable
        If the field uses anything but arithmetic and `FUNCTIONS`, or returns another number of expressions.
    """
    tape, results = _record(field, variables, parameters, observables)
    functions = tape.functions(results, variables)
    watched = [(node.operation, node.arguments[0]) for node in functions if node.operation in _SATURATED]
    quotients = [
        node for node in topological_order(results[:variables]) if node.operation == "/" and node.arguments[1].moves
    ]
    divisors = [
        *(node.arguments[1] for node in quotients if node.arguments[1] not in tape.positive),
        *(node for node in functions if node.operation == "sqrt"),
    ]
    watched += [("/", node) for node in dict.fromkeys(divisors)]
    rates = [*results[:variables], *functions.values(), *results[variables:], *(node for _, node in watched)]
    kinds = tuple(kind for kind, _ in watched)
    plain = Series(tape, variables, [*functions], multiplies_out=True).recursion(rates, parameters, kinds)
    if not plain.stages:
        return plain
    return Series(tape, variables, [*functions], multiplies_out=False).recursion(rates, parameters, kinds)


def expressions(field: Field, variables: int, parameters: int) -> list[Node]:
    """Return the rates of a field, then those of its functions, as recorded.

    Parameters
    ----------
    field : Field
        The field.
    variables : int
        Number of variables y.
    parameters : int
        Number of parameters p.

    Returns
    -------
    list of Node
        The recorded expressions.

    Raises
    ------
    NotTraceable
        If the field cannot be traced.
    """
    tape, results = _record(field, variables, parameters, 0)
    return [*results, *tape.functions(results, variables).values()]


def divergence(field: Field, variables: int, parameters: int) -> Node:
    """Return the divergence of a field, as recorded.

    Parameters
    ----------
    field : Field
        The field.
    variables : int
        Number of variables y.
    parameters : int
        Number of parameters p.

    Returns
    -------
    Node
        The recorded expression.

    Raises
    ------
    NotTraceable
        If the field cannot be traced.
    """

    def with_divergence(y: Sequence[Any], p: Sequence[Any]) -> Sequence[Any]:
        rates = tuple(field(y, p))
        return *rates, sum(derivative(rate, x) for rate, x in zip(rates, y, strict=True))

    return _record(with_divergence, variables, parameters, 1)[1][-1]


def check(field: Field, variables: int, parameters: int) -> None:
    """Raise an error unless a field can be traced and returns one rate for each variable.

    Parameters
    ----------
    field : Field
        The field.
    variables : int
        Number of variables y.
    parameters : int
        Number of parameters p.

    Raises
    ------
    NotTraceable
        If the field cannot be traced.
    """
    _record(field, variables, parameters, 0)


def _record(field: Field, variables: int, parameters: int, observables: int) -> tuple[Tape, list[Node]]:
    """Return the tape of a field, and the nodes that it returns."""
    tape = Tape()
    y = tuple(Symbol(tape, tape.leaf("variable", i)) for i in range(variables))
    p = tuple(Symbol(tape, tape.leaf("parameter", i)) for i in range(parameters))
    try:
        results = field(y, p)
        if not hasattr(results, "__iter__"):
            raise NotTraceable(
                f"This field returns a {type(results).__name__}, not a sequence: return a rate for each variable."
            )
        rates = [tape.node_of(rate) for rate in results]
    except NotTraceable:
        raise
    except IndexError as error:
        raise NotTraceable(
            f"This field reads beyond its {variables} variables y[0], … or its {parameters} parameters p[0], …: count "
            "the indices from 0."
        ) from error
    except (TypeError, ValueError, AttributeError, ArithmeticError, LookupError) as error:
        raise NotTraceable(f"This field cannot be traced: {error}. {ALLOWED}") from error
    if len(rates) != variables + observables:
        raise NotTraceable(
            f"This field has {variables} variables and returns {len(rates) - observables} rates: return one for each."
        )
    return tape, rates
