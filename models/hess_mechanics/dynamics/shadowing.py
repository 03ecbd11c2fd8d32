"""Number of crossings for which a computed orbit of a section follows the exact orbit of its initial point.

If neighbouring orbits separate exponentially, so do errors, however small the steps.  A computed chaotic orbit soon
leaves the exact orbit of its initial point.  Its points still lie on the section, near the exact orbit of a slightly
different initial point (shadowing).  Comparing two runs of different accuracy shows how many crossings are correct.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from hess_mechanics.dynamics.periodic import apart
from hess_mechanics.numerics.results import Array

__all__ = ["HALF_A_PIXEL", "away_from", "errors_in_pixels", "right_crossings", "torn_away", "typical"]

HALF_A_PIXEL = 0.5
_LOST, _CHAOTIC, _NOTHING = 30.0, 30.0, 1e-6
"""An error in pixels beyond which an orbit counts as a different one; the ratio of the errors of the second half of an
orbit to those of the first that indicates exponential separation; and an error in pixels that is only round-off."""


def errors_in_pixels(
    orbit: Array, exact: Array, pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> Array:
    """Return distances (m,), in pixels, between the points of an orbit (n, 2) and those of a more accurate run.

    m is the length of the shorter run.  pixels : pixels per unit of each coordinate; periods : period of each
    coordinate, ∞ if it is not an angle.
    """
    both = min(len(orbit), len(exact))
    away = apart(periods, orbit[:both], exact[:both])
    return np.asarray(np.linalg.norm(away * np.asarray(pixels), axis=1), float)


def torn_away(away: Array) -> bool:
    """Return True if the errors (n,) along an orbit, in pixels, show that chaos makes it a different orbit."""
    early, late = (float(part.max(initial=0.0)) for part in np.array_split(away, 2))
    return max(early, late) >= _LOST or late > max(_CHAOTIC * early, _NOTHING)


def away_from(points: Array, curve: Array) -> Array:
    """Return the distances (m,) of points (m, 2) from a polyline (n, 2), or from a single point (1, 2)."""
    if len(curve) == 1:
        return np.asarray(np.linalg.norm(points - curve, axis=1), float)
    start, along = curve[:-1], np.diff(curve, axis=0)
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    shares = np.clip(((points[:, None] - start) * along).sum(axis=2) / length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(points[:, None] - start - shares[..., None] * along, axis=2).min(axis=1), float)


def right_crossings(
    orbits: Sequence[Array], exact: Sequence[Array], pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> tuple[int, ...]:
    """Count, for each orbit (n, 2), the first points that lie within half a pixel of those of a more accurate run."""
    counts = []
    for one, other in zip(orbits, exact, strict=True):
        wrong = np.flatnonzero(errors_in_pixels(one, other, pixels, periods) > HALF_A_PIXEL)
        counts.append(int(wrong[0]) if wrong.size else min(len(one), len(other)))
    return tuple(counts)


def typical(counts: Sequence[int]) -> int | None:
    """Return the lower median of the counts; None if there are none, of which nothing is known."""
    return sorted(counts)[(len(counts) - 1) // 2] if counts else None
