"""The return map on γ3 = 0 by SciPy, and the sets that many orbits come to."""

import numpy as np
from scipy.spatial import KDTree

from hess_mechanics import ReturnMap, level
from support.mechanics import scipy_crossings


def crossings(rates, start, count=1):
    """Return the first states (count, 5) after the start in which γ3 grows through 0, by SciPy."""
    return scipy_crossings(lambda y: rates(0.0, y), start, lambda y: y[4], 400.0, 1, count + 1, first_step=1e-3)[1][
        :count
    ]


def spread(section, count, seed=1):
    """Return random places (count, 2) where motions cross a section."""
    found = np.random.default_rng(seed).uniform(*np.transpose(section.window), (50 * count, 2))
    return found[section.states_at(*found.T)[1]][:count]


def settled(section, count, kept, transient=300, forward=True):
    """Return the late places (count, kept, 2) of orbits from starts all over a section."""
    map_ = ReturnMap(section, level("standard"), not forward)
    return np.array([map_.orbit(place, transient + kept)[transient:] for place in spread(section, count)])


def nearest(a, b):
    """Return the distance (n,) of each place (ψ, δ) of one set from the nearest one of another."""
    a, b = (np.column_stack([np.mod(one[:, 0], 2.0 * np.pi), one[:, 1]]) for one in (a, b))
    return KDTree(b, boxsize=(2.0 * np.pi, 0.0)).query(a)[0]


def distances(a, b):
    """Return the distances (n, m) of places (ψ, δ) of two sets, ψ on the circle."""
    away = a[:, None] - b[None]
    away[..., 0] = np.arctan2(np.sin(away[..., 0]), np.cos(away[..., 0]))
    return np.linalg.norm(away, axis=2)
