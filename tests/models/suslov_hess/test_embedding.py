"""The torus in three dimensions: its points are states with h and f, its limits are those of the torus."""

from math import inf, sqrt

import numpy as np
from pytest import approx, mark

from hess_mechanics import level, solve, systems, turning_points
from hess_mechanics.suslov_hess.embedding import cross_section, embed

HESS = systems()["hess"]
PRECISE = level("precise")
TORI = [(1.5, 0.6), (0.2, 0.5), (0.3, -1e-3), (1.0, 1e-4), (1.5, 0.0), (-0.9, 0.05), (40.0, 3.0)]
every_torus = mark.parametrize(("h", "f"), TORI)


def states_at(points, h, f):
    """The states (n, 5) of points of the torus (h, f), from what its coordinates mean."""
    square = 2.0 * (h + 1.0)
    w1, w2, rise = points[:, 0] * sqrt(square), points[:, 1] * sqrt(square), points[:, 2] * square
    speed = w1**2 + w2**2
    return np.column_stack(
        [w1, w2, (f * w1 + rise * w2) / speed, (f * w2 - rise * w1) / speed, 0.5 * speed - h],
    )


@every_torus
@mark.parametrize(("a", "phi"), [(0.0, 0.3), (0.4, -2.0)])
def test_every_motion_passes_the_cross_section_at_its_times(h, f, a, phi):
    turning = turning_points(h, f)
    found = cross_section(h, turning, 33)
    assert found.times[-1] == approx(turning.period, rel=1e-12)
    orbit = solve(HESS.at((a, 1.0)), turning.state_at_lower_turn(phi), found.times, PRECISE)
    points = embed(orbit.states, h)
    assert states_at(points, h, f) == approx(orbit.states, abs=1e-6)
    x, y, z = points.T
    assert np.column_stack([np.hypot(x, y), z]) == approx(np.column_stack([found.radius, found.height]), abs=1e-6)


def test_at_f_0_and_on_the_separatrix_the_surface_reaches_the_centre_and_changes_continuously():
    for h in (-0.5, 0.5, 1.0):
        turning = None if h == 1.0 else turning_points(h, 0.0)
        found = cross_section(h, turning, 33)
        assert (found.radius[0], found.height[0]) == (0.0, 0.0)
        for near in (turning_points(h, 1e-7), turning_points(h + 1e-7, -1e-7)):
            beside = cross_section(near.h, near, 33)
            assert beside.radius == approx(found.radius, abs=2e-3)
            assert beside.height == approx(found.height, abs=2e-3)
    assert found.times.tolist() == [0.0] + 32 * [inf]
