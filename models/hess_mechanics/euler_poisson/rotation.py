"""Rotation numbers of the orbits that start on a line across the section g = π/2 and lie on closed curves.

A closed curve that does not wind round in l, or about the first end of the line, has no rotation number: its points
librate in that angle, and their mean rotation is 0.  An orbit whose rotation number is 0 within `RESOLUTION` counts as
such a libration.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array

__all__ = ["RESOLUTION", "RotationProfile", "rotation_along", "states_on_line"]

RESOLUTION = 1e-4
"""Largest spread of the rotation numbers of an orbit on a closed curve and of its two halves, in turns."""
_FEWEST = 20

LineEnds = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True)
class RotationProfile(Result):
    """Rotation numbers of orbits that start on a line; the result of `rotation_along_line`.

    They lie in (−½, ½] or, if all of them are within half a turn of one another modulo 1, in an unbroken range with its
    middle in (−½, ½].  Positions on the line are l, in radians, if turns are counted about the first end, else L/G.

    Attributes
    ----------
    along : tuple of ndarray
        Positions of the starts of orbits with a rotation number, in parts without a gap or a jump of ρ.
    rho : tuple of ndarray
        Rotation numbers in turns per return, in the same parts.
    librations : ndarray, shape (n,)
        Positions of the starts on closed curves that do not wind round, and so have no rotation number.
    chaotic_intervals : ndarray, shape (n, 2)
        First and last position of each part of the line whose orbits do not lie on closed curves.
    """

    along: tuple[Array, ...]
    rho: tuple[Array, ...]
    librations: Array
    chaotic_intervals: Array

    def labels(self) -> Labels:
        """Return ρ over the position on the line, with NaN for both between two parts.

        Returns
        -------
        Labels
            The rotation numbers over the positions.
        """
        gap = np.full(1, np.nan)
        along, rho = ([piece for part in parts for piece in (part, gap)][:-1] for parts in (self.along, self.rho))
        empty = [np.empty(0)]
        return Labels(
            {"place": (("place",), np.concatenate(along or empty))},
            {"ρ": (("place",), np.concatenate(rho or empty))},
            {"ρ": "turns"},
        )

    @property
    def points(self) -> Array:
        """All positions with a rotation number, shape (n,)."""
        return np.concatenate([np.empty(0), *self.along])

    @property
    def numbers(self) -> Array:
        """All rotation numbers, shape (n,), in turns per return."""
        return np.concatenate([np.empty(0), *self.rho])

    @property
    def extremum(self) -> tuple[float, float] | None:
        """Position and value of the minimum of ρ, else of the maximum, if inside the line; None if ρ is monotonic.

        An extremum counts if it is not among the first or last two numbers and differs from both ends by more than
        3 `RESOLUTION`.
        """
        along, rho = self.points, self.numbers
        for i in (int(np.argmin(rho)), int(np.argmax(rho))) if rho.size else ():
            if 2 <= i <= len(rho) - 3 and min(abs(rho[i] - rho[0]), abs(rho[i] - rho[-1])) > 3 * RESOLUTION:
                return float(along[i]), float(rho[i])
        return None

    def distance(self, exact: RotationProfile) -> float:
        """Return the median of |ρ − ρ'| modulo 1 over the positions of this profile, with ρ' from another profile.

        ρ' is interpolated linearly between the positions of the other profile, also across its gaps.

        Parameters
        ----------
        exact : RotationProfile
            The other profile, with increasing positions.

        Returns
        -------
        float
            The median, in turns per return; NaN if one of the profiles has no rotation numbers.
        """
        if not (self.numbers.size and exact.numbers.size):
            return math.nan
        apart = self.numbers - np.interp(self.points, exact.points, exact.numbers)
        return float(np.median(np.abs(apart - np.round(apart))))


def states_on_line(section: AndoyerSection, ends: LineEnds, count: int) -> tuple[tuple[float, tuple[float, ...]], ...]:
    """Return the states of a section at the centres of equal parts of a line.

    Parameters
    ----------
    section : AndoyerSection
        The section.
    ends : LineEnds
        The two ends (l, L/G) of the line; l in radians.
    count : int
        Number of parts.

    Returns
    -------
    tuple of (float, tuple of float)
        Share of the way along the line, between 0 and 1, and the state, of each point that motions cross.

    Raises
    ------
    InvalidParameter
        If L/G is out of range.
    """
    shares = (np.arange(count) + 0.5) / count
    l, x = ((1.0 - shares) * a + shares * b for a, b in zip(*ends, strict=True))
    states, growing = section.states_at(l, x)
    return tuple(
        (float(share), tuple(map(float, state))) for share, state in zip(shares[growing], states[growing], strict=True)
    )


def rotation_along(
    ends: LineEnds,
    shares: Sequence[float],
    orbits: Sequence[Array],
    about_first: bool,
    count: int,
    resolved: float = RESOLUTION,
) -> RotationProfile:
    """Return the profile of orbits that start on a line.

    Parameters
    ----------
    ends : LineEnds
        The two ends (l, L/G) of the line; l in radians.
    shares : sequence of float
        Share of the way along the line of each start, increasing, as from `states_on_line`.
    orbits : sequence of ndarray, shape (n, 2)
        Crossings (l, L/G) of each orbit; orbits with fewer than 20 are left out.
    about_first : bool
        Count turns about the first end, over l; otherwise turns of the angle l, over L/G.
    count : int
        Number of starts on the whole line, also of those without motion.
    resolved : float, default RESOLUTION
        Largest spread of the rotation numbers of an orbit on a closed curve and of its halves; a rotation number of at
        most this size counts as 0.

    Returns
    -------
    RotationProfile
        The profile.
    """
    centre, axis = (ends[0], 0) if about_first else (None, 1)
    numbers = [
        (share, *rotation_number(points, centre))
        for share, points in zip(shares, orbits, strict=True)
        if len(points) >= _FEWEST
    ]
    going = [(share, turns) for share, turns, spread in numbers if spread <= resolved < abs(turns)]

    def point(share: Array) -> Array:
        return np.asarray((1.0 - share) * ends[0][axis] + share * ends[1][axis])

    along, rho = (np.array(column) for column in zip(*going, strict=True)) if going else (np.empty(0), np.empty(0))
    rho = _side_by_side(rho)
    # Split the curve at gaps, and at the jump from ½ to −½.
    cuts = np.flatnonzero((np.diff(along) > 1.5 / count) | (np.abs(np.diff(rho)) > 0.5)) + 1
    at_sea = np.array([share for share, _, spread in numbers if spread > resolved])
    coasts = np.flatnonzero(np.diff(at_sea) > 1.5 / count) + 1
    seas = [(part[0] - 0.5 / count, part[-1] + 0.5 / count) for part in np.split(at_sea, coasts) if part.size]
    return RotationProfile(
        tuple(np.split(point(along), cuts)),
        tuple(np.split(rho, cuts)),
        point(np.array([share for share, turns, spread in numbers if spread <= resolved and abs(turns) <= resolved])),
        point(np.array(seas).reshape(-1, 2)),
    )


def _side_by_side(rho: Array) -> Array:
    """Return the numbers (n,) shifted by integers to lie within half a turn, or unchanged if that is impossible."""
    order = np.sort(rho)
    for first in order:
        shifted = first + (rho - first) % 1.0
        if np.ptp(shifted) <= 0.5:
            return np.asarray(shifted - np.ceil(0.5 * (shifted.min() + shifted.max()) - 0.5))
    return rho
