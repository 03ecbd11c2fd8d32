"""The orbit of the Suslov–Hess scene, by the general system."""

import numpy as np
from pytest import approx

from hess_mechanics import HessBody, solve, systems, turning_points


def body_of(values):
    return HessBody(values["I22"], values["I23"], values["b3"])


def exact_states(values, times):
    """(ω1, ω2, γ1, γ2, γ3) at these times, integrated in these variables; the page uses the reduced ones."""
    body = body_of(values)
    start = turning_points(values["h"], values["f"]).state_at_lower_turn(values["phi0"])
    state = body.from_reduced(body.from_units_of_b(start))
    return solve(body.suslov, state, times, "reference").states


def rounding(values, times, states):
    """Bound the motion of the body during half a unit in the last place of these times, sent in single precision."""
    rates = np.abs(systems()["suslov"].field(states.T, body_of(values).suslov.parameters)).T
    return rates * np.spacing(np.float32(times))[:, None] / 2


def assert_orbit(explorer, values, within=2e-6):
    """Assert that the browser's orbit has these values: start, end, and points between."""
    orbit = explorer.data("data-orbit")
    times = np.array(orbit["t"])
    last = min(values["span"], 100 * turning_points(values["h"], values["f"]).period / body_of(values).frequency_unit)
    assert times[0] == 0.0
    assert times[-1] == approx(last, rel=1e-6)
    assert np.all(np.diff(times) > 0)
    picks = np.unique(np.linspace(0, times.size - 1, 7).astype(int))
    exact = exact_states(values, times[picks])
    found = np.column_stack([np.array(orbit[name])[picks] for name in ("omega1", "omega2", "g1", "g2", "g3")])
    allowed = within * np.maximum(1.0, np.abs(exact)) + rounding(values, times[picks], exact)
    assert np.max(np.abs(found - exact) - allowed) <= 0.0
    assert explorer.here() == approx((values["h"], values["f"]), rel=1e-7)
