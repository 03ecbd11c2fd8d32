"""Heavy tops and their Andoyer–Deprit section, followed by SciPy from the equations written out."""

from functools import cache
from math import cos, sin, sqrt

import numpy as np

from hess_mechanics.euler_poisson.equations import HeavyBody

GESS1 = HeavyBody.hess((1.0, 0.625, 0.375), 9.975)
"""Figure 11, with h = 50 and f = 5: r = (3, 0, 4), μ = 1.995, so μ|r| = 9.975."""
RIS = HeavyBody.hess((1.0, 1.5, 2.0), -sqrt(0.5))
"""Figures 13 and 14: H = ½(M1² + ⅔M2² + ½M3²) + γ1/√3 + γ3/√6."""


def cross(u, v):
    """u × v of three numbers each: `np.cross` takes twenty times as long."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def rates(body, y):
    """hh01, by vectors."""
    y = np.asarray(y, float).tolist()
    M, gamma = y[:3], y[3:]
    omega = [one * m for one, m in zip(body.a, M, strict=True)]
    free, torque = cross(M, omega), cross(body.r, gamma)
    return np.array([one + body.mu * other for one, other in zip(free, torque, strict=True)] + [*cross(gamma, omega)])


def energy(body, states):
    states = np.atleast_2d(states)
    return 0.5 * states[:, :3] ** 2 @ np.array(body.a) - body.mu * states[:, 3:] @ np.array(body.r)


def angles(states):
    """l and g of states (n, 6): in the plane across M two lines of nodes, along γ × M and along M × e3.

    g leads from the first to the second, and l on to the first axis of the body.
    """
    states = np.atleast_2d(states)
    M, gamma = states[:, :3], states[:, 3:]
    along = M / np.linalg.norm(M, axis=1)[:, None]
    body_node = np.cross(along, np.array([0.0, 0.0, 1.0]))
    space_node = np.cross(gamma, along)
    across = np.cross(along, space_node)
    g = np.arctan2(np.sum(body_node * across, axis=1), np.sum(body_node * space_node, axis=1))
    l = np.arctan2(-body_node[:, 1], body_node[:, 0])
    return l, g


def energies_at(body, f, l, x, G):
    """The energy of g = π/2 for each G ≥ |f|, from the state itself."""
    G = np.atleast_1d(G)
    s, c = sqrt(max(0.0, 1.0 - x * x)), f / G
    along = np.array([s * sin(l), s * cos(l), x])
    gamma = c[:, None] * along + np.sqrt(np.maximum(0.0, 1.0 - c * c))[:, None] * np.array([cos(l), -sin(l), 0.0])
    return energy(body, np.column_stack([G[:, None] * along, gamma]))


@cache
def dense(body, f, l, x, top, count=4000):
    G = np.linspace(max(abs(f), 1e-9), max(top, 1.01 * abs(f)), count)
    return G, energies_at(body, f, l, x, G)
