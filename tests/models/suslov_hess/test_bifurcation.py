"""The region of (h, f), its edge, and the turning points, against multiple precision."""

from functools import cache
from math import copysign, cos, log10, nan, pi, sin, sqrt

import mpmath
import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from pytest import approx, mark

from hess_mechanics import curve, curve_point, f_max, systems, turning_points
from hess_mechanics.errors import OutsideRegion, Separatrix
from hess_mechanics.suslov_hess.bifurcation import h_min
from oracle import turning_roots
from support.refusals import refused

ULP = 2.0**-52

# h in the whole region, crowded where the formulas could lose digits: at the bottom −1 and at the separatrix 1.
tiny = st.floats(-15.0, -1.0).map(lambda exponent: 10.0**exponent)
energies = st.one_of(
    st.floats(-0.999999, 50.0),
    tiny.map(lambda e: -1 + e),
    tiny.map(lambda e: 1 - e),
    tiny.map(lambda e: 1 + e),
    st.floats(0.0, 8.0).map(lambda exponent: 10.0**exponent),
)
# f/f_max: anything, next to 0, next to the edge, the edge itself.
shares = st.one_of(
    st.floats(-1.0, 1.0), st.floats(-140.0, -1.0).map(lambda e: 10.0**e), tiny.map(lambda e: 1 - e), st.just(1.0)
)
# f² must not underflow; f = 0 at h = 1 is the separatrix.
tori = st.tuples(energies, shares).filter(lambda t: abs(t[1]) > 1e-140 or (t[1] == 0 and t[0] != 1.0))

CASES = [
    (0.3, 1e-300),
    (2.0, 0.0),
    (1.0, 1e-100),
    (1 - 2**-53, 1e-20),
    (-1 + 1e-12, 1e-13),
    (-1 + 2**-53, 0.0),
    (1e8, 1e-5),
]


def digits(h, f):
    """Digits that leave 40 after every cancellation in the cubic."""
    small = sum(max(0, int(-log10(abs(value)))) for value in (f, f, f, f, h) if value)
    return 60 + int(6 * log10(abs(h) + 10)) + small


@cache
def exact(h, f):
    """The roots of the cubic with exactly these doubles h and f, |w|², 1 − n1² and the period."""
    with mpmath.workdps(digits(h, f)):
        h, f = mpmath.mpf(h), mpmath.mpf(f)
        return values_of(h, *turning_roots(h, f))


def values_of(h, n0, n1, n2):
    """Return what the turning points should be, by the roots n0 < n1 ≤ n2; the period is an elliptic integral."""
    return {
        "n0": n0,
        "n1": n1,
        "n2": n2,
        "w_squared": 2 * (h + n1),
        "sine_squared": (1 - n1) * (1 + n1),
        "period": 2 * mpmath.sqrt(2 / (n2 - n0)) * mpmath.ellipk((n2 - n1) / (n2 - n0)),
    }


@cache
def edge(h):
    """Return the largest f and the values there: n3 > 0 with 3n² + 2hn = 1, without cancellation."""
    with mpmath.workdps(60 + int(6 * log10(abs(h) + 10))):
        h = mpmath.mpf(h)
        root = mpmath.sqrt(h * h + 3)
        n = 1 / (h + root) if h > 0 else (root - h) / 3
        return mpmath.sqrt(2 * (h + n) * (1 - n * n)), values_of(h, -h - 2 * n, n, n)


def check_against_multiple_precision(h, f):
    found = turning_points(h, f)
    largest, on_the_edge = edge(h)
    oracle = [on_the_edge, exact(h, f * (1 - 4 * ULP))]
    if abs(f) < largest:
        # No double knows better than two units in the last place of f.
        near = [f * (1 + k * ULP) for k in (-2, 0, 2)]
        oracle = [exact(h, one) if abs(one) < largest else on_the_edge for one in near]
    for i, name in enumerate(oracle[0]):
        value = found.roots[i] if i < 3 else getattr(found, name)
        low, high = min(each[name] for each in oracle), max(each[name] for each in oracle)
        # Roots to absolute accuracy; what may be small by itself to relative accuracy.
        slack = 1e-15 * max(1.0, abs(float(low))) if name.startswith("n") else 1e-13 * abs(float(high)) + 1e-300
        assert float(low) - slack <= value <= float(high) + slack, (name, value, float(low), float(high))
    return found


@given(energies)
def test_the_largest_f_is_that_of_multiple_precision(h):
    assert f_max(h) == approx(float(edge(h)[0]), rel=2e-15)


@mark.parametrize(("h", "f"), CASES)
def test_turning_points_at_special_places_keep_their_relative_accuracy(h, f):
    check_against_multiple_precision(h, f)


@given(tori)
def test_turning_points_and_the_period_keep_their_accuracy_everywhere(torus):
    h, share = torus
    check_against_multiple_precision(h, share * f_max(h))


@given(tori, st.floats(-pi, pi))
@example((0.5, 0.0), 0.7)
def test_the_state_at_the_lower_turn_is_on_the_torus_and_turns_there(torus, phi):
    h, share = torus
    f = share * f_max(h)
    turning = turning_points(h, f)
    y = turning.state_at_lower_turn(phi)
    hess = systems()["hess"]
    found = hess.integrals(y, (0.7, 1.0))
    assert found["E"] == approx(h, abs=1e-15 * (abs(h) + 10))
    assert found["F2"] == approx(f, rel=1e-6 if abs(share) > 0.999 else 1e-13, abs=1e-300)
    assert hess.field(y, (0.7, 1.0))[4] == approx(0.0, abs=1e-15 * (1 + turning.initial_rho))
    assert y[4] == turning.roots[1] <= turning.roots[2]
    direction = np.array([sin(phi), cos(phi)])
    assert y[:2] == approx(sqrt(turning.w_squared) * direction, rel=1e-14, abs=1e-300)
    # At f = 0 it is the limit from above.
    assert y[2:4] == approx(copysign(sqrt(turning.sine_squared), f) * direction, rel=1e-14, abs=1e-300)


@given(st.floats(0.0, 1.0, exclude_min=True).filter(lambda n: n > 1e-6))
def test_points_of_the_curve_are_where_the_cubic_has_a_double_root(n):
    h, f = curve_point(n)
    size = abs(h) + 1
    assert 2 * (h + n) * (1 - n * n) - f * f == approx(0.0, abs=1e-14 * size)  # p(n) = 0
    assert 2 * (1 - n * n) - 4 * n * (h + n) == approx(0.0, abs=1e-14 * size)  # p'(n) = 0
    assert f >= 0


def test_a_curve_begins_at_the_bottom_and_ends_at_its_energy():
    points = curve(4.0, points=300)
    assert points.shape == (300, 2)
    assert points[[0, -1]] == approx(np.array([(-1.0, 0.0), (4.0, f_max(4.0))]), abs=1e-12)
    assert np.all(np.diff(points, axis=0) > 0)
    assert points[1:, 1] == approx([f_max(h) for h in points[1:, 0]], rel=1e-11)


test_values_without_a_torus_or_an_edge_raise_a_sentence = refused(
    (lambda: turning_points(-1.0, 0.0), "choose h > −1", OutsideRegion),
    (lambda: turning_points(0.0, 0.9), r"choose \|f\| ≤ 0.87738267", OutsideRegion),
    (lambda: turning_points(1.0, 1e-300), "no return. Move h or f a little", Separatrix),
    (lambda: turning_points(nan, 0.0), "h is not a finite number"),
    (lambda: turning_points(1e13, 0.0), "choose h ≤ 1e12"),
    (lambda: f_max(-1.0), "h", OutsideRegion),
)


def test_the_least_energy_is_where_f_is_the_largest():
    assert h_min(0.0) == approx(-1.0, abs=1e-12)
    for f in (1e-6, -0.3, 17.0):
        assert f_max(h_min(f)) == approx(abs(f), rel=1e-9)
