"""How far apart two sets of places of a section are, with what is known of it from the sets themselves.

The distance is that of Hausdorff with a quantile for the maximum: the least ε such that 95 of 100 places of either set
have one of the other within ε.  A set of finitely many places stands for a closed one; how well, its two halves tell.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.periodic import apart
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = ["Apart", "distance", "how_far_apart", "nearest"]

_QUANTILE = 0.95
_RESOLVED = 1e-6
"""Places closer than this are the same."""
_SETTLED = 0.2
_LEAST = 8
_BATCHES = 4


def nearest(turns: Sequence[float], a: Array, b: Array) -> Array:
    """From each of the places `a` (n, d) the distance to the nearest of `b` (m, d), (n,); angles go round."""
    from scipy.spatial import cKDTree  # imported here because it takes 0.2 s

    box = np.array([turn if math.isfinite(turn) else 0.0 for turn in turns])

    def wrapped(places: Array) -> Array:
        found = np.array(places, float)
        for i, turn in enumerate(turns):
            if math.isfinite(turn):
                found[:, i] %= turn
                found[found[:, i] >= turn, i] = 0.0
        return found

    return np.asarray(cKDTree(wrapped(b), boxsize=box).query(wrapped(a))[0])


def distance(turns: Sequence[float], a: Array, b: Array) -> float:
    """Between sets of places (n, d) and (m, d), see the module."""
    return float(max(np.quantile(nearest(turns, a, b), _QUANTILE), np.quantile(nearest(turns, b, a), _QUANTILE)))


@dataclass(frozen=True)
class Apart:
    """How far apart two sets of places are.

    distance, error : the error is the largest difference from the distance of the quarters of the sets.
    grain : the distance between the two halves of one set, the larger of the two; less than this cannot be told.
    shared : the share of the places of either set, the smaller one, that lie as close to the other set as halves of
        one set lie to each other.
    settled : whether halves of one set are closer to each other than a fifth of its size: else the orbit that passed
        it was still on its way, or too short.
    """

    distance: float
    error: float
    grain: float
    shared: float
    settled: bool

    @property
    def apart(self) -> bool:
        """Whether no place of one is close to the other set, in so far as the grain tells."""
        return self.settled and self.shared < 0.005 and self.distance > self.grain + self.error


def how_far_apart(turns: Sequence[float], a: Array, b: Array) -> Apart:
    """Of two sets of places (n, d) and (m, d), each in the order in which an orbit passed them.

    Raises `InvalidParameter` where one has fewer than 8 places.
    """
    if min(len(a), len(b)) < _LEAST:
        raise InvalidParameter(f"Two sets of places are compared from {_LEAST} places on: follow the orbits longer.")
    halves = [(one[: len(one) // 2], one[len(one) // 2 :]) for one in (a, b)]
    grains = [max(_RESOLVED, distance(turns, *both)) for both in halves]
    sizes = [float(np.abs(apart(turns, one, one[0])).max()) for one in (a, b)]
    settled = all(grain < _SETTLED * size or grain == _RESOLVED for grain, size in zip(grains, sizes, strict=True))
    whole = distance(turns, a, b)
    parts = [
        distance(turns, p, q) for p, q in zip(np.array_split(a, _BATCHES), np.array_split(b, _BATCHES), strict=True)
    ]
    shared = []
    for (first, second), other in zip(halves, (b, a), strict=True):
        # As close as 95 of 100 places of one half are to the other half.
        close = max(_RESOLVED, float(np.quantile(nearest(turns, first, second), _QUANTILE)))
        own = np.concatenate([first, second])
        shared.append(float(np.mean(nearest(turns, own, other) <= close)))
    return Apart(whole, max(abs(one - whole) for one in parts), max(grains), min(shared), settled)
