"""The two regular cases of the ball with a field: their proofs, symbolically, and their motions, numerically."""

import numpy as np
import sympy
from pytest import approx, mark

from hess_mechanics import level, solve
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import area_integral, period
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.suslov.kharlamova import PlaneBody, arc, mirror_image
from support.refusals import refused

STATE = sympy.symbols("w1 w2 g1 g2 g3", real=True)
I11, I22, D = sympy.symbols("I11 I22 D", positive=True)
U = sympy.Function("U")


def rates(torque, inertia):
    """`eq29` for I13 = I23 = 0 as the paper writes it, Î a matrix, with this torque."""
    w1, w2, g1, g2, g3 = STATE
    matrix = sympy.diag(inertia[0] + D * (g2**2 + g3**2), inertia[1] + D * (g1**2 + g3**2))
    matrix[0, 1] = matrix[1, 0] = -D * g1 * g2
    first, second = matrix.LUsolve(sympy.Matrix(torque))
    return [first, second, -g3 * w2, g3 * w1, g1 * w2 - g2 * w1]


def test_the_reflection_reverses_every_motion_in_a_potential_of_gamma1_and_gamma2():
    g1, g2, g3 = STATE[2:]
    potential = U(g1, g2)
    torque = (-g3 * potential.diff(g2), g3 * potential.diff(g1))
    field = sympy.Matrix(rates(torque, (I11, I22)))
    R = sympy.diag(1, 1, 1, 1, -1)
    assert sympy.simplify(field.subs(g3, -g3) + R * field) == sympy.zeros(5, 1)
    # Not with a part along e3, nor with I13.
    w1, w2 = STATE[:2]
    for more in ((g2, -g1), (-w2 * w1, w1 * w1)):
        other = sympy.Matrix(rates((torque[0] + more[0], torque[1] + more[1]), (I11, I22)))
        assert sympy.simplify(other.subs(g3, -g3) + R * other) != sympy.zeros(5, 1)


def test_of_equal_moments_the_area_integral_is_conserved_in_every_potential_of_gamma3():
    g1, g2, g3 = STATE[2:]
    slope = U(g3).diff(g3)
    field = rates((slope * g2, -slope * g1), (I11, I11))
    area = area_integral(np.array(STATE)).item()
    assert sympy.simplify(sum(area.diff(x) * rate for x, rate in zip(STATE, field, strict=True))) == 0
    other = rates((slope * g2, -slope * g1), (I11, I22))
    assert sympy.simplify(sum(area.diff(x) * rate for x, rate in zip(STATE, other, strict=True))) != 0


# ---- the period -------------------------------------------------------------------------------------------------


@mark.parametrize("name", LEVELS)
@mark.parametrize("start", [(0.3, 1.4, 0.8, 0.0, -0.6), (2.0, 0.1, 0.6, 0.8, 0.0)])
def test_without_an_inner_ball_it_is_kharlamovas_closed_form(name, start):
    body = BallBody(1.3, 0.8, 0.0, 0.0, 0.0, 0.5, -0.2, 0.0)
    found = period(body, start, name)
    exact = arc(PlaneBody(1.3, 0.8, 0.5, -0.2), start).period
    assert found.value == approx(exact, abs=max(1e-12, 10.0 * level(name).promise))
    assert abs(found.value - exact) <= 10.0 * found.error_estimate


@mark.parametrize(
    "body",
    [
        BallBody(1.0, 2.0, 0.0, 0.0, 1.0, 1.0, 0.5, 0.0),
        BallBody(2.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0),
    ],
    ids=str,
)
def test_after_a_period_a_motion_is_where_it_began_and_at_half_of_it_is_reflected(body):
    start = np.array([0.9, -0.7, 0.48, 0.6, 0.64])
    found = period(body, start, "reference")
    first = found.crossings[0]
    times = [first, found.value, found.value + 2.0 * first]
    crossing, after, _ = solve(body, start, times, "reference").states
    assert abs(crossing[4]) <= 1e-11
    assert after == approx(start, abs=1e-9)
    # About a crossing the motion is its own mirror image.
    at = np.array([0.3, 0.7])
    before, later = (solve(body, crossing, sign * at, "reference").states for sign in (-1, 1))
    assert before == approx(mirror_image(later), abs=1e-10)


def period_of(I13=0.0, b3=0.0, start=(1.0, 0.2, 0.6, 0.0, 0.8)):
    return period(BallBody(1.0, 2.0, I13, 0.0, 1.0, 1.0, 0.5, b3), start, "standard")


test_what_has_no_period_is_refused = refused(
    (lambda: period_of(b3=0.1), "b3 = 0"),
    (lambda: period_of(I13=0.1), "I13 = I23 = 0"),
    (lambda: period_of(start=(0.6, 0.8, 0.6, 0.8, 0.0)), "does not cross"),
)
