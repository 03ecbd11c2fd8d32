"""The section g = π/2 in Andoyer–Deprit variables, against the geometry of the angles and SciPy's integrators.

Nothing here uses the polynomial G²γ3 − f M3 of the mechanics: l and g are angles between lines in space.
"""

from math import acos, cos, pi, remainder, sqrt

import numpy as np
from pytest import approx, mark
from scipy.optimize import brentq

from hess_mechanics import section, solve, systems
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.euler_poisson.andoyer import SHEETS, AndoyerPlane, AndoyerSection, coordinates
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from hess_mechanics.numerics.accuracy import PRECISE, STANDARD
from support.andoyer import GESS1, RIS, angles, energies_at, energy, rates
from support.mechanics import apart, scipy_crossings
from support.refusals import refused
from support.thorough import sample


def crossings_by_scipy(body, state, end):
    """Times and states where the angle g grows through π/2."""
    times, states = scipy_crossings(
        lambda y: rates(body, y), state, lambda y: cos(angles(y)[1][0]), end, -1, max_step=0.02 * end
    )
    # cos g falls also where g comes down through −π/2.
    counted = np.sin(angles(states)[1]) > 0.0
    return times[counted], states[counted]


SLANTING = HeavyBody((1.0, 1.6, 2.1), (0.3, -0.5, 0.7), 2.0)
"""No Hess case, and r2 ≠ 0."""


def states_at(body, h, f, l, x, sheet=0):
    """States of a sheet at l, L/G, the momenta G there, and whether g grows."""
    section = AndoyerSection(body, h, f, sheet)
    states, growing = section.states_at(l, x)
    return states, section.roots(l, x)[:, sheet], growing


CASES = [
    (GESS1, 50.0, 5.0),
    (RIS, 0.0, 0.0),
    (RIS, 0.5, 1.0),
    (SLANTING, 3.0, 1.2),
    (SLANTING, -0.5, -0.3),
]
every_case = mark.parametrize(("body", "h", "f"), sample(CASES, 4))


def scattered(count, seed):
    random = np.random.default_rng(seed)
    return random.uniform(-pi, pi, count), random.uniform(-0.98, 0.98, count)


# ---- From a point to a state ------------------------------------------------------------------------------------


@every_case
def test_a_state_of_the_section_has_g_h_f_and_its_place(body, h, f):
    l, x = scattered(200, seed=1)
    states, G, _ = states_at(body, h, f, l, x)
    found = np.isfinite(G)
    assert np.count_nonzero(found) > 20
    l, x, states, G = l[found], x[found], states[found], G[found]
    here, g = angles(states)
    assert np.max(apart(g, pi / 2)) < (1e-7 if f else 1e-12)
    assert np.max(apart(here, l)) < 1e-12
    assert np.max(np.abs(coordinates(states) - np.column_stack([l, x]))) < 1e-12
    assert np.linalg.norm(states[:, :3], axis=1) == approx(G, rel=1e-13)
    assert np.min(G) >= abs(f)
    assert np.max(np.abs(energy(body, states) - h)) < 1e-11 * (1.0 + abs(h) + body.strength)
    assert np.max(np.abs(np.sum(states[:, :3] * states[:, 3:], axis=1) - f)) < 1e-12 * np.max(G)
    assert np.sum(states[:, 3:] ** 2, axis=1) == approx(1.0, abs=1e-13)


def test_seeds_are_in_their_window_spread_evenly_and_on_the_section():
    window = ((-1.0, -0.6), (2.0, 0.4))
    found = AndoyerSection(GESS1, 50.0, 5.0).spread(64, window)
    counts, _, _ = np.histogram2d(*coordinates(np.array(found)).T, bins=4, range=np.transpose(window))
    assert counts.sum() == 64
    assert counts.min() >= 1
    # Where most of the window is impossible, none is beyond.
    few = AndoyerSection(RIS, -0.5, 0.0).spread(50)
    assert np.all(AndoyerSection(RIS, -0.5, 0.0).possible(*coordinates(np.array(few)).T))


# ---- Sheets -----------------------------------------------------------------------------------------------------


def all_roots(body, h, f, l, x):
    """Every G ≥ |f| with this energy at one place, falling: a dense search in α, |f|/G = cos α, then Brent's method."""
    top = sqrt(2.0 * (h + body.strength) / min(body.a))
    if top <= abs(f):
        return []
    alpha = np.linspace(acos(abs(f) / top), 0.0, 20_000)

    def excess(angle):
        return energies_at(body, f, l, x, abs(f) / np.cos(np.atleast_1d(angle))) - h

    found = excess(alpha)
    return [
        abs(f) / cos(brentq(lambda one: excess(one)[0], alpha[i], alpha[i + 1], xtol=1e-15))
        for i in np.flatnonzero(np.sign(found[1:]) != np.sign(found[:-1]))
    ]


SHEETED = sample([(RIS, 0.5, 1.0), (RIS, 0.5, -0.3), (SLANTING, -0.5, -0.3)], 2)


@mark.parametrize(("body", "h", "f"), SHEETED)
def test_a_state_is_a_start_where_g_grows_and_nowhere_else(body, h, f):
    l, x = scattered(100, seed=8)
    seen = set()
    for sheet in range(SHEETS):
        states, G, ok = states_at(body, h, f, l, x, sheet)
        there = np.isfinite(G)
        assert np.all(AndoyerSection(body, h, f).sheet_of(states[there]) == sheet)
        for i in np.flatnonzero(there):
            step = 1e-6 / float(SYSTEM.frequency(states[i], np.array(body.parameters)))
            before, after = (angles(solve(body, states[i], [t], PRECISE).states)[1][0] for t in (-step, step))
            grows = remainder(after - before, 2.0 * pi)
            if abs(grows) > 1e-9:
                assert ok[i] == (grows > 0.0)
                seen.add(bool(ok[i]))
    assert seen == {True, False}


@mark.parametrize(("body", "h", "f"), SHEETED)
def test_all_momenta_with_this_energy_are_found(body, h, f):
    l, x = scattered(75, seed=6)
    found = AndoyerSection(body, h, f).roots(l, x)
    counts = set()
    for place, some in zip(zip(l.tolist(), x.tolist(), strict=True), found, strict=True):
        exact = all_roots(body, h, f, *place)
        counts.add(len(exact))
        assert some[: len(exact)] == approx(exact, rel=1e-9)
        assert np.all(np.isnan(some[len(exact) :]))
    assert {0, 1, 2} & counts == {0, 1, 2}


def test_a_third_momentum_exists():
    l, x = (axis.ravel() for axis in np.meshgrid(np.linspace(-pi, pi, 200), np.linspace(-0.99, 0.99, 100)))
    found = AndoyerSection(RIS, 0.5, 0.3).roots(l, x)
    third = np.flatnonzero(np.isfinite(found[:, 2]))
    assert third.size > 5
    for i in third[:5]:
        assert found[i] == approx(all_roots(RIS, 0.5, 0.3, l[i], x[i]), rel=1e-9)


# ---- Crossings --------------------------------------------------------------------------------------------------


@every_case
def test_crossings_are_those_that_scipy_finds_from_the_angle(body, h, f):
    found = 0
    for start in AndoyerSection(body, h, f).spread(3):
        end = 6.0 / sqrt(2.0 * max(body.a) * (h + body.strength)) * 4.0
        times, states = crossings_by_scipy(body, start, end)
        result = section(body, start, AndoyerPlane(f), end, "precise")
        assert len(result.times) == len(times)
        if len(times):
            assert result.times == approx(times, abs=1e-7 * end)
            assert result.states == approx(states, abs=1e-6 * np.max(np.abs(states)))
        found += len(times)
    assert found >= 3


def test_points_of_a_picture_are_the_crossings_of_the_orbit_one_after_the_other():
    """Points are computed in parts; no point is missing or repeated where two parts meet."""
    section_ = AndoyerSection(RIS, 0.0, 0.0)
    (start,) = section_.spread(1)
    exact = section(RIS, start, AndoyerPlane(0.0), 1e4, PRECISE, 100).states
    assert section_crossings(section_, [start], 100, PRECISE).states[0] == approx(exact, abs=1e-5)


# ---- Refusals ---------------------------------------------------------------------------------------------------


test_a_request_that_means_nothing_is_refused_in_a_sentence = refused(
    (lambda: AndoyerSection(GESS1, -9.9, 5.0).state_at(0.0, 0.2), "choose another point", OutsideRegion),
    (lambda: AndoyerSection(GESS1, 50.0, 5.0, sheet=3).state_at(0.0, 0.2), "no sheet 3: choose one from 0 to 2"),
    (lambda: AndoyerSection(GESS1, 50.0, 5.0).state_at(0.0, 1.5), "−1 ≤ L/G ≤ 1"),
    (
        lambda: section(*systems()["suslov"].example_motion, AndoyerPlane(1.0), 1.0, STANDARD),
        "no Andoyer–Deprit variables: give a HeavyBody",
    ),
)
