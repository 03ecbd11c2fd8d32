"""Averages along orbits and their errors: rotation numbers, mean rates, and a test for quasi-periodic motions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.periodic import difference
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = [
    "ERRORS",
    "STRETCHES",
    "batch_error",
    "bounded_series",
    "ensemble_mean",
    "irregularity",
    "rotation_number",
    "volume_sign",
    "window_rates",
]

ERRORS = 3.0
"""A number counts as 0 if it is within this many errors of 0."""
_ONE_SIDED = 0.99865
"""Probability that a normal variable stays below three standard deviations."""
STRETCHES = 12
"""Number of intervals of time whose scatter gives the error of a mean rate."""

_LEAST_REPEATS = 16
"""An orbit shows a part of period m if it is at least this many periods long."""
_TOO_CLOSE = 1e-3
"""Orbits on a curve come back within about 1/m of its size after m points, and rarely within a thousandth of that."""
_ALL_ROUND = 0.85
"""Largest spread of the turns between successive points, in turns, for which a rotation number is defined."""


def _weights(count: int) -> Array:
    t = (np.arange(count) + 0.5) / count
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return np.asarray(weight / weight.sum())


def _weighted_mean(values: Array) -> float:
    """Return the mean with weight exp(−1/(t(1 − t))); it converges super-polynomially on quasi-periodic sequences."""
    return float(_weights(values.size) @ values)


def window_rates(sums: Array, times: Array) -> Array:
    """Return the weighted mean rates of a sum over all the time, and over its first, middle and last half.

    On a torus the error of the first rate is much smaller than its differences from the others.

    Parameters
    ----------
    sums : ndarray, shape (n,)
        The sum at each time.
    times : ndarray, shape (n,)
        Evenly spaced times, n ≥ 5.

    Returns
    -------
    ndarray, shape (4,)
        The mean rates.
    """
    rates, quarter = np.diff(sums) / np.diff(times), (times.size - 1) // 4
    windows = slice(None), slice(2 * quarter), slice(quarter, 3 * quarter), slice(2 * quarter, None)
    return np.array([_weighted_mean(rates[one]) for one in windows])


def irregularity(turns: Sequence[float], points: Array, precision: float) -> float:
    """Return the difference between averages over the two halves of an orbit, relative to that of white noise.

    On a quasi-periodic orbit with a smooth invariant curve weighted averages converge faster than any power of n, on a
    chaotic one like 1/√n.  In m narrow bands that follow each other most of the motion is periodic and converges too.
    Therefore the noise has the variance that is left without the part of period m, for m = 1 and for the m after which
    the orbit comes back closest.  The functions are the coordinates and their squares; for angles cos and sin.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    points : ndarray, shape (n, d)
        Points of the orbit.
    precision : float
        Error of the points, which does not count as irregularity.

    Returns
    -------
    float
        The ratio, the largest over the functions: about 1 for chaos, 0.01 to 0.04 for chaos in narrow bands, less than
        1e-3 for quasi-periodic orbits that have turned often enough; ∞ for orbits that come back much closer than the
        points of a curve do, as those of a long period.

    References
    ----------
    E. Sander, J. D. Meiss, Birkhoff averages and rotational invariant circles for area-preserving maps, Physica D 411
    (2020), 132569.
    """
    series = bounded_series(turns, points)
    both = np.concatenate([series, series**2], axis=1)
    half = len(both) // 2
    weight = _weights(half)
    off = np.abs(weight @ (both[:half] - both[half : 2 * half]))
    most = max(1, len(points) // _LEAST_REPEATS)
    gaps = [float(np.abs(difference(turns, points[m:], points[:-m])).max()) for m in range(1, most + 1)]
    closest = 1 + int(np.argmin(gaps))
    worst = math.inf if closest * min(gaps) < _TOO_CLOSE * max(gaps) else 0.0
    for m in (1, closest):
        count = len(both) // m
        repeats = both[: count * m].reshape(count, m, -1)
        left = ((repeats - repeats.mean(axis=0)) ** 2).sum(axis=(0, 1)) / (m * (count - 1))
        noise = np.sqrt(2.0 * float(weight @ weight) * left)
        worst = max(worst, float((off / (noise + precision)).max()))
    return worst


def bounded_series(turns: Sequence[float], points: Array) -> Array:
    """Return bounded functions along an orbit: cos and sin of angles; other coordinates, centred and scaled.

    A coordinate that is not an angle is given relative to its mean and divided by the largest range of a coordinate.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    points : ndarray, shape (n, d)
        Points of the orbit.

    Returns
    -------
    ndarray, shape (n, m)
        The functions: two for each angle, one for each other coordinate.
    """
    away = points - points.mean(axis=0)
    size = max(float(np.abs(away).max()), float(np.ptp(away, axis=0).max()), 1e-300)
    return np.column_stack(
        [
            one
            for i, turn in enumerate(turns)
            for one in (
                (np.cos(2.0 * math.pi * points[:, i] / turn), np.sin(2.0 * math.pi * points[:, i] / turn))
                if math.isfinite(turn)
                else (away[:, i] / size,)
            )
        ]
    )


def rotation_number(points: Array, centre: tuple[float, float] | None = None) -> tuple[float, float]:
    """Return the rotation number of an orbit and its estimated error.

    The error is the spread of the values for the orbit and its two halves.  It is large if the orbit has no invariant
    curve, and ½ if the turns cannot be counted.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        Points of the orbit, n ≥ 5.
    centre : (float, float), optional
        Point about which turns are counted.  By default the first coordinate is the angle that is counted, in radians.

    Returns
    -------
    number : float
        Rotation number in turns per point, in (−½, ½].
    error : float
        Its error, ≥ 0.

    Raises
    ------
    InvalidParameter
        For fewer than five points.
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
    means = [_weighted_mean(some) for some in (turns, turns[:half], turns[half:])]
    # Turns that spread over the whole circle are ambiguous by ±1, so their mean is undefined.
    error = 0.5 if np.ptp(turns) > _ALL_ROUND else float(np.ptp(means))
    return float(_within_half(means[0])), error


def _within_half(turns: Array | float) -> Array | float:
    """Return turns modulo 1 in (−½, ½]."""
    return turns - np.ceil(turns - 0.5)


def volume_sign(divergence: Array | float, error: Array | float) -> NDArray[np.int_]:
    """Return −1 where phase volume shrinks, 1 where it grows, and 0 where neither is significant.

    A mean divergence is significant if it exceeds three times its error plus 1e-9/T, the round-off of a zero.

    Parameters
    ----------
    divergence : ndarray or float
        Mean divergences, in 1/T.
    error : ndarray or float
        Their errors, of the same shape.

    Returns
    -------
    ndarray of int
        The signs, of the same shape.
    """
    seen = np.abs(divergence) > ERRORS * np.asarray(error) + 1e-9
    return np.where(seen, np.sign(divergence), 0.0).astype(int)


def batch_error(sums: Array, times: Array) -> tuple[Array, Array]:
    """Return the mean rates of sums over time, and their errors as described at `Spectrum`.

    Parameters
    ----------
    sums : ndarray, shape (n, m)
        Sums at each time.
    times : ndarray, shape (n,)
        Positive, evenly spaced times that divide into 12 stretches: n − 1 is a multiple of 12.

    Returns
    -------
    mean : ndarray, shape (m,)
        Mean rates.
    error : ndarray, shape (m,)
        Their errors.
    """
    length = float(times[-1] - times[0])
    mean = (sums[-1] - sums[0]) / length
    ends = sums[:: (times.size - 1) // STRETCHES]
    scatter = np.std(np.diff(ends, axis=0), axis=0, ddof=1) * STRETCHES / length / math.sqrt(STRETCHES)
    powers = np.column_stack([times, np.log(times), np.ones_like(times)])
    powers[:, 0] -= times[0]
    steady = np.linalg.lstsq(powers, sums, rcond=None)[0][0]
    return mean, np.hypot(scatter, mean - steady)


def ensemble_mean(values: Array) -> tuple[float, float]:
    """Return the mean over an ensemble of orbits, and its error.

    The true mean lies within three errors with 99.7 % confidence.

    Parameters
    ----------
    values : ndarray, shape (m, 4)
        The means along each orbit, m ≥ 2, over all the time and over three halves of it, see `window_rates`.

    Returns
    -------
    mean : float
        The mean over all orbits and all the time.
    error : float
        Its error, ≥ 0: the standard error of the scatter, widened by Student's t for few orbits, combined with an error
        that all orbits share and no scatter shows, estimated from the differences of the halves.
    """
    count = len(values)
    from scipy.special import stdtrit  # Imported here because the import takes 0.1 s.

    widened = float(stdtrit(count - 1, _ONE_SIDED)) / ERRORS
    whole, away = values[:, 0], values[:, 1:] - values[:, :1]
    shared = away.mean(axis=0) ** 2 - away.var(axis=0, ddof=1) / count
    scatter = widened * float(np.std(whole, ddof=1)) / math.sqrt(count)
    return float(whole.mean()), math.hypot(scatter, math.sqrt(float(shared.max(initial=0.0))))
