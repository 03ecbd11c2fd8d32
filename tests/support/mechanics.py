"""Helpers of the tests of the mechanics: reference values, equilibria, angles, returns, runs without the JIT."""

import json
from pathlib import Path

import numpy as np
from pytest import mark
from scipy.integrate import solve_ivp

from hess_mechanics import LEVELS, systems
from support.thorough import sample

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = json.loads((Path(__file__).parent / "reference.json").read_text())
SYSTEMS = systems()
SOME = sample(SYSTEMS.values(), 2)
every_system = mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
some_systems = mark.parametrize("system", SOME, ids=lambda system: system.name)
every_level = mark.parametrize("name", LEVELS)
every_known_torus = mark.parametrize(
    "row", REFERENCE["hess_monodromy"], ids=lambda row: f"h={row['h']},f={row['f']},a={row['a']}"
)
PROMISE = {"draft": 1e-3, "standard": 1e-6, "precise": 1e-9, "reference": 1e-12}
"""`reference` goes to the floor of double precision, wherever the motion puts that."""
EQUILIBRIA = {
    "suslov": ((0.0, 0.0, 0.0, 0.0, 1.0), (2.0, 1.0, 0.3, 0.5, 0.0, 0.0, 1.0)),
    "ball": ((0.0, 0.0, 0.0, 0.0, 1.0), (2.0, 1.0, 0.3, 0.5, 2.0, 0.0, 0.0, 1.0)),
    "euler-poisson": ((0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (1.0, 1.6, 2.5, 0.0, 0.0, 1.0, 1.0)),
    "hess": ((0.0, 0.0, 0.0, 0.0, 1.0), (0.75, 1.0)),
    "plane-potential": ((0.0, 0.0, 0.0, 0.0, 1.0), (1.2, 1.0, 1.0, 0.8, 1.0, 0.5)),
}
"""State and parameters of an equilibrium of each system."""


def apart(left, right):
    """The distances of angles on the circle."""
    return np.abs(np.angle(np.exp(1j * (np.asarray(left) - np.asarray(right)))))


def angle_between(left, right):
    """The largest distance of two sets of angles, on the circle."""
    return float(np.max(apart(left, right)))


def scipy_states(system, state, parameters, times, rtol=1e-12, atol=1e-13):
    """Return the states (n, d) of a motion by SciPy's DOP853 and the plain field."""

    def rates(_, y):
        return system.field(y.tolist(), parameters)

    return followed(rates, state, times, rtol, atol)


def followed(rates, start, times, rtol=1e-11, atol=1e-13, **options):
    """Return the states (n, d) of a motion at the times by SciPy's DOP853; rates(t, y)."""
    return solve_ivp(rates, (0.0, times[-1]), start, "DOP853", times, rtol=rtol, atol=atol, **options).y.T


def scipy_crossings(rates, state, height, end, direction=0, most=False, **options):
    """Return times and states where SciPy's DOP853 finds the height 0, in one direction (of the run) or both.

    most : ends the run after so many.  A crossing within 1e-6 of the start is the start itself.
    """

    def event(_, y):
        return height(y)

    event.direction, event.terminal = direction, most
    options = {"rtol": 1e-12, "atol": 1e-13, **options}
    run = solve_ivp(lambda _, y: rates(y), (0.0, end), state, "DOP853", events=event, **options)
    times, states = run.t_events[0], run.y_events[0].reshape(-1, len(state))
    later = np.abs(times) > 1e-6
    return times[later], states[later]


def differences(function, place, step=1e-6):
    """Return the Jacobian matrix of a function at a place by central differences."""
    place = np.asarray(place, float)
    shifts = step * np.eye(place.size)
    return np.column_stack(
        [(np.array(function(place + one)) - np.array(function(place - one))) / (2.0 * step) for one in shifts]
    )


def inertia_of(masses, positions):
    """The tensor of point masses, its axes turned about e3 so that I12 = 0, as `Biz03` has them; and Σ m x xᵀ."""
    second = (masses[:, None] * positions).T @ positions
    angle = 0.5 * np.arctan2(2 * second[0, 1], second[0, 0] - second[1, 1])
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    second = turn @ second @ turn.T
    return np.trace(second) * np.eye(3) - second, second
