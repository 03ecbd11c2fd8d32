"""Distances between known sets of places: circles, intervals, and a set and itself."""

from math import inf, log, pi

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics.dynamics.point_sets import distance, nearest, set_distance
from hess_mechanics.errors import InvalidParameter
from support.diagrams import distances

PLANE = (inf, inf)
RNG = np.random.default_rng(5)


def circle(radius, count=4000):
    angle = RNG.uniform(0.0, 2.0 * pi, count)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def test_the_nearest_is_the_nearest_of_all_also_across_half_a_turn():
    turns = (2.0 * pi, inf)
    a, b = RNG.uniform(-pi, pi, (50, 2)), RNG.uniform(-pi, pi, (60, 2))
    assert np.abs(nearest(turns, a, b) - distances(a, b).min(axis=1)).max() < 1e-12


@mark.parametrize(("r", "R"), [(1.0, 1.5), (2.0, 1.9)])
def test_circles_are_as_far_apart_as_their_radii(r, R):
    found = set_distance(PLANE, circle(r), circle(R))
    assert abs(found.distance - abs(R - r)) <= found.error + 1e-4
    assert abs(found.distance - abs(R - r)) < 1e-3
    assert found.is_separated
    assert found.overlap == 0.0


def test_one_set_twice_is_no_distance_apart_but_its_grain():
    found = set_distance(PLANE, circle(1.0), circle(1.0))
    assert found.has_settled
    assert found.distance <= found.grain + found.error
    assert found.overlap > 0.8
    assert not found.is_separated
    # Two sets of n random places on a circle are about 2π/n · ln 20/2 apart, nineteen in twenty.
    assert found.distance == approx(pi * log(20.0) / 4000, rel=0.3)


def test_places_of_periodic_orbits_have_no_grain_but_what_is_resolved():
    a, b = np.tile([[0.0, 0.0], [1.0, 0.0]], (8, 1)), np.tile([[0.0, 2.0], [1.0, 2.0]], (8, 1))
    found = set_distance(PLANE, a, b)
    assert (found.distance, found.error, found.grain, found.is_separated) == (2.0, 0.0, 1e-6, True)
    assert distance(PLANE, a, a) == 0.0
    assert found.has_settled
    # An orbit that leaves one place for another has not settled.
    left = np.repeat([[0.0, 0.0], [1.0, 0.0]], 8, axis=0)
    assert not set_distance(PLANE, left, left).has_settled
    with raises(InvalidParameter, match="need at least 8"):
        set_distance(PLANE, a[:7], b)


def test_where_one_set_is_a_part_of_the_other_the_distance_is_that_of_what_is_left():
    whole = np.column_stack([np.linspace(0.0, 1.0, 201), np.zeros(201)])
    part = whole[:101]
    # From the part to the whole it is 0; of the places of the whole 95 of 100 have x up to 0.95.
    for one, other in ((part, whole), (whole, part)):
        assert distance((inf, inf), one, other) == approx(0.45, abs=1e-9)


def test_the_grain_of_an_orbit_that_drifts_is_the_distance_of_its_halves():
    places = np.column_stack([np.arange(200) / 200.0, np.zeros(200)])
    found = set_distance(PLANE, places, places)
    # The points 100 to 199 are 1/200 to 100/200 away from 99/200; of these distances 95 of 100 are up to 95.05/200.
    assert found.grain == approx(95.05 / 200.0, abs=1e-12)
    assert not found.has_settled
