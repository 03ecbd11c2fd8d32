"""Attractors, arrivals and boundaries: of a map with three known basins, and of the Suslov problem."""

import math
from dataclasses import dataclass
from math import inf, log, pi
from typing import ClassVar

import numpy as np
import pytest
from pytest import approx

from hess_mechanics.dynamics.attraction import CROSSINGS, LOST, NOWHERE, arrivals, recurrent_sets
from hess_mechanics.dynamics.basin_boundary import arrivals_of_cells, cells_to_compute, merge
from hess_mechanics.dynamics.edge import saddle_between
from hess_mechanics.errors import NotConverged
from support.maps import Formula


def three_wells():
    """φ′ = φ − sin 3φ/4, v′ = v/2 with φ = u − 0.4 v: attractors at φ = 0, ±2π/3, bounded by φ = ±π/3, π."""

    def of(u, v):
        phi = u - 0.4 * v
        return phi - 0.25 * math.sin(3.0 * phi) + 0.2 * v, 0.5 * v

    def derivative(u, v):
        slope = 1.0 - 0.75 * math.cos(3.0 * (u - 0.4 * v))
        return [[slope, 0.2 - 0.4 * slope], [0.0, 0.5]]

    return Formula(of, derivative, turns=(2.0 * math.pi, math.inf), names=("u", "v"))


WELLS = three_wells()
WINDOW = (-pi, -1.0), (pi, 1.0)


@dataclass(frozen=True)
class Mapped:
    """Orbits of a map of (u, v), which are the states; none for v > `top`."""

    map_: object = WELLS
    top: float = inf
    turns: ClassVar = (2.0 * pi, inf)
    window: ClassVar = ((-pi, pi), (-1.0, 1.0))
    section = property(lambda self: self)

    def states_at(self, x, y):
        return np.column_stack([x, y]), y <= self.top

    def points_of(self, states):
        return np.column_stack([np.mod(states[:, 0] + pi, 2.0 * pi) - pi, states[:, 1]])

    def follow(self, starts, crossings):
        return [self.map_.orbit(start, crossings) for start in starts]


def well(x, y):
    """The number of the well by its sector of φ, 0, 1 or 2."""
    return np.mod(np.round((x - 0.4 * y) / (2.0 * pi / 3.0)), 3).astype(int)


@pytest.fixture(scope="module")
def sets():
    return recurrent_sets(Mapped())


def numbers_of(sets):
    """The number of the set in each well."""
    return np.argsort(well(*np.array(sets.states).T))


def test_three_wells_are_three_sets_and_each_orbit_arrives_in_its_own(sets):
    assert sorted(well(*np.array(sets.states).T)) == [0, 1, 2]
    x, y = np.random.default_rng(3).uniform((-pi, -1.0), (pi, 1.0), (400, 2)).T
    found = arrivals(Mapped(), sets, x, y)
    assert np.array_equal(found.number, numbers_of(sets)[well(x, y)])
    # Near a boundary the distance grows 1.75 times in each crossing.
    near = 1e-4 * np.array([1.0, 1e-3])
    late = arrivals(Mapped(), sets, pi / 3.0 + near, np.zeros(2)).crossings
    assert late[1] - late[0] == approx(log(1e3) / log(1.75), abs=1.0)


def test_an_orbit_that_arrives_nowhere_is_lost_and_a_place_without_motion_is_nowhere(sets):
    found = arrivals(Mapped(top=0.5), sets, np.array([0.1, 0.1]), np.array([0.4, 0.6]))
    assert found.number.tolist() == [numbers_of(sets)[0], NOWHERE]
    assert found.crossings[1] == CROSSINGS
    kept = sets.subset([True, False, True])
    assert len(kept.states) == 2
    middle = np.array(sets.states[1])
    assert arrivals(Mapped(), kept, middle[:1], middle[1:]).number.tolist() == [LOST]


def test_cells_are_divided_along_the_boundaries_and_nowhere_else(sets):
    cells, computed = None, 0
    for side in (16, 32, 64, 128):
        mask = cells_to_compute(cells, (side, side), False, 10_000)
        parts = [slice(i, None, 3) for i in range(3)]
        found = [arrivals_of_cells(Mapped(), sets, WINDOW, mask, part) for part in parts]
        cells = merge(cells, mask, list(zip(parts, found, strict=True)))
        computed += mask.sum()
    x, y = np.meshgrid(-pi + (np.arange(128) + 0.5) * pi / 64, -1.0 + (np.arange(128) + 0.5) / 64)
    wrong = cells.number != numbers_of(sets)[well(x, y)]
    # Only what is thinner than the first cells is missed: the tips of the wells at the edge of the window.
    assert not wrong[mask].any()
    assert wrong.mean() < 0.005
    assert np.abs(x[wrong]).min(initial=pi) > pi - 2.0 * pi / 16
    assert computed < 0.4 * cells.number.size
    # A boundary in more cells than allowed stays as it is.
    assert not cells_to_compute(cells, (256, 256), False, 100).any()
    assert cells_to_compute(cells, (256, 256), True, 100).all()


def test_the_saddle_between_two_wells_is_the_one_on_their_boundary(sets):
    def number_of(place):
        return int(arrivals(Mapped(), sets, place[:1], place[1:]).number[0])

    saddle = saddle_between(WELLS, np.array([0.6, 0.7]), np.array([1.9, 0.7]), number_of)
    assert saddle.points == approx(np.array([[pi / 3.0, 0.0]]), abs=1e-9)
    assert saddle.multipliers.real == approx([1.75, 0.5], abs=1e-9)
    with pytest.raises(NotConverged, match="No saddle up to period 12"):
        saddle_between(WELLS, np.array([0.1, 0.1]), np.array([0.2, 0.1]), number_of)
