"""Moments of reversal against SciPy's events; a permanent rotation has none."""

import numpy as np
import pytest

from hess_mechanics import BallBody, SuslovBody, section, systems
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.rigid_body.reversal import Reversal, rate, reversals
from support.ball import rates as ball_rates
from support.mechanics import scipy_crossings
from support.suslov import field, permanent_rotations

BODY = SuslovBody(2.0, 1.0, 0.0, 0.1, 0.3, -0.5, 1.0)
BALL = BallBody(1.9, 2.9, 0.7, -0.5, 5.0, 1.7, -0.4, 0.1)
START = (0.5, 1.2, 0.6, 0.0, 0.8)


@pytest.mark.parametrize(
    ("body", "rates", "span", "least"),
    [
        (BODY, lambda t, y: field(BODY, y), -100.0, 6),
        (BALL, ball_rates(vars(BALL)), 40.0, 3),
    ],
)
def test_the_moments_are_those_of_another_integrator_and_none_is_lost(body, rates, span, least):
    found = reversals(body, START, span, "precise")
    times, _ = scipy_crossings(lambda y: rates(0.0, y), START, lambda y: y[0] * y[2] + y[1] * y[3], span)
    assert len(found.times) == len(times) >= least
    assert np.abs(found.times - times).max() < 1e-7
    assert np.abs(rate(found.states)).max() < 1e-9
    assert found.error_estimate < 1e-8


def test_a_permanent_rotation_never_reverses():
    body = SuslovBody(1.0, 3.0, 0.6, 0.6, 1.0, 0.7, 0.3)
    for state in permanent_rotations(body, 1.743):
        assert len(reversals(body, state, 5.0, "precise").times) == 0
        assert abs(rate(state[None])[0]) == pytest.approx(np.hypot(*state[:2]), abs=1e-12)


def test_there_are_none_of_a_body_that_may_turn_about_all_axes():
    system = systems()["euler-poisson"]
    state, p = system.example
    with pytest.raises(InvalidParameter, match="ω1, ω2, γ1, γ2, γ3"):
        section(system.at(p), state, Reversal(), 1.0, "draft")
