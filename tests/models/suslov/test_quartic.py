"""The point in the quartic potential, its integral for I11 = I22, its section, and the way back to the body."""

from math import atan2, copysign, cos, sin, sqrt

import numpy as np
from pytest import approx, mark

from hess_mechanics import level, return_map, solve, systems
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.errors import NoField, OutsideRegion
from hess_mechanics.numerics.accuracy import STANDARD
from hess_mechanics.suslov.quartic import (
    QuarticBody,
    QuarticSection,
    angular_momentum,
    level_error,
    start_on_section,
    state_at,
)
from support.mechanics import differences
from support.refusals import refused

SUSLOV = systems()["suslov"]
FLOOR = level("reference")
BODIES = [
    QuarticBody(2.0, 1.0, 1.0, 0.8),
    QuarticBody(0.6, 1.3, -1.7, 0.9),
    QuarticBody(0.8, 1.6, -0.7, 2.0),
    QuarticBody(1.1, 1.1, 0.9, -0.4),
]
RING = QuarticBody(1.0, 1.0, 1.0, 2.0)
every_body = mark.parametrize("body", BODIES, ids=str)


def starts(body, count=12, seed=0):
    """Return states that cover the region allowed by the energy."""
    rng = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        q = np.array(body.axes) * rng.uniform(-1.0, 1.0, 2)
        if abs(body.height(q)) < 1.0:
            found.append(np.array(state_at(body, q, rng.uniform(-3.1, 3.1))))
    return found


@every_body
def test_the_error_of_the_level_is_that_of_momenta_that_are_too_large(body):
    states = np.array(starts(body))
    assert level_error(body, states) < 1e-13
    _, p = body.to_plane(states)
    larger = states * np.array([1.0, 1.0, 1.1, 1.1, 1.0])
    assert level_error(body, larger) == approx(0.21 * np.sum(p * p, axis=1).max() / 2)


@every_body
def test_pixels_of_a_velocity_are_those_by_which_it_moves_the_point(body):
    state, half_width = np.array(starts(body, 1)[0]), 0.7
    pixels = body.pixels_per_unit(half_width)
    for i in (0, 1):
        (q, moved), _ = body.to_plane(np.array([state, state + 1e-3 * np.eye(5)[i]]))
        assert 1e-3 * pixels[i] == approx(np.linalg.norm(moved - q) / half_width * pixels[2])


@every_body
def test_a_start_has_its_energy_and_place_and_moves_by_the_hamiltonian(body):
    """H = (p² + γ3(q)²)/2 on the level ½, {p_i, q_k} = δ_ik: q̇ = −p, ṗ = γ3 ∂γ3/∂q; h/b3 in γ3, not h/(2 b3)."""
    for y in starts(body):
        assert SUSLOV.integrals(y, body.parameters) == approx({"E": body.E, "F1": 1.0}, abs=1e-12)
        rate = np.array(SUSLOV.field(y, body.parameters))
        ((q,), (p,)), ((q_rate,), (p_rate,)) = body.to_plane(y[None]), body.to_plane(rate[None])
        assert body.height(q) == approx(y[4], abs=1e-13)
        assert q_rate == approx(-p, abs=1e-12)
        assert p_rate == approx(y[4] * differences(body.height, q)[0], abs=1e-8)
    q, beta = 0.9 * np.array(body.axes) * sqrt(0.5), 2.7
    (place,), (p,) = body.to_plane(np.array([state_at(body, q, beta)]))
    assert place == approx(q, abs=1e-13)
    assert atan2(-p[1], -p[0]) == approx(beta, abs=1e-12)


def test_the_angular_momentum_is_an_integral_for_equal_moments_only():
    for I11, holds in ((1.3, True), (1.301, False)):
        body = QuarticBody(I11, 1.3, -1.2, 0.7)
        states = solve(body, state_at(body, (0.5, 0.4), 0.7), np.linspace(0.0, 30.0, 200), FLOOR).states
        G = angular_momentum(body, states)
        assert bool(np.ptp(G) < 1e-12) is holds


@every_body
def test_the_region_is_bounded_by_heights_of_one(body):
    edge = np.array([body.axes[0] * cos(0.3), body.axes[1] * sin(0.3)])
    assert body.height(edge) == approx(-copysign(1.0, body.b3), abs=1e-13)
    if body.hole > 0.0:
        assert body.height(body.hole * edge) == approx(copysign(1.0, body.b3), abs=1e-13)
    else:
        assert abs(body.height(np.zeros(2))) < 1.0
    x, p = body.section_boundaries()[0].T
    q = np.column_stack([x, 0.0 * x] if body.minor_axis else [0.0 * x, x])
    assert p**2 + body.height(q) ** 2 == approx(np.ones(len(x)), abs=1e-12)


@every_body
def test_points_of_the_section_are_what_they_say(body):
    section = QuarticSection(body)
    points = section_crossings(section, section.spread(6), 30, STANDARD)
    assert max(points.drift.values()) < 1e-5
    count = 0
    for states in points.states:
        q, p = body.to_plane(states)
        assert q[:, body.minor_axis] == approx(np.zeros(len(q)), abs=1e-5)
        # It grows: its rate is −p.
        assert np.all(p[:, body.minor_axis] < 0.0)
        for y, (x, along) in zip(states[:4], section.points_of(states), strict=False):
            assert state_at(body, (start := start_on_section(body, x, along))[:2], start[2]) == approx(y, abs=2e-4)
            count += 1
    assert count > 10


test_what_is_no_motion_is_refused = refused(
    (lambda: QuarticBody(1.0, 1.0, 0.0, 1.0), "Choose a nonzero b3", NoField),
    (lambda: QuarticBody(1.0, 1.0, -1.0, -2.0), "energy E = -2: choose E above −\\|b3\\| = -1", OutsideRegion),
    (lambda: QuarticBody(1.0, 1.0, 1e-155, 1.0), "no picture can show"),
    (lambda: state_at(RING, (5.0, 0.0), 0.0), "above the level ½: .* in the region of motion", OutsideRegion),
    (lambda: start_on_section(RING, 2.2, 0.99), "No motion crosses the section at q = 2.2, p = 0.99", OutsideRegion),
)


@every_body
def test_a_start_that_the_energy_forbids_moves_along_its_ray_to_the_edge(body):
    for share in np.random.default_rng(3).uniform(-1.5, 1.5, (200, 2)):
        q = tuple(np.array(body.axes) * share)
        moved = body.nearest_possible(q)
        if abs(float(body.height(np.array(q)))) <= 1.0:
            assert moved == q
            continue
        height = abs(float(body.height(np.array(moved))))
        assert 1.0 - 1e-6 < height <= 1.0
        assert atan2(moved[1], moved[0]) == approx(atan2(q[1], q[0]), abs=1e-12)
    assert abs(float(body.height(np.array(body.nearest_possible((0.0, 0.0)))))) <= 1.0


def test_an_orbit_along_the_edge_of_its_section_goes_on():
    """Its points are less than their errors inside of the edge: they were refused as places without motion."""
    map_ = return_map(QuarticBody(1.0, 1.0, 1.0, 0.9999999), accuracy="draft")
    places = map_.orbit(np.array([0.001, 0.0001]), 1000)
    assert len(places) == 1000
    assert map_.section.states_at(*places.T)[1].all()
    assert map_.state_at(places).shape == (1000, 5)
