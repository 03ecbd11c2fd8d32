"""Rotation numbers of orbits on a section, by weighted averages of the turns from point to point."""

from __future__ import annotations

import numpy as np

from .results import Array

__all__ = ["rotation_number"]


def weighted_mean(values: Array) -> float:
    """Mean with the weight exp(−1/(t(1 − t))): of a quasi-periodic sequence it converges faster than any power."""
    t = (np.arange(values.size) + 0.5) / values.size
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return float(weight @ values / weight.sum())


def rotation_number(points: Array, centre: tuple[float, float] | None = None) -> tuple[float, float]:
    """Turns from point to point of an orbit (n, 2), in (−½, ½], and how far its two halves disagree.

    centre : the turns are about it; without one, the first coordinate is itself the angle.  Where the halves
    disagree, the orbit is no closed curve.
    """
    if centre is None:
        angle = points[:, 0]
    else:
        angle = np.arctan2(points[:, 1] - centre[1], points[:, 0] - centre[0])
    turns = np.remainder(np.diff(angle) / (2.0 * np.pi) + 0.5, 1.0) - 0.5
    half = turns.size // 2
    return weighted_mean(turns), abs(weighted_mean(turns[:half]) - weighted_mean(turns[half:]))
