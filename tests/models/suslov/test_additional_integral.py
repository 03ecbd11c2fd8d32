"""The additional integral F2 for odd k, exact and in double precision."""

import math
from dataclasses import replace
from fractions import Fraction
from itertools import product

import numpy as np
import sympy
from pytest import approx, mark

from hess_mechanics import SuslovBody, systems
from hess_mechanics.suslov.additional_integral import I11_of, additional_integral, coefficients, integral_of, order
from support.refusals import refused
from support.thorough import sample

SUSLOV = systems()["suslov"]
every_k = mark.parametrize("k", sample(range(1, 16, 2), 4))


def case_1(k, I22=1.0, I23=0.4):
    return SuslovBody(I11_of(k, I22, I23), I22, 0.0, I23)


def case_2(k, I11=1.0, I13=0.4):
    return SuslovBody(I11, I11_of(k, I11, I13), I13, 0.0)


both_cases = mark.parametrize("case", [case_1, case_2], ids=["I13 = 0", "I23 = 0"])


def vector(exact, w1, w2):
    """Evaluate V(ω) from the coefficients, in the arithmetic of ω."""
    k, n = exact.k, len(exact.a)
    return (
        sum(exact.a[j] * w1 ** (k - 2 * j) * w2 ** (2 * j) for j in range(n)),
        sum(exact.b[j] * w1 ** (k - 1 - 2 * j) * w2 ** (2 * j + 1) for j in range(n)),
        sum(exact.c[j] * w1 ** (k - 1 - 2 * j) * w2 ** (2 * j + 1) for j in range(n)),
    )


@every_k
@mark.parametrize(("I22", "I23"), [(Fraction(1), Fraction(2, 5)), (Fraction(7, 3), Fraction(-5, 2))])
def test_F2_is_conserved_exactly(k, I22, I23):
    # dF2/dt is a polynomial in ω, and vanishes.
    exact = coefficients(k, I22, I23)
    assert exact.remainder == 0
    I11 = I22 + k * k * I23**2 / I22
    w1, w2 = sympy.symbols("w1 w2")
    V = sympy.Matrix([sympy.nsimplify(v) for v in vector(exact, w1, w2)])
    first, second = sympy.nsimplify(I23 / I11), sympy.nsimplify(I23 / I22)
    rate = -first * w2**2 * V.diff(w1) + second * w1 * w2 * V.diff(w2) - V.cross(sympy.Matrix([w1, w2, 0]))
    assert len(rate) == 3
    assert all(sympy.Poly(one, w1, w2).is_zero for one in rate)


@both_cases
@mark.parametrize("k", [1, 3, 5])
def test_the_field_vanishes_on_the_levels_of_F2_that_the_paper_leaves_out_too(case, k):
    # Before `biz138` only f ≠ f⁺, f⁻ is asked for.  These are equal, and at (ω^(±), −γ^(±)), where the field vanishes
    # as well, F2 has the other sign: that level is no torus either.
    body, h = case(k), 0.7
    F2 = additional_integral(k, body)
    I11, I22, I13, I23, *_ = body.parameters
    omega = math.sqrt(2.0 * h / (I11 * I23**2 + I22 * I13**2)) * np.array([-I23, I13])
    xi = np.array([I23, -I13, 0.0]) / math.hypot(I13, I23)
    values = []
    for sign, turned in product((1, -1), repeat=2):
        state = np.array([*(sign * omega), *(turned * sign * xi)])
        assert SUSLOV.field(state, body.parameters) == approx(np.zeros(5), abs=1e-13)
        assert SUSLOV.integrals(state, body.parameters)["E"] == approx(h, rel=1e-13)
        values.append(float(F2(state[:2], state[2:])))
    assert abs(values[0]) > 0.1
    assert values == approx(values[0] * np.array([1, -1, 1, -1]), rel=1e-12)
    assert integral_of(body).at_fixed_points(h) == approx(values[0], rel=1e-12)


# ---- which bodies -----------------------------------------------------------------------------------------------


@every_k
@both_cases
def test_the_order_is_told_from_doubles(case, k):
    for size, ratio in product((1.0, 1e-6, 1e6), (0.03, 0.4, 0.77, -3.1, 50.0)):
        assert order(case(k, size, ratio * size)) == k
    changed = "I11" if case is case_1 else "I22"
    assert order(replace(case(k), **{changed: getattr(case(k), changed) + 1e-9})) is None


@mark.parametrize(
    "body",
    [
        SuslovBody(1.64, 1.0, 0.8, 0.8),
        SuslovBody(1.64, 1.0, 0.0, 0.8, b3=1.0),
        SuslovBody(3.56, 1.0, 0.0, 0.8),  # k = 2
        SuslovBody(0.8, 1.0, 0.0, 0.5),  # k² < 0
        SuslovBody(1.0, 1.0, 0.0, 1e-9),  # k cannot be told
        SuslovBody(1.0, 1.16, 0.0, 0.4),  # case 1 with 1 and 2 exchanged
    ],
)
def test_no_order(body):
    assert order(body) is None
    assert integral_of(body) is None


test_what_has_no_additional_integral_is_refused = refused(
    (lambda: I11_of(2, 1.0, 0.4), "odd k from 1 to 15"),
    (lambda: coefficients(3, Fraction(1), Fraction(0)), "a nonzero I23"),
    (lambda: additional_integral(3, SuslovBody(2.0, 1.0, 0.3, 0.4)), "exactly one of I13, I23 is 0"),
    (lambda: integral_of(case_1(3)).at_fixed_points(0.0), "choose h > 0"),
)
