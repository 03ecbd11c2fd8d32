"""The scene of orbit diagrams: the numbers of its examples by other means, what a click chooses, what captions say."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hess_explorer.compute.cache import CACHE
from hess_explorer.scenes import scenes
from hess_mechanics import largest_exponent, level, solve, spectrum, systems
from hess_mechanics.numerics.accuracy import PLANS, Kind
from hess_mechanics.suslov.section import coordinates, state_at
from support.suslov import divergence, field

SCENE = scenes()["orbit-diagram"]
SUSLOV = systems()["suslov"]


def complete(beginning, seen=("diagram", "section"), **changes):
    """The state of the example of that name, when all that takes long is known."""
    (preset,) = [one for one in SCENE.presets if one.name.startswith(beginning)]
    values = {**SCENE.defaults(), **preset.values, **changes}
    while True:
        state = SCENE.compute(values, seen, False)
        captions = {view.name: view.said(state) for view in SCENE.views if view.name in seen}
        if not state.work.todo:
            return state, captions
        for task in state.work.todo:
            CACHE.get(task.function, *task.arguments)


def returns(body, state, times):
    """Where SciPy's orbit crosses γ3 = 0 upwards so many times (n, 2), and its last state."""
    def height(t, y):
        return y[4]

    height.direction, height.terminal = 1.0, times + 1
    found = solve_ivp(lambda t, y: field(body, y), (0.0, 400.0), state, method="DOP853", rtol=1e-12, atol=1e-13,
                      events=height, first_step=1e-3)
    states = np.array([y for t, y in zip(found.t_events[0], found.y_events[0], strict=True) if t > 1e-6][:times])
    return coordinates(states, 3)


def test_where_periods_double_another_integrator_finds_the_multiplier_minus_one():
    state, captions = complete("Period doubling")
    found = state.cascade
    assert found.periods.tolist() == [1, 2, 4, 8]
    assert "4 doublings located, the first of period 1 at I₂₂ = 2.12605" in captions["diagram"]
    E = state.section.E
    for value, places in zip(found.values[:2], found.places[:2], strict=True):
        body = type(state.body)(1.0, float(value), 0.6, 0.6, -1.0, -0.5, 0.7)
        M, m, h = np.eye(2), len(places), 1e-4
        for i, place in enumerate(places):
            assert np.abs(returns(body, state_at(body, E, 3, *place), 1)[0] - places[(i + 1) % m]).max() < 1e-8
            sides = [[returns(body, state_at(body, E, 3, *(place + sign * h * axis)), 1)[0] for sign in (1, -1)]
                     for axis in np.eye(2)]
            M = np.column_stack([(a - b) / (2.0 * h) for a, b in sides]) @ M
        assert np.linalg.eigvals(M).real.min() == pytest.approx(-1.0, abs=1e-5)
    # Before the first doubling a diagram shows one place, between the first two two of them.
    drawn = state.points("rising")
    for low, high, count in ((2.1, 2.115, 1), (2.2, 2.25, 2), (2.285, 2.3, 4)):
        for x in np.unique(drawn[0][(drawn[0] > low) & (drawn[0] < high)]):
            assert len(np.unique(np.round(drawn[1][drawn[0] == x], 4))) == count


@pytest.mark.parametrize(("name", "verdict", "dimension"), [
    ("Touching", "mixed", (2.211, 0.019)), ("Apart: a strange", "dissipative", (2.090, 0.014)),
    ("Equal: a sea", "conservative", (3.0, 0.0))])
def test_attractors_and_repellers_are_what_their_examples_say(name, verdict, dimension):
    state, captions = complete(name, ("section",))
    assert f"Motion: chaotic, div = {'−' if verdict != 'conservative' else ''}" in captions["section"] or (
        verdict == "conservative")
    assert f"Seen: {verdict}," in captions["section"]
    last = state_at(state.body, state.section.E, 3, *state.sets.attractor[-1])
    exponents = spectrum(SUSLOV, last, state.body.parameters, 4000.0)
    # Two orbits side by side, by another algorithm, part as fast.
    twin = largest_exponent(SUSLOV, last, state.body.parameters, 2000.0, PLANS[Kind.EXPONENT]["standard"].level)
    assert exponents.signs[0] == "+"
    assert abs(twin.value - exponents.values[0]) < 4.0 * exponents.errors[0] + 0.02
    found, error = exponents.dimension
    assert abs(found - dimension[0]) <= 3.0 * math.hypot(error, dimension[1])
    # The mean divergence over the orbit by the trapezoidal rule.
    t = np.linspace(0.0, 500.0, 2001)
    rates = [divergence(state.body, y) for y in solve(SUSLOV, last, state.body.parameters, t, level("draft")).states]
    known = state.kind.dynamics
    assert abs(np.mean(rates) - known.divergence) < 5.0 * known.divergence_error + 0.1
    # The distance, all pairs compared.
    a, b = known.attractor[::3], known.repeller[::3]
    away = a[:, None] - b[None]
    away[..., 0] = np.arctan2(np.sin(away[..., 0]), np.cos(away[..., 0]))
    pairs = np.linalg.norm(away, axis=2)
    distance = max(np.quantile(pairs.min(axis=1), 0.95), np.quantile(pairs.min(axis=0), 0.95))
    assert abs(distance - known.apart.distance) <= known.apart.error + known.apart.grain + 0.05


def test_volume_that_is_kept_is_said():
    state, captions = complete("Equal: volume")
    assert captions["diagram"].endswith("Volume is kept: each value shows one orbit, and nothing attracts.")
    assert state.kind.dynamics.divergence == 0.0


def test_a_click_chooses_a_state_that_is_there_and_a_box_looks_closer():
    state, _ = complete("Period doubling", ("diagram",))
    chosen = state.choose(2.2501, 0.7)
    assert chosen["I22"] == pytest.approx(2.2501, abs=0.0015)
    moved = SCENE.compute({**SCENE.defaults(), **chosen}, ("section",), True)
    # The motion there is on its attractor from the beginning.
    orbit = moved.sets.attractor
    assert np.abs(orbit - moved.place).max(axis=1).min() < 1e-5
    assert moved.place[0] == pytest.approx(0.73, abs=0.05)
    view = next(one for one in SCENE.views if one.name == "diagram")
    box = view.on_box(state, (2.25, 0.6, 2.32, 1.1))
    assert box == {"window": "2.25,0.6;2.32,1.1"}
    closer = SCENE.compute({**SCENE.defaults(), **box}, ("diagram",), True)
    assert (closer.along_values[0], closer.along_values[-1]) == (2.25, 2.32)
    # A window that lies outside the diagram is none.
    assert SCENE.admit({**SCENE.defaults(), "window": "5,0;6,1"})[0]["window"] == ""


def test_reversals_are_where_the_rate_about_the_vertical_is_zero():
    state, captions = complete("Apart: permanent", ("reversal",))
    times, rate = state.orbit.times, state.turning
    crossings = np.flatnonzero(rate[1:] * rate[:-1] < 0.0)
    said = int(re.search(r"turns round (\d+) times", captions["reversal"])[1])
    assert len(crossings) == len(state.turned.times) == said
    assert np.all((times[crossings] <= state.turned.times) & (state.turned.times <= times[crossings + 1]))
    # From one sense of turning to the other.
    assert rate[0] * rate[-1] < 0.0
