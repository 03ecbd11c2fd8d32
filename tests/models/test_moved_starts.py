"""Helpers of tests of chaotic motions: starts moved by a few ulps, and how sure a statement about an ensemble is."""

from math import sqrt

import numpy as np
from pytest import approx, mark

from hess_mechanics import (
    Plane,
    SuslovBody,
    lyapunov_spectrum,
    megno_map,
    regime,
    return_map,
    section_points,
    systems,
)
from hess_mechanics.dynamics.basins import mean_divergence
from support.deviations import deviations, mean_of
from support.moved import from_moved_starts

BODY, START = systems()["suslov"].example_motion
POINT = (0.3, 1.2)
EQUATOR = Plane((0.0, 0.0, 0.0, 0.0, 1.0), 0.0, 0)
MAP = return_map(SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0), E=1.842, accuracy="draft")


ENTRIES = {
    "section_points": lambda: section_points(BODY, [START], EQUATOR, 20.0, "draft", 5).states[0],
    "lyapunov_spectrum": lambda: lyapunov_spectrum(BODY, START, 20.0).values,
    "megno_map": lambda: megno_map(MAP, cells=(2, 2), duration=20.0).values,
    "mean_divergence": lambda: mean_divergence(SuslovBody(*BODY.parameters), START, 20.0).mean,
    "regime": lambda: regime(MAP, POINT, 10, 20, 20.0).points,
}


@mark.parametrize("name", ENTRIES)
def test_every_computation_of_a_motion_begins_at_a_moved_start(name):
    plain, moved = ENTRIES[name](), from_moved_starts(ENTRIES[name], 6)
    # A single number may be the same by chance, but not six times.
    for one in (plain, moved[0]):
        assert not all(np.array_equal(one, other) for other in moved)
        np.testing.assert_allclose(moved[1], one, rtol=1e-4, atol=1e-4)


def test_deviations_are_those_of_the_mean_of_a_share_and_of_one_value():
    assert deviations([1.0, 2.0, 3.0], 1.0, of_each=True) == approx(1.0)
    assert deviations([1.0, 2.0, 3.0], 4.0, sqrt(2.0 / 3.0)) == approx(-2.0)
    assert deviations(np.ones(25, bool), 0.5) == approx(5.0)
    assert mean_of([1.0, 2.0, 3.0]) == approx((2.0, sqrt(1.0 / 3.0)))
