"""Orbits, limit cycles and the allowed ring on one torus, in the variables of the Suslov problem."""

import math

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import HessBody, circle_map, level, systems, turning_points
from hess_mechanics.errors import NoField, OutsideRegion
from hess_mechanics.suslov_hess.torus import MAX_RETURNS, annulus, cycles, track
from support.mechanics import scipy_states

REFERENCE = level("reference")
BODIES = [HessBody(0.96, 0.28, -1.0), HessBody(0.5, 0.4, -2.5), HessBody(1.3, -0.7, -0.3), HessBody(0.8, 0.6, 1.5)]
TORI = [(1.5, 0.6), (0.2, 0.5), (0.3, -0.4), (1.2, 0.0)]


def states_of(orbit):
    return np.hstack([orbit.omega, orbit.gamma])


def off_scipy(body, orbit):
    """Return the largest distance of an orbit from SciPy's solution of the Suslov problem with the same start."""
    states = states_of(orbit)
    return np.abs(scipy_states(systems()["suslov"], states[0], body.suslov.parameters, orbit.times) - states).max()


@mark.parametrize(("body", "torus"), list(zip(BODIES, TORI, strict=True)))
def test_a_track_solves_the_suslov_problem_on_its_torus_and_in_the_ring_that_it_touches(body, torus):
    (h, f), orbit = torus, track(body, *torus, -2.0, 40.0, REFERENCE, 4.0)
    assert off_scipy(body, orbit) < 1e-8
    w1, w2, n1, n2, n3 = body.in_units_of_b(body.to_reduced(states_of(orbit))).T
    assert np.abs((w1**2 + w2**2) / 2 - n3 - h).max() < 1e-12
    assert np.abs(w1 * n1 + w2 * n2 - f).max() < 1e-12
    assert np.abs(n1**2 + n2**2 + n3**2 - 1).max() < 1e-12
    assert np.abs(orbit.n3 - n3).max() < 1e-12
    assert np.abs(np.exp(1j * orbit.phi) - (w2 + 1j * w1) / np.hypot(w1, w2)).max() < 1e-9
    curves = (*annulus(body, h, turning_points(h, f)), orbit.omega)
    low, high, radius = (np.hypot(*(one / (1.0, math.hypot(1.0, body.a))).T) for one in curves)
    assert low.max() - 1e-9 <= radius.min() <= low.min() + 1e-2 * high.max()
    assert high.max() * (1 - 1e-2) <= radius.max() <= high.min() * (1 + 1e-9)


@mark.parametrize("body", BODIES[:2])
def test_cycles_close_and_the_unstable_one_is_a_solution_too(body):
    theta = circle_map(body.a, 1.5, 0.6, REFERENCE)
    assert theta.kind == "hyperbolic"
    for cycle in cycles(body, 1.5, 0.6, theta.fixed_points[0], REFERENCE, 4.0):
        states = states_of(cycle)
        assert np.abs(states[-1] - states[0]).max() < 1e-10 * max(1.0, np.abs(states).max())
        assert off_scipy(body, cycle) < 1e-7


def test_a_long_span_is_cut_at_the_most_returns():
    body = BODIES[0]
    period = turning_points(1.5, 0.6).period / body.frequency_unit
    orbit = track(body, 1.5, 0.6, 0.0, 1e5, "draft", 4.0)
    assert orbit.times[-1] == approx(MAX_RETURNS * period)
    assert np.all(np.diff(orbit.times) > 0)


def test_impossible_tori_are_refused_with_a_sentence():
    with raises(OutsideRegion, match="choose"):
        track(BODIES[0], 0.0, 5.0, 0.0, 1.0, REFERENCE, 4.0)
    with raises(NoField, match="b3"):
        track(HessBody(1.0, 0.5, 0.0), 1.5, 0.6, 0.0, 1.0, REFERENCE, 4.0)
