"""Starts at and near unstable equilibria, where at first only rounding errors move the motion."""

from math import cos, hypot, sin, sqrt

import numpy as np
from scipy.optimize import root

from hess_mechanics import systems

_NEAR = 1e-9
_GROWTH = (22.0, 32.0)
"""By so many times e a rounding grows: to between 1e-7 and 1e-2."""


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def beside(state, velocities, random):
    """The state with all components moved by about 1e-9, its vertical of length 1 again."""
    moved = np.asarray(state) + _NEAR * random.normal(size=len(state))
    return np.concatenate((moved[:velocities], unit(moved[velocities:])))


def upright(velocities, first):
    """At rest with the centre of mass above: γ along the parameters from `first` on, or against r, unit or not."""

    def start(parameters, random):
        vector = random.normal(size=3)
        parameters[first : first + 3] = vector
        sign = -1.0 if velocities == 3 else 1.0
        return np.concatenate((np.zeros(velocities), sign * (unit(vector) if random.random() < 0.5 else vector)))

    return start


def on_a_pole(parameters, random):
    """On the separatrix of eq01, which comes to the saddle and would rest there; or next to the saddle."""
    parameters[:] = random.uniform(-1.0, 1.0), random.uniform(0.5, 2.0)
    if random.random() < 0.5:
        angle, speed = random.uniform(-3.0, 3.0), 2.0 * sqrt(parameters[1])
        return np.array([speed * sin(angle), speed * cos(angle), 0.0, 0.0, 1.0])
    return beside([0.0, 0.0, 0.0, 0.0, -1.0], 2, random)


def at_rest_in_the_potential(parameters, random):
    """A critical point of U(γ1, γ2) off the pole, where both c are negative; None where Newton's method finds none."""
    parameters[2:4] *= -1.0
    field = systems()["plane-potential"].field

    def torque(place):
        third = sqrt(max(0.0, 1.0 - place @ place))
        return np.array(field([0.0, 0.0, *place, third], parameters)[:2])

    found = root(torque, random.uniform(-0.6, 0.6, 2), method="hybr", options={"xtol": 1e-15})
    size = hypot(*found.x)
    if not (0.05 < size < 0.95 and np.abs(torque(found.x)).max() < 1e-14):
        return None
    return np.array([0.0, 0.0, *found.x, sqrt(1.0 - size**2)])


_STARTS = {
    "suslov": upright(2, 4),
    "ball": upright(2, 5),
    "euler-poisson": upright(3, 3),
    "hess": on_a_pole,
    "plane-potential": at_rest_in_the_potential,
}


def growth_rate(system, state, parameters):
    """The largest real part of an eigenvalue of the field's derivative, by differences."""
    steps = 1e-6 * np.eye(len(state))
    jacobian = np.column_stack(
        [
            (np.array(system.field(list(state + e), parameters)) - np.array(system.field(list(state - e), parameters)))
            / 2e-6
            for e in steps
        ]
    )
    return float(np.linalg.eigvals(jacobian).real.max())


def unstable_starts(system, count, seed=1):
    """Return (state, parameters, times) of this many motions: every third near an equilibrium, the others at one."""
    random, found = np.random.default_rng(seed), []
    while len(found) < count:
        parameters = np.array(system.example[1]) * random.uniform(0.7, 1.3, len(system.parameters))
        state = _STARTS[system.name](parameters, random)
        if state is None:
            continue
        # On the separatrix the rate is that of the saddle it comes to.
        rate = sqrt(parameters[1]) if system.name == "hess" else growth_rate(system, state, parameters)
        if rate < 0.05:
            continue
        if len(found) % 3 == 2 and system.name != "hess":
            state = beside(state, len(state) - 3, random)
        # Eigenvalues differ in their last digits from one processor to another: stored answers would not be found.
        end = float(f"{random.uniform(*_GROWTH) / rate:.6g}")
        found.append((state, parameters, np.array([0.5 * end, end])))
    return found
