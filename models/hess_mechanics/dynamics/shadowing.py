"""Up to which crossing a computed orbit of a section is the orbit of its start.

Where neighbours part, errors grow e-fold in some number of crossings, whatever the steps.  A chaotic orbit is then soon
another one: its points still lie on the section of its integrals, near an orbit from a start that is a little off
(shadowing), but they are not where the orbit of this start crosses.  Two runs of different accuracy tell up to where.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from hess_mechanics.numerics.results import Array

__all__ = ["HALF_A_PIXEL", "away_from", "errors_in_pixels", "right_crossings", "torn_away", "typical"]

HALF_A_PIXEL = 0.5
_LOST, _CHAOTIC, _NOTHING = 30.0, 30.0, 1e-6
"""Pixels by which an orbit is another one; by what the errors of the second half of an orbit exceed those of the first,
where neighbours part exponentially; and pixels that are round-off."""


def errors_in_pixels(
    orbit: Array, exact: Array, pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> Array:
    """Distances (m,) of the points of an orbit (n, 2) from those of a more exact run, as far as both go.

    pixels : per unit of each coordinate; periods : of each, ∞ for one that is no angle.
    """
    both = min(len(orbit), len(exact))
    away = np.asarray(orbit[:both] - exact[:both])
    for i, period in enumerate(periods):
        if math.isfinite(period):
            away[:, i] -= period * np.round(away[:, i] / period)
    return np.asarray(np.linalg.norm(away * np.asarray(pixels), axis=1), float)


def torn_away(away: Array) -> bool:
    """Whether chaos makes an orbit another one, from its errors (n,) in pixels, one after the other."""
    early, late = (float(part.max(initial=0.0)) for part in np.array_split(away, 2))
    return max(early, late) >= _LOST or late > max(_CHAOTIC * early, _NOTHING)


def away_from(points: Array, curve: Array) -> Array:
    """Distances (m,) of points (m, 2) from a broken line (n, 2), or from a single point (1, 2)."""
    if len(curve) == 1:
        return np.asarray(np.linalg.norm(points - curve, axis=1), float)
    start, along = curve[:-1], np.diff(curve, axis=0)
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    shares = np.clip(((points[:, None] - start) * along).sum(axis=2) / length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(points[:, None] - start - shares[..., None] * along, axis=2).min(axis=1), float)


def right_crossings(
    orbits: Sequence[Array], exact: Sequence[Array], pixels: Sequence[float], periods: Sequence[float] = (math.inf,) * 2
) -> tuple[int, ...]:
    """For each orbit (n, 2), how many of its first points lie within half a pixel of those of a more exact run."""
    counts = []
    for one, other in zip(orbits, exact, strict=True):
        wrong = np.flatnonzero(errors_in_pixels(one, other, pixels, periods) > HALF_A_PIXEL)
        counts.append(int(wrong[0]) if wrong.size else min(len(one), len(other)))
    return tuple(counts)


def typical(counts: Sequence[int]) -> int:
    """The median of counts, the lower one of two."""
    return sorted(counts)[(len(counts) - 1) // 2] if counts else 0
