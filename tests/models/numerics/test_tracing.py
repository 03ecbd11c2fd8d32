"""Traced fields: the derived code equals the field exactly, and untraceable fields are refused."""

import math
from fractions import Fraction

import numpy as np
import sympy
from pytest import approx, mark, raises

from hess_mechanics import systems
from hess_mechanics.chaplygin_ball import phase_cloud_kernels
from hess_mechanics.numerics import functions
from hess_mechanics.numerics.expressions import FUNCTIONS, NotTraceable
from hess_mechanics.numerics.taylor_kernels import columns_of
from hess_mechanics.numerics.tracing import constant, derivative, trace
from hess_mechanics.numerics.variation_kernels import variation
from hess_mechanics.suslov import free_kernels
from hess_mechanics.suslov_hess import circle_map_kernels
from hess_mechanics.suslov_hess.equations import WITH_ATTITUDE
from oracle import uncompiled

FIELDS = {
    **{name: (system.field, len(system.variables), len(system.parameters)) for name, system in systems().items()},
    "hess-attitude": (WITH_ATTITUDE.field, 8, 2),
    "circle map": (circle_map_kernels.field, 9, 2),
    "free passage": (free_kernels.field, 8, 2),
    "phase cloud": (phase_cloud_kernels.field, 5, 6),
    # Its constant term is a parameter, as in no field of the paper.
    "roessler": (lambda y, p: (-y[1] - y[2], y[0] + p[0] * y[1], p[1] + y[2] * (y[0] - p[2])), 3, 3),
}


def expanded(recursion, y, p, order, number=float):
    """Taylor coefficients (order + 1, d) and what is observed (order, n), by the derived source, uncompiled.

    number : the kind of y, from a text.
    """
    functions, zero, columns = uncompiled(recursion, number), number("0"), columns_of(recursion)
    c, left, right = (np.full((order + 1, n), zero, dtype=object) for n in (len(y), columns, columns))
    c[0] = y
    inverses = np.array([1 / (zero + k + 1) for k in range(order)], dtype=object)
    seen = np.full((order, recursion.outputs), zero, dtype=object)
    functions["expand"](c, left, right, inverses, p, seen)
    return c, seen


@mark.parametrize(("field", "variables", "parameters"), FIELDS.values(), ids=FIELDS)
def test_what_is_derived_from_a_field_is_the_field(field, variables, parameters):
    """Products and linear terms reproduce the field, as rational functions of all symbols."""
    y, p = sympy.symbols(f"y:{variables}"), sympy.symbols(f"p:{parameters}")
    found = expanded(trace(field, variables, parameters), y, p, 1, sympy.Rational)[0][1]
    for one, rate in zip(found, field(y, p), strict=True):
        assert sympy.cancel(one - rate) == 0


def derivatives(field, y, p, order):
    """y^(k)/k! by differentiating the field symbolically along itself, exactly."""
    names = sympy.symbols(f"y:{len(y)}")
    rates = [sympy.sympify(rate) for rate in field(names, p)]
    values, current = [list(y)], list(names)
    for k in range(1, order + 1):
        current = [sum(sympy.diff(x, name) * rate for name, rate in zip(names, rates, strict=True)) for x in current]
        values.append([x.subs(dict(zip(names, y, strict=True))) / sympy.factorial(k) for x in current])
    return values


def test_a_constant_of_the_motion_is_taken_for_the_whole_step():
    # ẋ = −y, ẏ = x at the rate x² + y², which stays.
    def plain(y, p):
        r = constant(y[0] ** 2 + y[1] ** 2)
        return -r * y[1], r * y[0]

    recursion = trace(plain, 2, 0)
    assert (recursion.constants, recursion.pairs, recursion.stages) == (1, (), ())
    found, _ = expanded(recursion, [Fraction(3), Fraction(1)], [], 3, Fraction)
    assert found[1].tolist() == [-10, 30]
    assert found[2].tolist() == [-150, -50]
    assert constant(2.5) == 2.5


REFUSED = {
    "complex": (lambda y, p: (y[0] * 1j, y[1]), r"cannot be traced: .*Use \+, −, \*, /"),
    "division by 0": (lambda y, p: (y[0] / 0, y[1]), "cannot be traced: .*divides by the number 0"),
    "text": (lambda y, p: (y[0] / (p[0] - p[0] * 1 + y[0] * 0), "y"), "cannot be traced: "),
    "missing variable": (lambda y, p: (y[0], y[5]), "reads beyond its 2 variables.*count the indices from 0"),
    "three rates": (lambda y, p: (y[0],) * 3, "2 variables and returns 3 rates: return one for each"),
    "condition": (
        lambda y, p: (np.where(y[0] > 0, 1.0, 2.0), y[1]),
        "without conditions.*find the event with `section",
    ),
    "function of floats": (lambda y, p: (math.sin(y[0]), y[1]), "takes floats only"),
}


@mark.parametrize(("field", "message"), REFUSED.values(), ids=REFUSED)
def test_a_field_that_cannot_be_traced_is_refused(field, message):
    with raises(NotTraceable, match=message):
        trace(field, 2, 1)


# Fields of x, z and a parameter 1/2, for which every function is defined near (1/3, 1/5).
FUNCTIONS_OF_FIELDS = {
    **{
        name: lambda y, p, name=name: (getattr(functions, name)(y[0] * y[1] + p[0]), y[0] - y[1] ** 2)
        for name in sorted({*FUNCTIONS} - {"atan2", "pow"})
    },
    "atan2": lambda y, p: (functions.atan2(y[0] - y[1], y[0] + p[0] * y[1]), functions.atan2(y[1], p[0])),
    "square root of a variable": lambda y, p: (functions.sqrt(y[0]) * y[1], p[0] / functions.sqrt(y[1])),
    "cube of a root": lambda y, p: (y[1] / functions.sqrt(y[0] ** 2 + y[1] ** 2) ** 3, functions.sqrt(y[0]) ** 2),
    "sums and products": lambda y, p: ((y[0] - 3 * p[0]) * (y[1] + 2) - y[0] / 4, -y[0] * (y[1] + 1) * y[1] * p[0]),
    "whole powers": lambda y, p: ((y[0] + y[1]) ** 3 - y[1] ** 2, (p[0] - y[0] * y[1]) ** 2),
    "quotients": lambda y, p: (y[0] / (y[1] * y[1] + p[0] + 2) - 1 / y[0], (y[1] - 2) / (1 + y[0]) / y[1]),
    "power": lambda y, p: (y[0] ** 1.25, (y[0] + y[1]) ** p[0]),
    "negative power": lambda y, p: (y[0] ** -0.5, y[1] / (y[0] + y[1]) ** 1.5),
    "exponent": lambda y, p: (2 ** y[0], y[0] ** y[1]),
    "of parameters": lambda y, p: (functions.sin(p[0]) * y[1], functions.exp(p[0] / 3) + y[0] / functions.log(p[0])),
    "of constants": lambda y, p: (functions.cos(constant(p[0] + 0 * y[0])) * y[1], functions.sin(y[0])),
    "of functions": lambda y, p: (functions.sin(functions.exp(y[0] * y[1])), functions.log(1 + functions.cos(y[1]))),
}


def observed_jacobian(field, y, p, number=float):
    """The Jacobian matrix that is observed along the field, its divergence, and the `Variation`."""
    of, n = variation(field, len(y), len(p)), len(y)
    _, seen = expanded(of.recursion, y, p, 1, number)
    found = np.full((n, n), number("0"), dtype=object)
    for place, value in zip((*of.state_entries, *of.constant_entries), seen[0], strict=False):
        found[place] = value
    return found, seen[0, of.recursion.observables - 1], of


@mark.parametrize("field", FUNCTIONS_OF_FIELDS.values(), ids=FUNCTIONS_OF_FIELDS)
def test_functions_have_their_taylor_series_and_derivatives(field):
    y, p = [sympy.Rational(1, 3), sympy.Rational(1, 5)], [sympy.Rational(1, 2)]
    floats = [float(x) for x in y], [float(x) for x in p]
    found, _ = expanded(trace(field, 2, 1), *floats, 4)
    expected = np.array(derivatives(field, y, p, 4)).astype(float)
    assert found.astype(float) == approx(expected, rel=1e-12, abs=1e-14)
    assert field(*floats) == approx(tuple(expected[1]))
    names = sympy.symbols("y:2")
    slopes, divergence, of = observed_jacobian(field, *floats)
    exact = sympy.Matrix([sympy.sympify(rate) for rate in field(names, p)]).jacobian(names)
    here = np.array(exact.subs(dict(zip(names, y, strict=True)))).astype(float)
    assert slopes.astype(float) == approx(here, rel=1e-12)
    assert divergence == approx(np.trace(here), rel=1e-12)
    # A constant entry has no second derivatives.
    assert all(not exact[place].free_symbols for place in of.constant_entries)


def test_arrays_of_symbols_are_fields_too():
    turn = np.array([[0.0, 1.0], [-2.0, 0.5]])

    def field(y, p):
        return turn @ np.array(y) + np.sin(np.array(y)) - np.float64(2.0) * np.arctan2(y[0], 1.0) * np.ones(2)

    found, _ = expanded(trace(field, 2, 0), [0.3, 0.4], [], 1)
    assert found[1].astype(float) == approx(field([0.3, 0.4], []))


def test_a_derivative_of_what_is_no_symbol_is_none():
    def field(y, p):
        assert derivative(3.0, y[0]) == 0
        assert derivative(p[0] * y[1], y[0]) == 0
        return y[1] / (1 + y[0] ** 2), -(y[0] ** 3), derivative(y[0] ** 3, y[0])

    found = trace(field, 2, 1, observables=1)
    assert found.observables == 1
    with raises(NotTraceable, match="2 variables and returns 1 rates"):
        trace(lambda y, p: (y[0], 1.0), 2, 1, observables=1)
