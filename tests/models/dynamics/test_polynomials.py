"""Polynomials with bounds, and dual numbers, over rational functions: exact values lie inside."""

from fractions import Fraction

import pytest

from hess_mechanics.dynamics.polynomials import Slope, TaylorModel
from hess_mechanics.numerics.balls import rational, working_precision

TERMS = 12


def formula(x, y):
    """With all operations that fields have."""
    return (2 - x * y) / (3 + x**2) - 5 / (y + 1) + (-x) * (y - 1) / 7


def value(coefficients, s):
    return sum(c * s**k for k, c in enumerate(coefficients))


def test_a_function_lies_within_the_bound_of_its_polynomial(delta=Fraction(1, 2)):
    x, y = [Fraction(1, 2), Fraction(1), Fraction(-2)], [Fraction(1), Fraction(1, 3), Fraction(1), Fraction(1, 4)]
    with working_precision(128) as library:
        arb = library.arb
        one, two = (
            TaylorModel(library.arb_poly([arb(rational(c)) for c in some]), arb(rational(delta)), TERMS)
            for some in (x, y)
        )
        found = formula(one, two)
        assert found.rest > 0
        # No wider than the terms that are left out, and so for the longer step.
        assert float(found.rest) < 100 * float(delta) ** TERMS * 2.0**TERMS
        for i in range(9):
            s = delta * i / 8
            away = found.polynomial(arb(rational(s))) - arb(rational(formula(value(x, s), value(y, s))))
            assert away.abs_lower() <= found.rest
        power = one**13
        assert len(power.polynomial) == 2 * TERMS
        away = power.polynomial(arb(rational(delta))) - arb(rational(value(x, delta) ** 13))
        assert away.abs_lower() <= power.rest


def test_a_divisor_that_may_vanish_is_refused():
    with working_precision(64) as library:
        arb = library.arb
        along = TaylorModel(library.arb_poly([arb(1), arb(-2)]), arb(1), TERMS)
        with pytest.raises(ZeroDivisionError):
            1 / along
        with pytest.raises(ZeroDivisionError):
            1 / Slope(arb(0, 1), [arb(1)])
