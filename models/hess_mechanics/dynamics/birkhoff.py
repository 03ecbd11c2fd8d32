"""Weighted Birkhoff averages along orbits of a section: rotation numbers and a test of convergence."""

from __future__ import annotations

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = ["agreeing_digits", "rotation_number"]

_ALL_ROUND = 0.85
"""Largest spread of the turns between successive points, in turns, for which a rotation number is defined."""


def weighted_mean(values: Array) -> float:
    """Return the mean with weight exp(−1/(t(1 − t))); it converges super-polynomially on quasi-periodic sequences."""
    t = (np.arange(values.size) + 0.5) / values.size
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return float(weight @ values / weight.sum())


def agreeing_digits(series: Array) -> float:
    """Return the number of decimal digits to which weighted averages over the two halves of an orbit agree.

    On a quasi-periodic orbit with a smooth invariant curve the averages converge faster than any power of n, on a
    chaotic one like 1/√n.  For 2000 crossings they agree to more than four digits or to about one.

    Parameters
    ----------
    series : Array, shape (n, m)
        m functions along the orbit, in units of the size of the section's region.

    Returns
    -------
    float
        −log₁₀ of the largest difference between the averages of the halves, over all functions and their squares.

    References
    ----------
    E. Sander, J. D. Meiss, Birkhoff averages and rotational invariant circles for area-preserving maps, Physica D 411
    (2020), 132569.
    """
    half = len(series) // 2
    both = np.concatenate([series, series**2], axis=1)
    off = max(abs(weighted_mean(one[:half]) - weighted_mean(one[half : 2 * half])) for one in both.T)
    return float(-np.log10(max(off, 1e-17)))


def rotation_number(points: Array, centre: tuple[float, float] | None = None) -> tuple[float, float]:
    """Return the rotation number of an orbit (n, 2), in turns per point in (−½, ½], and its estimated error.

    centre : point about which turns are counted; None if the first coordinate is the angle.  The error is the spread of
    the values for the orbit and its two halves.  It is large if the orbit has no invariant curve, and ½ if the turns
    cannot be counted.  Raises `InvalidParameter` for fewer than five points.
    """
    if len(points) < 5:
        raise InvalidParameter(
            f"A rotation number needs five points of an orbit, but there are {len(points)}: follow it for longer."
        )
    if centre is None:
        angle = points[:, 0]
    else:
        angle = np.arctan2(points[:, 1] - centre[1], points[:, 0] - centre[0])
    turns = np.diff(angle) / (2.0 * np.pi)
    # Turns near ½ scatter about the branch cut: unwrap them about their mean direction.
    middle = float(np.angle(np.mean(np.exp(2j * np.pi * turns)))) / (2.0 * np.pi)
    turns = middle + np.asarray(_within_half(turns - middle))
    half = turns.size // 2
    means = [weighted_mean(some) for some in (turns, turns[:half], turns[half:])]
    # Turns spread over the whole circle are ambiguous by ±1, so nothing is known.
    error = 0.5 if np.ptp(turns) > _ALL_ROUND else float(np.ptp(means))
    return float(_within_half(means[0])), error


def _within_half(turns: Array | float) -> Array | float:
    """Return turns modulo 1 in (−½, ½]."""
    return turns - np.ceil(turns - 0.5)
