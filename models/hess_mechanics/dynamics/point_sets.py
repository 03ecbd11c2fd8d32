"""Distance between two sets of points of a section, with an error estimated from the sets themselves.

The distance is Hausdorff's with a quantile in place of the maximum: the least ε such that 95 of 100 points of either
set have a point of the other within ε.  A finite set stands for a closed one; its two halves show how well.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.periodic import difference
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = ["SetDistance", "distance", "nearest", "set_distance"]

_QUANTILE = 0.95
_RESOLVED = 1e-6
"""Points closer than this are equal."""
_SETTLED = 0.2
_LEAST = 8
_BATCHES = 4


def nearest(turns: Sequence[float], a: Array, b: Array) -> Array:
    """Return the distances from points to the nearest points of another set.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    a : ndarray, shape (n, d)
        The points.
    b : ndarray, shape (m, d)
        The other set.

    Returns
    -------
    ndarray, shape (n,)
        Distances.
    """
    from scipy.spatial import cKDTree  # Imported here because the import takes 0.2 s.

    box = np.array([turn if math.isfinite(turn) else 0.0 for turn in turns])

    def wrapped(points: Array) -> Array:
        result = np.mod(points, turns, where=np.isfinite(turns), out=np.array(points, float))
        return np.where(result >= turns, 0.0, result)

    return np.asarray(cKDTree(wrapped(b), boxsize=box).query(wrapped(a))[0])


def distance(turns: Sequence[float], a: Array, b: Array) -> float:
    """Return the Hausdorff distance between two sets of points, with a 95 % quantile in place of the maximum.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    a : ndarray, shape (n, d)
        One set.
    b : ndarray, shape (m, d)
        The other set.

    Returns
    -------
    float
        The distance.
    """
    return float(max(np.quantile(nearest(turns, a, b), _QUANTILE), np.quantile(nearest(turns, b, a), _QUANTILE)))


@dataclass(frozen=True)
class SetDistance:
    """Distance between two sets of points; the result of `set_distance`.

    Attributes
    ----------
    distance : float
        The distance, ≥ 0.
    error : float
        Largest difference between `distance` and the distance of corresponding quarters of the sets, ≥ 0.
    grain : float
        Distance between the two halves of a set, the larger one of both sets, at least 1e-6; smaller distances are not
        resolved.
    overlap : float
        Fraction of the points of a set that are as close to the other set as its own halves are to each other, the
        smaller one of both sets, 0 to 1.
    has_settled : bool
        True if the halves of each set are closer to each other than a fifth of its size, or coincide.  Otherwise an
        orbit was too short or had not settled.
    """

    distance: float
    error: float
    grain: float
    overlap: float
    has_settled: bool

    @property
    def is_separated(self) -> bool:
        """True for settled sets that are farther apart than grain plus error and overlap by less than 0.5 %."""
        return self.has_settled and self.overlap < 0.005 and self.distance > self.grain + self.error


def set_distance(turns: Sequence[float], a: Array, b: Array) -> SetDistance:
    """Return the distance between two sets of points with its error.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    a : ndarray, shape (n, d)
        One set, in the order of an orbit, n ≥ 8.
    b : ndarray, shape (m, d)
        The other set, in the order of an orbit, m ≥ 8.

    Returns
    -------
    SetDistance
        The distance.

    Raises
    ------
    InvalidParameter
        If a set has fewer than 8 points.
    """
    if min(len(a), len(b)) < _LEAST:
        raise InvalidParameter(
            f"The sets have {len(a)} and {len(b)} points and need at least {_LEAST} each: follow the orbits for longer."
        )
    halves = [(one[: len(one) // 2], one[len(one) // 2 :]) for one in (a, b)]
    grains = [max(_RESOLVED, distance(turns, *both)) for both in halves]
    sizes = [float(np.abs(difference(turns, one, one[0])).max()) for one in (a, b)]
    settled = all(grain < _SETTLED * size or grain == _RESOLVED for grain, size in zip(grains, sizes, strict=True))
    whole = distance(turns, a, b)
    parts = [
        distance(turns, p, q) for p, q in zip(np.array_split(a, _BATCHES), np.array_split(b, _BATCHES), strict=True)
    ]
    shared = []
    for (first, second), other in zip(halves, (b, a), strict=True):
        # "Close" means within the 95 % quantile of the distances from the points of one half of a set to the other
        # half.
        close = max(_RESOLVED, float(np.quantile(nearest(turns, first, second), _QUANTILE)))
        own = np.concatenate([first, second])
        shared.append(float(np.mean(nearest(turns, own, other) <= close)))
    return SetDistance(whole, max(abs(one - whole) for one in parts), max(grains), min(shared), settled)
