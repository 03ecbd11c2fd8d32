"""Periodic orbits of maps with known ones: places, multipliers, types, errors, and messages where none is found."""

import math

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics.dynamics.periodic import find_periodic, kind_of
from hess_mechanics.errors import InvalidParameter, NotConverged
from support.maps import arnold, bent_saddle, delayed_logistic, henon


@mark.parametrize("a", [0.1, 0.9, 1.4])
def test_the_fixed_point_of_the_map_of_henon(a, b=0.3):
    # a x² + (1 − b) x − 1 = 0, λ² + 2 a x λ − b = 0.
    x = (-(1.0 - b) + math.sqrt((1.0 - b) ** 2 + 4.0 * a)) / (2.0 * a)
    found = find_periodic(henon(a, b), (0.6, 0.2), 1)
    exact = sorted((-a * x + sign * math.sqrt(a * a * x * x + b) for sign in (1, -1)), key=abs, reverse=True)
    assert np.abs(found.multipliers - exact).max() < 1e-13
    assert np.abs(found.points[0] - (x, b * x)).max() <= found.error_estimate < 1e-14
    assert found.kind == ("stable node" if a < 0.3675 else "saddle with reflection")
    assert found.period == 1
    assert not found.points.flags.writeable


def test_an_orbit_of_period_two_is_known_too(a=0.8, b=0.3):
    # The two places are the roots of a² x² − a(1 − b) x + (1 − b)² − a = 0, and tr M = 4 a² x₁x₂ + 2b.
    found = find_periodic(henon(a, b), (1.0, 0.0), 2)
    s, p = (1.0 - b) / a, ((1.0 - b) ** 2 - a) / a**2
    half = math.sqrt(s * s / 4 - p)
    assert sorted(found.points[:, 0]) == approx([s / 2 - half, s / 2 + half])
    assert found.multipliers.sum() == approx(4.0 * a * a * p + 2.0 * b, abs=1e-13)
    assert found.multipliers.prod() == approx(b * b, abs=1e-14)
    assert found.period == 2


def test_the_multipliers_of_a_long_unstable_orbit_keep_the_small_one(a=1.4, b=0.3):
    found = find_periodic(henon(a, b), (0.6, 0.2), 12)
    assert found.period == 12
    # The product of the multipliers is (−b)^12, beside which the trace is 10⁹ times as large.
    assert abs(found.multipliers.prod() / b**12 - 1.0) < 1e-12
    x, y = found.points.T
    assert np.abs(np.roll(x, -1) - (1.0 - a * x * x + y)).max() < 1e-13
    assert np.abs(np.roll(y, -1) - b * x).max() < 1e-13
    assert found.kind.startswith("saddle")


def test_the_period_is_found_where_none_is_given():
    # At a = 0.95 the attractor of the map of Hénon with b = 0.3 has the period 4.
    place = np.array([0.0, 0.0])
    for _ in range(2000):
        place = henon(0.95).image(place)
    found = find_periodic(henon(0.95), place)
    assert found.period == 4
    assert np.abs(found.points - place).max(axis=1).min() < 1e-9
    assert np.all(np.abs(found.multipliers) < 1.0)


def test_near_looks_from_the_place_alone():
    # From there Newton's method comes to the fixed point; later the orbit comes close to one of period 4.
    m, place = henon(0.95), (0.3, 0.05)
    found = find_periodic(m, place, 4)
    assert found.period == 4
    with raises(NotConverged, match="period 1 but none of period 4"):
        find_periodic(m, place, 4, near=True)
    again = find_periodic(m, found.points[0] + 1e-3, 4, near=True)
    assert np.abs(again.points - found.points).max() < 1e-12


@mark.parametrize(
    ("map_", "place", "kind"),
    [
        (delayed_logistic(1.5), (0.3, 0.3), "stable focus"),
        (delayed_logistic(2.1), (0.5, 0.5), "unstable focus"),
        (delayed_logistic(2.0), (0.5, 0.4), "elliptic"),
        (bent_saddle(), (0.1, 0.2), "saddle"),
        (arnold(0.1), (0.3,), "stable node"),
        (arnold(0.1), (2.9,), "unstable node"),
    ],
)
def test_types(map_, place, kind):
    assert find_periodic(map_, place, 1).kind == kind


def test_multipliers_of_1_have_types_of_their_own():
    assert kind_of(np.array([1.0 + 1e-9, 0.5]), 1e-8) == "parabolic"
    assert kind_of(np.array([-1.0, 0.5]), 1e-8) == "parabolic with reflection"


def test_what_is_not_there_is_refused_with_what_to_do():
    with raises(NotConverged, match=r"period 2.*start closer"):
        find_periodic(henon(0.1), (0.6, 0.2), 2)
    with raises(NotConverged, match="start closer"):
        find_periodic(arnold(1.5), (0.3,), 1)
    with raises(InvalidParameter, match="give 2 finite numbers, x, y"):
        find_periodic(henon(0.1), (0.6, math.nan))
