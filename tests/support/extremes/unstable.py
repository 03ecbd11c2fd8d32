"""Starts at and near unstable equilibria, where at first only rounding errors move the motion."""

import numpy as np

from support.mechanics import differences

_NEAR = 1e-9
_GROWTH = (22.0, 32.0)
"""By so many times e a rounding grows: to between 1e-7 and 1e-2."""
FIRST = {"suslov": 4, "ball": 5, "euler-poisson": 3}
"""Place of the first component of b, or of r, among the parameters."""


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def unstable_starts(system, count, seed=1):
    """Return (state, parameters, times) of this many motions: at rest with the centre of mass above, or near that.

    The vertical, along b or against r, is a unit vector or not; every third motion begins about 1e-9 away.
    """
    random, found, first = np.random.default_rng(seed), [], FIRST[system.name]
    velocities, sign = system.angular_velocities, -1.0 if system.name == "euler-poisson" else 1.0
    while len(found) < count:
        parameters = np.array(system.example[1]) * random.uniform(0.7, 1.3, len(system.parameters))
        vector = parameters[first : first + 3] = random.normal(size=3)
        state = np.concatenate((np.zeros(velocities), sign * (unit(vector) if random.random() < 0.5 else vector)))
        jacobian = differences(lambda y, p=parameters: system.field(list(y), p), state)
        rate = float(np.linalg.eigvals(jacobian).real.max())
        if rate < 0.05:
            continue
        if len(found) % 3 == 2:
            state = state + _NEAR * random.normal(size=len(state))
            state[velocities:] = unit(state[velocities:])
        # Eigenvalues differ in their last digits from one processor to another: stored answers would not be found.
        end = float(f"{random.uniform(*_GROWTH) / rate:.6g}")
        found.append((state, parameters, np.array([0.5 * end, end])))
    return found
