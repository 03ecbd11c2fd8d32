"""Number of crossings for which a computed orbit of a section follows the exact orbit of its initial point.

If neighbouring orbits separate exponentially, so do errors, however small the steps.  A computed chaotic orbit soon
leaves the exact orbit of its initial point.  Its points still lie on the section, near the exact orbit of a slightly
different initial point (shadowing).  Comparing two runs of different accuracy shows how many crossings are correct.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from hess_mechanics.dynamics.periodic import difference
from hess_mechanics.numerics.results import Array

__all__ = [
    "HALF_A_PIXEL",
    "count_correct_crossings",
    "distances_to_curve",
    "errors_in_pixels",
    "has_diverged",
    "lower_median",
]

HALF_A_PIXEL = 0.5
_LOST, _CHAOTIC, _NOTHING = 30.0, 30.0, 1e-6
"""An error in pixels beyond which an orbit counts as a different one; the ratio of the errors of the second half of an
orbit to those of the first that indicates exponential separation; and an error in pixels that is only round-off."""


def errors_in_pixels(
    orbit: Array, exact: Array, pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> Array:
    """Return the distances between the points of an orbit and those of a more accurate run, in pixels.

    Parameters
    ----------
    orbit : ndarray, shape (n, 2)
        Points of the orbit.
    exact : ndarray, shape (k, 2)
        Points of the more accurate run.
    pixels : sequence of float
        Pixels per unit of each coordinate.
    periods : sequence of float, optional
        Period of each coordinate, ∞ if it is not an angle.

    Returns
    -------
    ndarray, shape (m,)
        Distances, where m is the length of the shorter run.
    """
    both = min(len(orbit), len(exact))
    away = difference(periods, orbit[:both], exact[:both])
    return np.asarray(np.linalg.norm(away * np.asarray(pixels), axis=1), float)


def has_diverged(away: Array) -> bool:
    """Return True if the errors show that a computed orbit has left the true orbit, as in chaos.

    Parameters
    ----------
    away : ndarray, shape (n,)
        Errors along the orbit, in pixels.

    Returns
    -------
    bool
        True if an error reaches 30 pixels, or the largest in the second half of the orbit exceeds both 30 times the
        largest in the first half and 1e-6 pixels.
    """
    early, late = (float(part.max(initial=0.0)) for part in np.array_split(away, 2))
    return max(early, late) >= _LOST or late > max(_CHAOTIC * early, _NOTHING)


def distances_to_curve(points: Array, curve: Array) -> Array:
    """Return the distances of points from a polyline.

    Parameters
    ----------
    points : ndarray, shape (m, 2)
        The points.
    curve : ndarray, shape (n, 2)
        Vertices of the polyline; a single one is a point.

    Returns
    -------
    ndarray, shape (m,)
        Distances.
    """
    if len(curve) == 1:
        return np.asarray(np.linalg.norm(points - curve, axis=1), float)
    start, along = curve[:-1], np.diff(curve, axis=0)
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    shares = np.clip(((points[:, None] - start) * along).sum(axis=2) / length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(points[:, None] - start - shares[..., None] * along, axis=2).min(axis=1), float)


def count_correct_crossings(
    orbits: Sequence[Array], exact: Sequence[Array], pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> tuple[int, ...]:
    """Count the first points of each orbit that lie within half a pixel of those of a more accurate run.

    Parameters
    ----------
    orbits : sequence of ndarray, shape (n, 2)
        Points of each orbit.
    exact : sequence of ndarray, shape (k, 2)
        Points of the more accurate run of each orbit.
    pixels : sequence of float
        Pixels per unit of each coordinate.
    periods : sequence of float, optional
        Period of each coordinate, ∞ if it is not an angle.

    Returns
    -------
    tuple of int
        The number of points of each orbit.
    """
    counts = []
    for one, other in zip(orbits, exact, strict=True):
        wrong = np.flatnonzero(errors_in_pixels(one, other, pixels, periods) > HALF_A_PIXEL)
        counts.append(int(wrong[0]) if wrong.size else min(len(one), len(other)))
    return tuple(counts)


def lower_median(counts: Sequence[int]) -> int | None:
    """Return the lower median of counts: the middle one, or the smaller of the two in the middle.

    Parameters
    ----------
    counts : sequence of int
        The counts.

    Returns
    -------
    int or None
        The median; None if there are no counts.
    """
    return sorted(counts)[(len(counts) - 1) // 2] if counts else None
