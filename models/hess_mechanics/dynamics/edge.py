"""Saddles on the boundary of two basins, whose stable manifolds bound them.

The segment between two points in different basins is halved until the orbits of its ends separate only after many
crossings.  Until then they follow the boundary and approach a set that attracts within it: on a smooth boundary, a
saddle.  Newton's method starts from there.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hess_mechanics.dynamics.periodic import Map, PeriodicOrbit, difference, find_periodic, images_of
from hess_mechanics.errors import ModelError, NotConverged
from hess_mechanics.numerics.results import Array

__all__ = ["saddle_between"]

_HALVINGS = 40
_CROSSINGS = 30
"""Number of crossings of an orbit along the boundary from which Newton's method may start."""
_MOST = 12
"""Largest period of a saddle."""


def saddle_between(map_: Map, one: Array, other: Array, number_of: Callable[[Array], int]) -> PeriodicOrbit:
    """Return a saddle on the boundary of basins between two points in different basins.

    Parameters
    ----------
    map_ : Map
        The return map.
    one, other : ndarray, shape (2,)
        Points in different basins.
    number_of : callable
        Function from a point (2,) to the number of its basin.

    Returns
    -------
    PeriodicOrbit
        The saddle, of kind "saddle" or "saddle with reflection" and a period up to 12.

    Raises
    ------
    NotConverged
        If no saddle is found, for example because the boundary is not smooth, or a point has no image.
    """
    a, b = np.asarray(one, float), one + difference(map_.turns, other, one)
    own = number_of(a)
    for _ in range(_HALVINGS):
        middle = 0.5 * (a + b)
        a, b = (middle, b) if number_of(middle) == own else (a, middle)
    orbits = [images_of(map_, end, _CROSSINGS) for end in (a, b)]
    both = min(map(len, orbits))
    away = np.abs(difference(map_.turns, orbits[0][:both], orbits[1][:both])).max(axis=1)
    # The two orbits approach the saddle before they separate: start Newton's method at their last common points.
    last = int(np.argmax(away > 1e-3)) if np.any(away > 1e-3) else both
    for first in range(max(0, last - _MOST - 1), -1, -_MOST):
        try:
            orbit = find_periodic(map_, orbits[0][first], None, _MOST)
        except ModelError:
            continue
        if orbit.kind.startswith("saddle"):
            return orbit
    raise NotConverged(f"No saddle up to period {_MOST} is found on the boundary here: choose two other points.")
