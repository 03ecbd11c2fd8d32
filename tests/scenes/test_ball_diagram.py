"""The orbit diagrams of the ball in a field: what its examples show."""

from dataclasses import asdict
from math import cos, hypot, pi, sin, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_mechanics import ReturnMap, level
from hess_mechanics.dynamics.orbit_diagram import period_of
from support.ball import energy_of
from support.view import View, values_of

SCENE = scenes()["ball-diagram"]


@pytest.mark.parametrize("D, period", [(1.4, 8), (1.43, 4), (1.59, 2)])
def test_near_a_doubling_the_period_is_that_of_its_side(D, period):
    # A perturbation of the orbit decays slowly and alternates sides, which made its period look doubled, or infinite.
    state = SCENE.compute({**SCENE.defaults(), "D": D}, (), True)
    map_ = ReturnMap(state.poincare, level("standard"))
    assert period_of(map_.turns, map_.orbit(np.array(state.diagram.place), 700)[500:], map_.promise) == (period, True)


def test_a_ball_that_turns_the_wrong_way_turns_round_to_a_permanent_rotation():
    view = View(SCENE, values_of(SCENE, "Apart: permanent"), seen=("section", "reversal"))
    state = view.result
    assert "The rotation reverses once. First at t = 80.7" in view.text["reversal"]
    assert f"{state.reversals.times[0]:.1f}" == "80.7"
    assert state.vertical_rate[0] > 0.0 > state.vertical_rate[-1]
    body, E = state.body, state.h - hypot(state.body.b1, state.body.b2)
    # Limits forward and backward in time: γ3 = 0, ω = wγ, w²(I13γ1 + I23γ2) = b3, of this energy.
    for places, sense in zip(state.regime.sets, (-1.0, 1.0), strict=True):
        psi = float(places[-1, 0])
        g = np.array([cos(psi), sin(psi)])
        w = sense * sqrt(body.b3 / (body.I13 * g[0] + body.I23 * g[1]))
        y = np.array([*(w * g), *g, 0.0])
        assert np.abs(body.system.field(y, body.parameters)).max() < 1e-3
        assert energy_of(asdict(body), y) == approx(E, abs=1e-3)
        assert abs(places[-1, 1] - (pi if sense < 0.0 else 0.0)) < 1e-3
