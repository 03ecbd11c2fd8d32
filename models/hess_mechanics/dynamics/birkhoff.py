"""Weighted Birkhoff averages along orbits of a section: rotation numbers, and whether averages converge at all."""

from __future__ import annotations

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = ["agreeing_digits", "rotation_number"]

_ALL_ROUND = 0.85
"""Turns from one point to the next that scatter by more have no direction about which to count them."""


def weighted_mean(values: Array) -> float:
    """Mean with the weight exp(−1/(t(1 − t))), which converges super-polynomially for quasi-periodic sequences."""
    t = (np.arange(values.size) + 0.5) / values.size
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return float(weight @ values / weight.sum())


def agreeing_digits(series: Array) -> float:
    """Return to how many decimal digits weighted averages over the two halves of an orbit agree.

    On quasi-periodic orbits with smooth invariant curves the averages converge faster than any power of n, on chaotic
    ones like 1/√n, so that 2000 crossings agree to more than four digits or to about one.

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
    """Rotation number of an orbit (n, 2) in turns per point, in (−½, ½], and its estimated error.

    centre : of the turns; without one, the first coordinate is the angle.  The error is by how
    much the orbit and its halves differ, large where it is no invariant curve, and ½ where the turns cannot be counted.
    Raises `InvalidParameter` for fewer than five points.
    """
    if len(points) < 5:
        raise InvalidParameter(
            f"A rotation number needs five points of an orbit, and there are {len(points)}: follow it for longer."
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
    # Turns all round the circle may each be one more or one less: nothing is known then.
    error = 0.5 if np.ptp(turns) > _ALL_ROUND else float(np.ptp(means))
    return float(_within_half(means[0])), error


def _within_half(turns: Array | float) -> Array | float:
    """The same up to whole turns, in (−½, ½]."""
    return turns - np.ceil(turns - 0.5)
