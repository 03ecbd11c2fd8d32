"""The orbit diagrams of the ball in a field: the numbers of its examples by another integrator and other algorithms."""

import re
from dataclasses import asdict
from math import cos, hypot, log, pi, sin, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_mechanics import ReturnMap, ensemble, level, lyapunov_exponent, lyapunov_spectrum
from hess_mechanics.chaplygin_ball.section import coordinates, state_at
from hess_mechanics.dynamics.orbit_diagram import period_of
from hess_mechanics.numerics.accuracy import PLANS, Kind
from support.ball import divergence, energy_of, integrate, rates
from support.deviations import deviations, mean_of
from support.diagrams import complete, crossings, multipliers, nearest, settled
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


@pytest.mark.parametrize("D, period", [(1.4, 8), (1.43, 4), (1.59, 2)])
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


@pytest.mark.chaotic
def test_the_strange_attractor_is_what_its_example_says():
    state, captions = complete(SCENE, "Apart: a strange", ("section",))
    said = re.search(r"Chaotic\. Looks dissipative\. div = −([\d.]+) ± ([\d.]+)", captions["section"])
    assert float(said[2]) < 1e-3
    _, body, E = at(state, "D", state.D)
    starts = [state_at(body, E, *place) for place in settled(state.poincare, 24, 1, 500)[:, 0]]
    found = [lyapunov_spectrum(body, start, 4000.0) for start in starts]
    values = np.array([one.values for one in found])
    # As many decimals as are said.
    rounding = 0.5 * 10.0 ** -len(said[1].partition(".")[2])
    shrinks = [one.divergence for one in found]
    assert abs(deviations(shrinks, -float(said[1]), hypot(rounding, float(said[2])))) < 5.0
    assert deviations(values[:, 0], 0.02) > 5.0
    assert deviations(np.abs(values[:, 1:4]).max(axis=1), 0.002) < -5.0
    assert deviations(values[:, 4], -0.1) < -5.0
    # Two orbits side by side, by another algorithm, part as fast.
    accuracy = PLANS[Kind.EXPONENT]["standard"].level
    twins = [lyapunov_exponent(body, start, 2000.0, accuracy).value for start in starts]
    rate, error = mean_of(values[:, 0])
    # After a time t the growth of a neighbour, which starts in any direction, is known to ln(t)/t.
    assert abs(deviations(twins, rate, hypot(error, log(2000.0) / 2000.0))) < 5.0
    along = ensemble(body, starts, np.linspace(0.0, 500.0, 2001), level("draft")).states
    assert abs(deviations([divergence(body, orbit.T).mean() for orbit in along], *mean_of(shrinks))) < 5.0
    both = (settled(state.poincare, 16, 500, forward=forward) for forward in (True, False))
    assert deviations([nearest(*pair).min() for pair in zip(*both, strict=True)], 0.1) > 5.0


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
