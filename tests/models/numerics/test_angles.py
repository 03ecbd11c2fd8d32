"""`angle_of`: 40-digit arc tangents of mpmath."""

import math

import numba
import numpy as np
from mpmath import mp
from pytest import approx

from hess_mechanics.numerics.angle_kernels import angle_of


@numba.njit
def angles_of(x, y):
    return np.array([angle_of(y[i], x[i]) for i in range(y.size)])


def angles(vectors):
    """Return `angle_of` of vectors (n, 2)."""
    return angles_of(*np.ascontiguousarray(np.transpose(vectors)))


def exact(x, y):
    """Return the angle of a vector to 40 digits."""
    with mp.workdps(40):
        return mp.atan2(mp.mpf(float(y)), mp.mpf(float(x)))


def test_angles_in_all_directions_are_right_to_four_units_in_the_last_place():
    turns = np.linspace(-1.0, 1.0, 2001)
    # On both sides of each limit between the pieces, too.
    edges = np.arange(-16, 17) / 16.0
    turns = np.concatenate([turns, *(edges + step for step in (-1e-3, -1e-15, 0.0, 1e-15, 1e-3))])
    rng = np.random.default_rng(11)
    for size in (1e-290, 1e-3, 1.0, 1e290):
        lengths = size * rng.uniform(0.1, 1.0, len(turns))
        vectors = lengths[:, None] * np.column_stack([np.cos(np.pi * turns), np.sin(np.pi * turns)])
        for (x, y), found in zip(vectors, angles(vectors), strict=True):
            reference = exact(x, y)
            assert abs(mp.mpf(found) - reference) <= 4.0 * math.ulp(float(reference)), (x, y)


def test_an_angle_near_an_axis_keeps_its_small_part():
    for small in (1e-8, 1e-200, 1e-320):
        vectors = [(1.0, small), (1.0, -small), (-1.0, small), (small, 1.0), (-small, -1.0)]
        assert angles(vectors) == approx([float(exact(*one)) for one in vectors], rel=5e-16, abs=0.0)
    assert angles([(0.0, 0.0), (-0.0, 0.0)]).tolist() == [0.0, 0.0]
