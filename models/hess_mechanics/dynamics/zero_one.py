"""The 0–1 test for chaos of Gottwald and Melbourne (2009), from a time series alone, without neighbouring orbits."""

from __future__ import annotations

import math

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

__all__ = ["LEAST", "zero_one_of_bands", "zero_one_test"]

_FREQUENCIES = math.pi * (0.2 + 0.6 * (np.arange(1, 33) * (math.sqrt(5.0) - 1.0) / 2.0 % 1.0))
"""Frequencies c, away from 0 and π, spread by the golden ratio; the median over them ignores resonances."""
_LAGS = 50
LEAST = 100
"""Minimum number of crossings."""
_IN_A_BAND = 200
"""Minimum number of crossings of a thinned series."""


def zero_one_test(series: Array) -> float:
    """Return K, close to 1 for a chaotic series and close to 0 for a quasi-periodic or periodic series.

    The series drives a translation p(n + 1) = p(n) + φ(n) e^{icn} of the plane.  Its mean-square displacement over a
    lag grows linearly in the lag for chaotic series and stays bounded for regular ones; K is the correlation of that
    displacement with the lag, the median over 32 frequencies c.

    Parameters
    ----------
    series : ndarray, shape (n,)
        One number for each crossing, n ≥ 100.

    Returns
    -------
    float
        K in [−1, 1]; 0 for a constant series.

    Raises
    ------
    InvalidParameter
        For fewer than 100 numbers.

    References
    ----------
    G. A. Gottwald, I. Melbourne, On the implementation of the 0–1 test for chaos, SIAM J. Appl. Dyn. Syst. 8 (2009),
    129–145.

    Examples
    --------
    >>> import numpy as np
    >>> from hess_mechanics.dynamics.zero_one import zero_one_test
    >>> bool(zero_one_test(np.cos(np.arange(1000.0))) < 0.1)
    True
    """
    if len(series) < LEAST:
        raise InvalidParameter(
            f"The 0–1 test needs {LEAST} crossings, but there are {len(series)}: follow the motion for longer."
        )
    phi = np.array(series, float)
    n = phi.size
    # A mean that is far from 0 drowns the displacement in an oscillation; without it the formula needs no correction.
    phi -= phi.mean()
    path = np.cumsum(phi * np.exp(1j * np.outer(_FREQUENCIES, np.arange(n))), axis=1)
    lags = np.unique(np.linspace(1, n // 10, _LAGS).astype(int))
    displacement = np.array([np.mean(np.abs(path[:, lag:] - path[:, :-lag]) ** 2, axis=1) for lag in lags])
    away, along = displacement - displacement.mean(axis=0), lags - lags.mean()
    spread = np.sqrt((away**2).sum(axis=0) * (along**2).sum())
    return float(np.median(along @ away / np.where(spread > 0.0, spread, 1.0)))


def zero_one_of_bands(series: Array) -> float:
    """Return the largest K of the 0–1 test of every number of a series, every second, every fourth and so on.

    A chaotic orbit that visits narrow bands in turn is almost periodic, so that K of all its crossings is close to 0.
    A series is thinned as long as at least 200 numbers are left.

    Parameters
    ----------
    series : ndarray, shape (n,)
        One number for each crossing, n ≥ 100.

    Returns
    -------
    float
        K in [−1, 1].

    Raises
    ------
    InvalidParameter
        For fewer than 100 numbers.
    """
    halvings = max(1, (len(series) // _IN_A_BAND).bit_length())
    return max(zero_one_test(series[:: 2**i]) for i in range(halvings))
