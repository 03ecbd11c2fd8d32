"""The circle map of the torus: against brute force, closed forms and its symmetries."""

from math import cos, cosh, exp, hypot, pi, remainder, sin, sqrt

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from pytest import approx, mark

from hess_mechanics import (
    circle_map,
    critical_a,
    curve_point,
    f_max,
    level,
    rotation_numbers,
    turning_points,
)
from hess_mechanics.errors import Separatrix, WorkLimit
from hess_mechanics.suslov_hess.mode_locking import rotation_number_window
from support.mechanics import angle_between, followed
from support.refusals import refused


def lifted_return(a, h, f, phases):
    """The lifted Θ by brute force: n̈3 = ½ p'(n3) and φ̇ = −a|w| cos φ − f/|w|² over one n3-period.

    Nothing of `hess_mechanics.suslov_hess.circle_map` enters, and φ is never reduced modulo 2π.
    """
    turning = turning_points(h, f)
    phases = np.asarray(phases, float)

    def rates(_, y):
        n, speed, phi = y[0], y[1], y[2:]
        w_squared = 2 * (h + n)
        return np.concatenate(
            ([speed, 1 - n * n - 2 * n * (h + n)], -a * np.sqrt(w_squared) * np.cos(phi) - f / w_squared)
        )

    start = np.concatenate(([turning.roots[1], 0.0], phases))
    return followed(rates, start, [turning.period], 1e-12, 1e-12)[0, 2:]


REFERENCE, STANDARD, DRAFT = level("reference"), level("standard"), level("draft")
PHASES = np.linspace(-3.0, 3.0, 13)

# (a, h, f): both sides of h = 1, both signs of f, elliptic and hyperbolic, near the bottom, near the edge.
TORI = [
    (0.5, 1.5, 0.6),
    (0.5, 0.5, 0.5),
    (1.0, 0.0, -0.5),
    (0.2, 2.5, -1.8),
    (0.8, -0.9, 0.05),
    (0.7, 1.02, 0.03),
    (2.0, 0.4, 0.2),
    (0.0, 0.7, 0.4),
    (-0.6, 1.3, 0.5),
]

# a up to 3, h in (−1, 50], f/f_max in [−1, 1]; never so near to the separatrix that a double cannot tell.
tori = st.tuples(
    st.floats(0.0, 3.0), st.floats(-0.999, 50.0), st.one_of(st.floats(-1.0, 1.0), st.floats(-1e-3, 1e-3), st.just(0.0))
).filter(lambda torus: abs(torus[1] - 1.0) > 1e-3 or abs(torus[2]) > 1e-3)


def stretch(found):
    """The steepest slope of Θ, (|α| + |β|)²."""
    re, im, im_beta = found.matrix
    return (hypot(re, im) + abs(im_beta)) ** 2 * exp(2 * found.log_scale)


def round_off(found):
    """Bound the effect of round-off on Θ."""
    return 1e-14 * (1 + stretch(found))


# ---- closed forms -----------------------------------------------------------------------------------------------


@given(st.floats(0.0, 3.0), st.one_of(st.floats(0.01, 0.9999), st.floats(-9.0, -1.0).map(lambda e: 1 - 10.0**e)))
def test_on_the_bifurcation_curve_trace_and_rotation_number_have_closed_forms(a, n):
    # There w turns at a constant rate, and Θ is its rotation through one (limiting) period of n3.
    h, _ = curve_point(n)
    found = circle_map(a, h, f_max(h), REFERENCE)
    radicand = (n * n * (1 + a * a) - a * a) / (1 + 3 * n * n)
    closed = 2.0 * (cos if radicand >= 0.0 else cosh)(pi * sqrt(abs(radicand)))
    assert found.trace == approx(abs(closed), rel=1e-11, abs=1e-11 / (1 - n))
    if abs(abs(closed) - 2) > 1e-6:
        assert found.rotation_number == approx(-sqrt(max(0.0, radicand)), abs=1e-8)


@mark.parametrize("a", [0.0, 0.1, 2.0])
@mark.parametrize("h", [1.001, 4.0, 1e5])
def test_as_f_vanishes_above_the_separatrix_the_multiplier_is_that_of_a_great_circle(a, h):
    for f, slack in ((0.0, 1e-12), (1e-12, 1e-7)):
        found = circle_map(a, h, f, REFERENCE)
        assert found.trace == approx(2 * cosh(pi * a), rel=slack)
        if a:
            stable, unstable = found.fixed_points
            assert unstable.multiplier == approx(exp(2 * pi * a), rel=10 * slack)
            assert stable.multiplier == approx(exp(-2 * pi * a), rel=10 * slack)
        assert found.rotation_number == (0.0 if a else approx(0.0, abs=1e-6))


@mark.parametrize("a", [0.0, 0.1, 2.0])
@mark.parametrize("h", [-1 + 2**-53, -0.6, 0.999])
def test_as_f_vanishes_below_the_separatrix_two_returns_are_the_identity(a, h):
    for f in (0.0, -0.0, 1e-12 * f_max(h)):
        found = circle_map(a, h, f, REFERENCE)
        assert found.trace < (1e-12 if f == 0 else 1e-6)
        assert found.kind == "elliptic"
        assert found.rotation_number == approx(-0.5, abs=1e-6)
        assert angle_between(found.theta(found.theta(PHASES)), PHASES) < (round_off(found) if f == 0 else 1e-3)


# ---- structure --------------------------------------------------------------------------------------------------


@given(tori)
def test_fixed_points_are_fixed_with_the_multiplier_that_a_difference_quotient_has(torus):
    a, h, share = torus
    found = circle_map(a, h, share * f_max(h), REFERENCE)
    assert len(found.fixed_points) == {"elliptic": 0, "parabolic": len(found.fixed_points), "hyperbolic": 2}[found.kind]
    if found.kind != "hyperbolic":
        return
    stable, unstable = found.fixed_points
    assert (stable.stable, unstable.stable) == (True, False)
    assert stable.phi == -unstable.phi
    assert stable.log_multiplier + unstable.log_multiplier == 0.0
    assert 2 * cosh(unstable.log_multiplier / 2) == approx(found.trace, rel=1e-11)
    assume(stretch(found) < 1e3)
    for point in found.fixed_points:
        assert angle_between(found.theta(point.phi), point.phi) < 10 * round_off(found)
        step = 1e-4 / stretch(found)
        ahead, behind = found.theta([point.phi + step, point.phi - step])
        quotient = remainder(ahead - behind, 2 * pi) / (2 * step)
        assert quotient == approx(point.multiplier, rel=1e-5, abs=1e-5)


# ---- rotation number --------------------------------------------------------------------------------------------


@mark.parametrize(("a", "h", "f"), TORI)
def test_the_rotation_number_is_the_mean_turn_of_the_integrated_lift(a, h, f):
    found = circle_map(a, h, f, REFERENCE)
    phases = np.linspace(-pi, pi, 801)
    turned = lifted_return(a, h, f, phases) - phases
    assert angle_between(found.theta(phases) - phases, turned) < 1e-7
    phi, iterations = 0.0, 5000
    for _ in range(iterations):
        phi += np.interp(remainder(phi, 2 * pi), phases, turned)
    # |F^N(φ) − φ − 2πNρ| < 2π for every lift of a circle map.
    assert abs(phi / (2 * pi * iterations) - found.rotation_number) < 1.1 / iterations


def test_a_window_is_filled_with_the_values_at_the_edge_of_the_region():
    window = rotation_number_window(0.5, (-1.0, 1.0), (-3.0, 3.0), STANDARD)
    n, m = window.shape
    H, F = np.meshgrid(-1.0 + (np.arange(m) + 0.5) * 2.0 / m, -3.0 + (np.arange(n) + 0.5) * 6.0 / n)
    edge = np.copysign([f_max(h) for h in H[0]], F)
    inside = np.abs(F) <= np.abs(edge)
    assert 0.1 < inside.mean() < 0.9
    found = rotation_numbers(0.5, H.ravel(), np.where(inside, F, (1.0 - 1e-12) * edge).ravel(), STANDARD)
    assert window.ravel() == approx(found.rho, abs=1e-5)


# ---- where the map locks ----------------------------------------------------------------------------------------


def test_exactly_on_the_lock_boundary_the_map_is_parabolic_with_one_fixed_point():
    found = circle_map(critical_a(0.6, 0.8, REFERENCE), 0.6, 0.8, REFERENCE)
    assert found.kind == "parabolic"
    (point,) = found.fixed_points
    # Two fixed points ±φ* have met: at 0 or at π.  Round-off leaves them √ε apart.
    assert abs(sin(point.phi)) < 1e-5
    assert point.log_multiplier == 0.0
    assert angle_between(found.theta(point.phi), point.phi) < 1e-6


# ---- what cannot be answered ------------------------------------------------------------------------------------


test_a_without_meaning_and_a_search_without_an_answer_raise_a_sentence = refused(
    (lambda: circle_map(1e7, 1.5, 0.6, DRAFT), "a = 1e\\+07 is too large"),
    # No map of rotation numbers hides such a torus.
    (lambda: rotation_number_window(1e6, (0.5, 1e8), (0.1, 1.0), DRAFT, (2, 2)), "choose a smaller \\|a\\|", WorkLimit),
    (lambda: critical_a(0.0, 1e-09, DRAFT), "no limit cycles appear"),
    (lambda: critical_a(1.0, 0.0, DRAFT), "no return", Separatrix),
)
