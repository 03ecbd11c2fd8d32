"""The regime of a motion: its kind, its attractor and its repeller."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import HasSection, Part
from hess_explorer.scenes.framework.periodic_search import Point
from hess_explorer.views.caption import Caption
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.regime import Dynamics, comparison, regime
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import NoReturn
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.results import Array, as_read_only

_NOTHING = np.empty((0, 2))
_LONG = 500, 1500
"""Numbers of crossings before a set and in it."""
_MANY = 24
"""Largest number of points drawn as large marks, because so few dots would be hard to see."""


class _Host(HasSection, Protocol):
    @property
    def point(self) -> tuple[float, float]:
        """The start of the motion.  Raises `ModelError`."""


@dataclass(frozen=True, eq=False)
class OrbitRegime(Part[_Host]):
    """The kind of motion that starts at a point of a section, with its attractor and its repeller.

    Attributes
    ----------
    long : float
        The averaging time of the divergence.
    """

    long: float

    @property
    def _map(self) -> ReturnMap:
        return ReturnMap(self.host.poincare, self.work.plan(Kind.SECTION).level)

    @cached_property
    def sets(self) -> tuple[Array, Array]:
        """Points (n, 2) of attractor and repeller; empty until known, fewer during a drag."""
        few = (60, 120) if self.work.is_preview else _LONG
        task = Task(sets_of, self._map, self.host.point, *few)
        return self.work.need(task, preview=task if self.work.is_preview else None) or (_NOTHING, _NOTHING)

    @cached_property
    def kind(self) -> Dynamics | None:
        """The kind of motion and of dynamics; None until known, and during a drag."""
        if self.work.is_preview:
            return None
        duration = self.work.plan(Kind.EXPONENT).share * self.long
        task = Task(_dynamics, self._map, self.host.point, *_LONG, duration)
        # Classify the motion after the orbits and doublings of the diagram, because it takes as long as all of these.
        return self.work.newest_results([[task]], last=True)[0]

    @property
    def caption(self) -> Caption:
        """The caption: kind of motion, and whether it is conservative or dissipative."""
        found = self.kind
        if found is None:
            return Caption(self.work.pending_caption())
        motion = found.motion
        kind = f"Period {motion.period}" if motion.period else motion.kind.words.capitalize()
        if not found.comparisons:
            return Caption(f"{kind}.", "Attractor and repeller are not compared: too few returns.")
        if found.verdict == "not told apart":
            return Caption(
                f"{kind}.", f"Attractor and repeller not distinguished; |mean div| < {digits(motion.bound, 1)}."
            )
        if motion.map_.preserves_volume:
            return Caption(f"{kind}. Conservative: volume is preserved.")
        if motion.measure:
            return Caption(f"{kind}. Conservative: mean div = 0.", f"{motion.measure[0].upper()}{motion.measure[1:]}.")
        div = f"div = {digits(motion.divergence, 2)} ± {digits(motion.divergence_error, 1)}"
        away = f"{digits(found.distance, 2)} ± {digits(found.distance_error, 1)} away"
        # Keep the caption short: a small cell has room for four lines.
        return Caption(f"{kind}. Looks {found.verdict}.", f"{div}; repeller {away}.")


def sets_of(map_: ReturnMap, start: Point, transient: int, crossings: int) -> tuple[Array, Array]:
    """Return the attractor and the repeller, each (n, d), of the orbit from a point of a section.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section, forward in time.
    start : tuple of float
        Point (d,) where the orbit starts.
    transient : int
        Number of crossings before each set.
    crossings : int
        Number of crossings n of each set; fewer, down to 0, if the orbit stops returning.

    Raises
    ------
    OutsideRegion
        If no motion is possible at the start.
    WorkLimit
        If the orbit needs too many steps.
    """
    attractor, repeller = (
        as_read_only(one.orbit(np.array(start), transient + crossings)[transient:].copy())
        for one in (map_, map_.inverse())
    )
    return attractor, repeller


def _dynamics(map_: ReturnMap, start: Point, transient: int, crossings: int, duration: float) -> Dynamics:
    """Classify the orbit from `start`, without comparing its sets if it does not return."""
    motion = regime(map_, start, transient, min(crossings, 400), duration)
    try:
        return comparison(map_, motion, start, transient, crossings)
    except NoReturn:
        return Dynamics(motion, motion.points[:0], motion.points[:0], ())


def distinct_points(points: Array) -> Array | None:
    """Return the distinct points (2, m) of points (n, 2), to be drawn as large marks; None for none or more than 24."""
    _, first = np.unique(np.round(points, 4), axis=0, return_index=True)
    return points[first].T if 0 < len(first) <= _MANY else None
