"""Rotation numbers by iteration."""

from math import pi

import numpy as np

from hess_mechanics import circle_map
from hess_mechanics.numerics.accuracy import REFERENCE


def displacement(a, h, f):
    """Θ(φ) − φ as a continuous function of φ, from the angles that the map gives, lifted by hand."""
    theta = circle_map(a, h, f, REFERENCE)
    grid = np.linspace(-pi, pi, 40_001)
    turn = np.unwrap(theta.theta(grid) - grid)
    turn -= 2.0 * pi * round(turn.mean() / (2.0 * pi))

    def lifted(phi):
        return np.interp(np.remainder(phi + pi, 2.0 * pi) - pi, grid, turn)

    return lifted
