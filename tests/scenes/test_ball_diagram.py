"""The orbit diagrams of the ball in a field: the numbers of its examples by another integrator and other algorithms."""

import re
from dataclasses import asdict, replace
from math import cos, hypot, pi, sin, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_mechanics import ReturnMap, level, lyapunov_exponent, lyapunov_spectrum, solve
from hess_mechanics.chaplygin_ball.section import coordinates, state_at
from hess_mechanics.dynamics.orbit_diagram import period_of
from hess_mechanics.numerics.accuracy import PLANS, Computation
from support.ball import energy_of, integrate, rates
from support.diagrams import complete, crossings, distance_of_most, distances, multipliers
from support.view import View

SCENE = scenes()["ball-diagram"]


def at(state, name, value):
    """The body and the energy with another value of a parameter, h held over the lowest energy of the plane."""
    values = {**asdict(state.body), "h": state.h, name: value}
    h = values.pop("h")
    return values, type(state.body)(**values), h - hypot(values["b1"], values["b2"])


def exact_multipliers(values, body, E, places):
    """Return the multipliers of the orbit through these places by SciPy; it must close."""

    def image(place):
        return coordinates(crossings(rates(values), state_at(body, E, *place)))[0]

    for place, following in zip(places, np.roll(places, -1, axis=0), strict=True):
        assert image(place) == approx(following, abs=1e-8)
    return multipliers(image, places, 2e-5)


@pytest.mark.thorough
def test_where_periods_double_along_the_ball_inside_another_integrator_finds_the_multiplier_minus_one():
    state, captions = complete(SCENE, "Period doubling", ("diagram", "section"))
    found = state.diagram.cascade
    assert found.periods.tolist() == [2, 4, 8, 16]
    assert "4 period doublings located." in captions["diagram"]
    assert "points. The first of period 2 at 𝒟 = 1.587; ratio 4.676 ±" in captions["diagram"]
    # The numbers of the words beside the pictures.
    assert found.values == approx([1.5872085, 1.4256035, 1.3934895, 1.3866210], abs=6e-8)
    assert found.ratios == approx([5.032, 4.676], abs=6e-4)
    for value, places in zip(found.values[:2], found.places[:2], strict=True):
        assert exact_multipliers(*at(state, "D", float(value)), places).real.min() == approx(-1.0, abs=1e-5)
    drawn = state.diagram.points("rising")
    for low, high, count in ((1.6, 1.75, 2), (1.44, 1.57, 4)):
        values = np.unique(drawn[0][(drawn[0] > low) & (drawn[0] < high)])
        assert len(values) > 30
        for x in values:
            assert 1 + np.count_nonzero(np.diff(np.sort(drawn[1][drawn[0] == x])) > 2e-3) == count
    # With 𝒟 = 1.5 it is of period 4: a small drift of the energy does not hide that, not even a larger one.
    for said in (captions, complete(SCENE, "Period doubling", ("section",), accuracy="draft", steps=2.0)[1]):
        assert "Period 4. Looks dissipative. div = −0.07" in said["section"]


@pytest.mark.parametrize("D, period", [(1.4, 8), (1.43, 4), (1.44, 4), (1.45, 4), (1.59, 2), (1.6, 2), (1.7, 2)])
def test_near_a_doubling_the_period_is_that_of_its_side(D, period):
    # A perturbation of the orbit decays slowly and alternates sides, which made its period look doubled, or infinite.
    state = SCENE.compute({**SCENE.defaults(), "D": D}, (), True)
    map_ = ReturnMap(state.poincare, level("standard"))
    assert period_of(map_.turns, map_.orbit(np.array(state.diagram.place), 700)[500:], map_.promise) == (period, True)


def test_the_orbit_of_period_one_doubles_first_and_goes_on_as_a_saddle():
    given = {"branch": "period 1", "chosen": "-2.7743,1.0236", "last": 3.0, "steps": 2.0}
    view = View(SCENE, {**given, "ways": "there and back"}, seen=["diagram"])
    (flip,) = (one for part in view.result.continuation.branches for one in part.bifurcations)
    assert (flip.kind, flip.value) == ("flip", approx(2.7347985, abs=6e-8))
    assert exact_multipliers(*at(view.result, "D", flip.value), flip.places).real.min() == approx(-1.0, abs=1e-5)
    for part in view.result.continuation.branches:
        for value, kind in zip(part.values, part.kinds, strict=True):
            assert abs(value - flip.value) < 1e-6 or kind.startswith("stable" if value > flip.value else "saddle")


def test_the_strange_attractor_is_what_its_example_says():
    state, captions = complete(SCENE, "Apart: a strange", ("section",))
    said = re.search(r"Chaotic\. Looks dissipative\. div = −([\d.]+) ± ([\d.]+)", captions["section"])
    assert float(said[1]) == approx(0.0925, abs=1e-3)
    assert float(said[2]) < 1e-3
    values, body, E = at(state, "D", state.D)
    last = state_at(body, E, *state.regime.sets.attractor[-1])
    # Six orbits: the error of a single one, 0.004 to 0.015 here, may leave its sign open.
    starts = [state_at(body, E, *place) for place in state.regime.sets.attractor[::250]]
    found = [lyapunov_spectrum(body, start, 4000.0) for start in starts]
    assert all(one.signs[1:] == ("0", "0", "0", "-") for one in found)
    largest = np.array([one.values[0] for one in found])
    scatter = np.std(largest, ddof=1) / sqrt(len(largest))
    assert largest.mean() > 5.0 * scatter
    assert largest.mean() == approx(0.036, abs=0.006)
    # Two orbits side by side, by another algorithm, part as fast.
    twins = [
        lyapunov_exponent(body, start, 2000.0, PLANS[Computation.EXPONENT]["standard"].level).value for start in starts
    ]
    assert abs(np.mean(twins) - largest.mean()) < 4.0 * scatter + 0.01
    assert np.mean([one.dimension[0] for one in found]) == approx(2.28, abs=0.04)
    # The mean divergence by a 2 × 2 system solved at every state: ω̇ is quadratic in ω, so differences are derivatives.
    field = rates(values)
    states = solve(body, last, np.linspace(0.0, 500.0, 2001), level("draft")).states
    shrinks = [
        sum(field(0.0, y + e)[i] - field(0.0, y - e)[i] for i, e in enumerate(np.eye(5)[:2])) / 2.0 for y in states
    ]
    assert np.mean(shrinks) == approx(-0.0925, abs=0.02)
    a, b = state.regime.sets.attractor[::3], state.regime.sets.repeller[::3]
    known = state.regime.kind.dynamics
    assert abs(distance_of_most(a, b) - known.distance) <= known.distance_error + 0.05
    assert distances(a, b).min() > 0.1


def test_a_ball_that_turns_the_wrong_way_turns_round_to_a_permanent_rotation():
    state, captions = complete(SCENE, "Apart: permanent", ("section", "reversal"))
    assert "The rotation reverses once. First at t = 80.7" in captions["reversal"]
    values, body, E = at(state, "D", state.D)
    moment, orbit = float(state.turned.times[0]), state.orbit.path
    assert state.turning[0] > 0.0 > state.turning[-1]
    # SciPy, from a little before: (ω, γ) changes its sign then.
    before = int(np.searchsorted(orbit.times, moment - 2.0))
    times = np.linspace(0.0, 4.0, 401)
    turning = np.array([y[:2] @ y[2:4] for y in integrate(values, orbit.states[before], times)])
    (crossing,) = np.flatnonzero(turning[1:] * turning[:-1] < 0.0)
    assert times[crossing] - 1e-6 <= moment - orbit.times[before] <= times[crossing + 1] + 1e-6
    # Limits forward and backward in time: γ3 = 0, ω = wγ, w²(I13γ1 + I23γ2) = b3, of this energy.
    for places, sense in ((state.regime.sets.attractor, -1.0), (state.regime.sets.repeller, 1.0)):
        psi = float(places[-1, 0])
        g = np.array([cos(psi), sin(psi)])
        w = sense * sqrt(body.b3 / (body.I13 * g[0] + body.I23 * g[1]))
        y = np.array([*(w * g), *g, 0.0])
        assert np.abs(rates(values)(0.0, y)).max() < 1e-3
        assert energy_of(values, y) == approx(E, abs=1e-3)
        assert abs(places[-1, 1] - (pi if sense < 0.0 else 0.0)) < 1e-3


def test_where_no_motion_crosses_at_the_chosen_place_another_one_is_taken_and_that_is_grey():
    state = SCENE.compute({**SCENE.defaults(), "h": 0.3, "chosen": "-0.61,1"}, (), True)
    body, E = state.body, state.poincare.h

    def height(psi):
        return body.b1 * np.cos(psi) + body.b2 * np.sin(psi)

    assert height(-0.61) > E > height(state.diagram.place[0])
    (grey,) = state.poincare.impossible(((-pi, 0.0), (pi, pi)))
    middles = (np.arange(grey.size) + 0.5) * 2.0 * pi / grey.size - pi
    assert np.array_equal(grey, height(middles) >= E)
    assert 0 < grey.sum() < grey.size
    assert replace(state.poincare, h=-2.0).somewhere() is None
