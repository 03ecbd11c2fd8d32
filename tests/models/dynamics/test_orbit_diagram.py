"""Orbit diagrams of sections, and of maps with known periods, doublings and hysteresis."""

import math

import numpy as np
from pytest import approx, raises

from hess_mechanics import HeavyBody, SuslovBody, return_map
from hess_mechanics.dynamics.orbit_diagram import cascade, diagram_over, period_of
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.errors import InvalidParameter, WorkLimit
from support.maps import Formula, henon

B = 0.3


def bistable(r):
    """x′ = x + (r + x − x³)/5, y′ = y/2: two stable points between the folds at r = ±2/(3√3)."""
    return Formula(
        lambda x, y: (x + 0.2 * (r + x - x**3), 0.5 * y), lambda x, y: [[1.2 - 0.6 * x * x, 0.0], [0.0, 0.5]]
    )


def test_the_doublings_of_the_map_of_henon_are_its_own_and_their_ratios_tend_to_feigenbaums():
    found = cascade(henon, "a", find_periodic(henon(0.2), (0.6, 0.2), 1), 0.2, 1.3, 5)
    exact = [0.75 * (1 - B) ** 2, (1 - B) ** 2 + 0.25 * (1 + B) ** 2]
    assert found.periods.tolist() == [1, 2, 4, 8, 16]
    assert np.abs(found.values[:2] - exact).max() < 1e-13
    for value, places in zip(found.values, found.points, strict=True):
        M = np.eye(2)
        for x in places[:, 0]:
            M = np.array([[-2.0 * value * x, 1.0], [B, 0.0]]) @ M
        images = np.column_stack([1.0 - value * places[:, 0] ** 2 + places[:, 1], B * places[:, 0]])
        assert np.abs(images - np.roll(places, -1, axis=0)).max() < 1e-12
        assert np.linalg.eigvals(M).min() == approx(-1.0, abs=1e-8)
    assert np.all(found.ratio_errors < 1e-9)
    assert abs(found.ratios[-1] - 4.669201609) < abs(found.ratios[-2] - 4.669201609) < 0.2
    # The accumulation point is known: 1.058 (Derrida, Gervois and Pomeau 1979).
    assert found.limit == approx(1.058, abs=5e-4)
    short = cascade(henon, "a", find_periodic(henon(0.2), (0.6, 0.2), 1), 0.2, 0.9, 5)
    assert short.periods.tolist() == [1]
    assert short.end_reason.startswith("The orbit of period 2 keeps its period")
    assert math.isnan(short.limit)


def test_a_diagram_of_the_map_of_henon_has_its_periods():
    values = np.array([0.2, 0.36, 0.5, 0.9, 0.95, 1.02, 1.04, 1.4])
    found = diagram_over(henon, "a", values, (0.5, 0.1), transient=600)
    assert found.periods.tolist() == [1, 0, 2, 2, 4, 4, 8, 0]
    # The fixed point: a x² + (1 − b) x − 1 = 0.
    x = (math.sqrt((1 - B) ** 2 + 4 * 0.2) - (1 - B)) / 0.4
    assert np.abs(found.points[0] - (x, B * x)).max() < 1e-12
    assert np.array_equal(found.ends, [one[-1] for one in found.points])
    # Beyond its last attractor places run away: a gap.
    assert [len(one) for one in diagram_over(henon, "a", [1.4, 3.0, 0.2], (0.5, 0.1)).points] == [64, 0, 64]


def test_an_orbit_that_has_not_settled_says_so():
    plane, steps = (math.inf, math.inf), np.arange(60)
    turn = np.column_stack([np.cos(steps), np.sin(steps)])
    assert period_of(plane, 0.99 ** steps[:, None] * turn) == (0, False)
    assert period_of(plane, turn) == (0, True)
    assert period_of(plane, np.tile([[0.0, 1.0], [1.0, 0.0], [2.0, 0.0]], (20, 1))) == (3, True)


def test_the_way_back_is_another_one_between_the_folds():
    values = np.linspace(-0.6, 0.6, 61)
    inside = np.abs(values) < 2.0 / (3.0 * math.sqrt(3.0))

    def differ(**options):
        both = diagram_over(bistable, "r", [*values, *values[::-1]], (-1.0, 0.0), **options).ends[:, 0]
        return np.abs(both[:61] - both[:60:-1]) > 1e-3

    assert differ().tolist() == inside.tolist()
    # From the same place each time there is no memory.
    assert not differ(follow=False).any()


def test_what_keeps_volume_says_that_nothing_attracts_there():
    P = return_map(SuslovBody(1.5, 1.0, 0.1, 0.0, 0.3, -0.5, 1.0), E=1.842, accuracy="draft")
    found = diagram_over(lambda value: P.at_constant("I13", value), "I13", [0.1, 0.0], (0.3, 1.2), 10, 16)
    assert found.conservative.tolist() == [False, True]
    assert return_map(HeavyBody.hess((1.0, 1.6, 4.0), 1.0), h=1.5, f=-0.7).preserves_volume


def test_what_is_too_much_is_refused():
    with raises(InvalidParameter, match="give 1 to 2000 finite ones"):
        diagram_over(henon, "a", [math.nan], (0.5, 0.1))
    with raises(WorkLimit, match="at most 20000"):
        diagram_over(henon, "a", [1.0], (0.5, 0.1), transient=20_000)
