"""Ramps: orbits followed while a parameter changes, in pieces; their period doublings and ranges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.families import Family
from hess_explorer.scenes.framework.periodic_search import Point
from hess_explorer.views.layers import Range
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, cascade, diagram_over, first_doubling
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import ModelError, WorkLimit
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array

_TOGETHER = 30
"""Values of the parameter computed at once: few enough that points arrive soon."""
_DOUBLINGS = 4
_BOTH = 2.5
"""Largest height of attractor and repeller together, in heights of the attractor, at which both are in sight."""
_FEW_FAR = 0.05
"""Share of the values that do not count: at a few of them a motion may go far away for a moment."""
_ROOM, _LEAST = 0.1, 0.01
"""Room above and below, in heights of what is there, and at least in those of the section."""


@dataclass(frozen=True)
class Ramp:
    """An orbit followed while a parameter changes, in pieces.

    Attributes
    ----------
    family : Family
        The section over the parameter.
    values : tuple of float
        Values of the parameter.
    point : tuple of float
        Point of the section where the orbit starts without `previous`, and where it starts again after a gap.
    transient, count : int
        Largest number of omitted crossings and number of drawn crossings at each value.
    follow : bool
        True to start at the last point of the previous value; False to start at `point` again.
    level : Level
        Level of accuracy.
    backward : bool
        True to follow the orbit backward in time.
    previous : Ramp or None
        The ramp whose end is the start of this one.
    """

    family: Family
    values: tuple[float, ...]
    point: Point
    transient: int
    count: int
    follow: bool
    level: Level
    backward: bool = False
    previous: Ramp | None = None

    @property
    def pieces(self) -> range:
        """The indices of the pieces."""
        return range(-(-len(self.values) // _TOGETHER))

    def diagram(self, values: Sequence[float], start: Point) -> Diagram:
        """Return the orbit diagram over some values, starting at a point."""
        return diagram_over(
            lambda value: ReturnMap(self.family(value), self.level, self.backward),
            self.family.name,
            values,
            start,
            self.transient,
            self.count,
            self.follow,
            self.point,
        )


def piece(ramp: Ramp, number: int) -> Diagram:
    """Return the orbit diagram over one piece of a ramp; compute the previous pieces first."""
    return ramp.diagram(ramp.values[number * _TOGETHER : (number + 1) * _TOGETHER], _reached(ramp, number))


def _reached(ramp: Ramp, number: int) -> Point:
    """Return the last point of the orbit before a piece: of the last value with points, or of the previous ramp."""
    if number == 0:
        return ramp.point if ramp.previous is None else _reached(ramp.previous, len(ramp.previous.pieces))
    before: Diagram = Task(piece, ramp, number - 1).get()
    ends = before.ends[np.isfinite(before.ends).all(axis=1)]
    return tuple(ends[-1].tolist()) if len(ends) else _reached(ramp, number - 1)


def doublings(ramp: Ramp) -> Cascade | str:
    """Return the period doublings from the first visible one, or why none was located; "" if none is visible.

    Raises `WorkLimit`.
    """
    seen = first_doubling([Task(piece, ramp, number).get() for number in ramp.pieces])
    if seen is None:
        return ""
    value, points, end = seen
    family = ramp.family
    try:
        orbit = find_periodic(family.map_at(value), points, len(points))
        return cascade(family.map_at, family.name, orbit, value, end, _DOUBLINGS)
    except WorkLimit:
        raise
    except ModelError as error:
        return str(error)


def visible_range(ramp: Ramp, side: int, whole: Range) -> Range:
    """Return the range of a coordinate that contains the attractor, and the repeller if it is near, with a margin.

    Parameters
    ----------
    ramp : Ramp
        A ramp forward in time.
    side : int
        Index of the coordinate.
    whole : (float, float)
        Full range of the coordinate, to which the result is clipped; it is returned if the attractor has no points.
    """
    attractor, repeller = (
        [some[:, side] for some in way.diagram(way.values, way.point).points]
        for way in (ramp, replace(ramp, backward=True))
    )
    if not any(map(len, attractor)):
        return whole
    alone, both = _range(attractor), _range(attractor + repeller)
    low, high = both if both[1] - both[0] < _BOTH * (alone[1] - alone[0]) else alone
    room = max(_ROOM * (high - low), _LEAST * (whole[1] - whole[0]))
    return max(whole[0], low - room), min(whole[1], high + room)


def _range(parts: Sequence[Array]) -> Range:
    """Return the range of the points of some values, without the lowest and the highest of a small share of them."""
    lows, highs = zip(*((one.min(), one.max()) for one in parts if len(one)), strict=True)
    return float(np.quantile(lows, _FEW_FAR)), float(np.quantile(highs, 1.0 - _FEW_FAR))
