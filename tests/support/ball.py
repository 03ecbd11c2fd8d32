"""The Chaplygin ball of the scenes: its equations as a 2 × 2 system solved at every call, its energy and crossings."""

from math import pi

import numpy as np

from hess_explorer.scenes import scenes
from hess_mechanics.chaplygin_ball.equations import SYSTEM
from support.diagrams import crossings
from support.mechanics import followed


def occupied(points):
    """The cells of an even grid over the section that hold a point."""
    counts, _, _ = np.histogram2d(*points.T, bins=32, range=[[-pi, pi], [0.0, pi]])
    return set(np.flatnonzero(counts).tolist())


BALL, SECTION = scenes()["chaplygin-ball"], scenes()["ball-section"]
TENSOR = ("I11", "I22", "I13", "I23", "D")


def rates(values):
    """The right-hand side of `eq29`, a 2 × 2 system solved at every call."""
    I11, I22, I13, I23, D = (values[name] for name in TENSOR)
    b1, b2, b3 = (values.get(name, 0.0) for name in ("b1", "b2", "b3"))

    def field(_, y):
        w1, w2, g1, g2, g3 = y
        matrix = [[I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2], [-D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)]]
        s = I13 * w1 + I23 * w2
        right = [-s * w2 + b3 * g2 - b2 * g3, s * w1 + b1 * g3 - b3 * g1]
        return [*np.linalg.solve(matrix, right), -g3 * w2, g3 * w1, g1 * w2 - g2 * w1]

    return field


def integrate(values, state, times):
    return followed(rates(values), state, times, atol=1e-14)


def energy_of(values, state):
    w1, w2, g1, g2, g3 = np.asarray(state).T
    I11, I22, _, _, D = (values[name] for name in TENSOR)
    across = np.cross(np.stack([g1, g2, g3], -1), np.stack([w1, w2, 0.0 * w1], -1))
    potential = sum(values.get(name, 0.0) * g for name, g in (("b1", g1), ("b2", g2), ("b3", g3)))
    return 0.5 * (I11 * w1**2 + I22 * w2**2 + D * np.sum(across**2, axis=-1)) + potential


def divergence(body, y):
    """Return the divergence of the field at states y (5, …), by complex steps: exact but for round-off."""
    steps = 1e-30j * np.eye(5).reshape(5, 5, *(1,) * (np.ndim(y) - 1))
    return sum(SYSTEM.field(y + step, body.parameters)[i].imag for i, step in enumerate(steps)) / 1e-30


def shown(value, digits=4):
    return float(f"{value:.{digits}g}")


def first_returns(values, start, count):
    """The first crossings (count, 5) of γ3 = 0 from below."""
    return crossings(rates(values), start, count)


def angles(states):
    psi = np.arctan2(states[:, 3], states[:, 2])
    return np.column_stack([psi, np.mod(np.arctan2(states[:, 1], states[:, 0]) - psi, 2.0 * pi)])
