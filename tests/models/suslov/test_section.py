"""Sections of the Suslov problem with gravity: their coordinates, seeds and points.

The equations are written out here and integrated by SciPy; nothing is compared with itself.
"""

from math import pi

import numpy as np
from pytest import approx, mark, raises

from hess_mechanics import SuslovBody
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.errors import OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import PRECISE
from hess_mechanics.suslov.suslov_section import SuslovSection
from support.mechanics import scipy_crossings
from support.refusals import refused
from support.suslov import energy, field

BODY = SuslovBody(1.5, 3.0, 0.4, -0.7, -0.5, 0.6, 0.7)


SEEN = SuslovSection(BODY, 0.6, 3)
WHOLE = ((-pi, 0.0), (pi, pi))


# ---- coordinates -------------------------------------------------------------------------------------------------


@mark.parametrize(("k", "E"), [(1, -0.3), (2, 50.0), (3, 0.4)])
def test_states_are_on_the_plane_have_the_energy_and_grow_and_coordinates_bring_them_back(k, E):
    psi, delta = np.random.default_rng(k).uniform((-pi, 0.01), (pi, pi - 0.01), (400, 2)).T
    states, ok = SuslovSection(BODY, E, k).states_at(psi, delta)
    gamma_energy = states[:, 2:] @ [BODY.b1, BODY.b2, BODY.b3]
    assert np.array_equal(ok, gamma_energy < E)
    assert 20 < ok.sum() <= 400
    assert ok.all() == (E > 1.0)
    assert np.all(states[:, k + 1] == 0.0)
    assert np.linalg.norm(states[:, 2:], axis=1) == approx(np.ones(400), abs=1e-15)
    for state in states[ok]:
        assert energy(BODY, state) == approx(E, abs=1e-13 * max(1.0, E))
        assert field(BODY, state)[k + 1] > 0.0
    assert SuslovSection(BODY, 0.0, k).points_of(states[ok]) == approx(np.column_stack([psi, delta])[ok], abs=1e-7)


@mark.parametrize("k", [1, 2, 3])
def test_below_the_lowest_energy_nothing_is_possible_and_above_it_something(k):
    lowest = SuslovSection(BODY, 0.0, k).lowest_energy
    psi = np.linspace(-pi, pi, 100_001)
    gamma = np.zeros((3, psi.size))
    gamma[[i for i in range(3) if i != k - 1]] = np.cos(psi), np.sin(psi)
    assert lowest == approx(np.min(np.array([BODY.b1, BODY.b2, BODY.b3]) @ gamma), abs=1e-8)
    below, above = (SuslovSection(BODY, lowest + away, k) for away in (-1e-9, 1e-6))
    assert (below.possible(psi).any(), above.possible(psi).any()) == (False, True)
    assert below.spread(5) == ()
    with raises(OutsideRegion, match="choose another point, or a larger energy"):
        below.state_at(0.0, 1.0)


test_what_is_no_point_or_too_much_is_refused = refused(
    (lambda: SEEN.state_at(0.5, pi), "at ψ = 0.5, δ = ", OutsideRegion),
    (lambda: SuslovSection(BODY, 1.0, 4), "choose 1, 2 or 3"),
    (lambda: section_crossings(SEEN, SEEN.spread(2), 1000, PRECISE, max_steps=500), "a shorter", WorkLimit),
    (lambda: section_crossings(SEEN, SEEN.spread(2), 10**7, PRECISE), "choose a number between", WorkLimit),
)


# ---- seeds -------------------------------------------------------------------------------------------------------


@mark.parametrize(
    ("k", "above", "window"),
    [
        (1, 1e-9, WHOLE),
        (3, 1e-4, ((-0.2, 0.5), (2.9, 1.0))),
        (3, 30.0, ((-3.0 * pi, 0.0), (3.0 * pi, 2.0))),
    ],
)
def test_seeds_are_as_many_as_asked_for_wherever_the_energy_allows_any(k, above, window):
    E = SuslovSection(BODY, 0.0, k).lowest_energy + above
    found = np.array(SuslovSection(BODY, E, k).spread(25, window)).reshape(-1, 5)
    (psi0, delta0), (psi1, delta1) = window
    if not SuslovSection(BODY, E, k).possible(np.linspace(psi0, psi1, 200_001)).any():
        assert len(found) == 0
        return
    assert len(found) == len({tuple(state) for state in found}) == 25
    psi, delta = SuslovSection(BODY, 0.0, k).points_of(found).T
    turns = np.abs(psi[:, None] + 2.0 * pi * np.arange(-3, 4) - 0.5 * (psi0 + psi1))
    assert np.all(turns.min(axis=1) <= (psi1 - psi0) / 2 + 1e-9)
    assert np.all((delta > delta0) & (delta < delta1 + 1e-9))


# ---- points ------------------------------------------------------------------------------------------------------


@mark.parametrize(("k", "forward", "count"), [(1, True, 3), (2, False, 8), (3, True, 8)])
def test_the_first_points_are_those_of_scipy(k, forward, count):
    body = SuslovBody(1.5, 3.0, 0.4, 0.4, -0.5, -0.5, 0.7)
    start = SuslovSection(body, 0.4, k).state_at(-0.3, 0.9)
    found = section_crossings(SuslovSection(body, 0.4, k), [start], 8, PRECISE, not forward).states[0][:count]
    # Along a backward run γ_k falls where it grows in t.
    sense = 1 if forward else -1
    _, exact = scipy_crossings(lambda y: field(body, y), start, lambda y: y[k + 1], 120.0 * sense, sense)
    # A sea: neighbours part between crossings.
    assert found == approx(exact[:count], abs=1e-6)
