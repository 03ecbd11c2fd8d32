"""An orbit diagram shaded by the density of a million points, computed in stages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.families import Family
from hess_explorer.scenes.framework.part import Part
from hess_explorer.scenes.framework.periodic_search import Point
from hess_explorer.scenes.framework.points import stages_of
from hess_explorer.scenes.framework.work import drift_status
from hess_explorer.scenes.parts.diagrams.controls import BACKWARD, FALLING, RISING
from hess_explorer.scenes.parts.diagrams.growing_diagram import OrbitDiagram
from hess_explorer.views.plane import density as view
from hess_mechanics.dynamics.section_density import Visits, visits_over
from hess_mechanics.numerics.accuracy import Accuracy, Kind, cheapest, plan
from hess_mechanics.numerics.results import Array

_COLUMNS, _ROWS = 4, 512
"""Columns of pixels for each value of the parameter in the diagram, and rows."""
_GROUPS = 2
"""Groups of columns of each way, computed one after the other: for two cores, and so that points arrive soon."""
_TRANSIENT = 30
"""Crossings left out: the orbit of a column starts where the nearest value of the diagram ended, so it has settled."""
_FIRST, _GROWTH = 50_000, 4
"""Crossings in all columns in the first stage, and how many times as many each further stage has."""
_STAGES = {"draft": 2, "standard": 3, "precise": 3, "reference": 4}
"""Stages by accuracy level: about a million crossings at `standard`."""
_ERRORS = 100.0
"""Errors of the level in a pixel: an orbit that settles forgets its errors, so a coarse level shows the same."""
_NEAR = 3
"""Rows within which points of the falling way count as points of the rising one."""


@dataclass(frozen=True, eq=False)
class DiagramDensity(Part[OrbitDiagram]):
    """Points of the orbits of a diagram, counted in the pixels of the window.

    At each value the orbit starts at the point where the diagram has settled.  There are further columns between two
    values.  Each stage multiplies the length of the orbits.

    Attributes
    ----------
    forward : mapping of str to bool
        Direction of time of each way, True for forward, in drawing order.
    """

    forward: ClassVar[Mapping[str, bool]] = {BACKWARD: False, FALLING: True, RISING: True}

    @cached_property
    def _ends(self) -> dict[str, Array]:
        """The last points (n, 2) of each complete way, by increasing value of the parameter."""
        return {
            way: np.concatenate([one.ends for one in parts])[:: -1 if way == FALLING else 1]
            for way, parts in self.host.pieces.items()
            if self.host.progress[way] == self.host.parameter_values.size
        }

    @property
    def _columns(self) -> int:
        return _COLUMNS * self.host.parameter_values.size

    def _chains(self, way: str) -> list[list[Task[Visits]]]:
        """Return the stages of each group of columns of a way."""
        (x0, y0), (x1, y1) = self.host.frame
        ends = self._ends[way]
        shares = (np.arange(self._columns) + 0.5) / self._columns
        values = x0 + shares * (x1 - x0)
        starts = ends[np.rint(shares * (len(ends) - 1)).astype(int)]
        points, stages = stages_of(_FIRST, _STAGES[self.work.level_name], _GROWTH)
        first = max(1, points // (len(self.host.pieces) * self._columns))
        level = plan(Kind.SECTION, cheapest(_ERRORS * (y1 - y0) / _ROWS)).level
        groups = (
            _Columns(
                self.host.family,
                tuple(values[some].tolist()),
                self.host.side,
                (y0, y1),
                tuple(map(tuple, starts[some].tolist())),
                first,
                self.forward[way],
                level,
            )
            for some in np.array_split(np.arange(self._columns), _GROUPS)
        )
        return [[Task(_stage, one, number) for number in range(stages)] for one in groups]

    @cached_property
    def _visits(self) -> list[tuple[str, Visits | None]]:
        """Way and newest visits of each group of columns; empty while a slider is held."""
        if self.work.is_preview:
            return []
        chains = [(way, chain) for way in self.forward if way in self._ends for chain in self._chains(way)]
        found = self.work.newest_results([chain for _, chain in chains], last=True)
        return [(way, one) for (way, _), one in zip(chains, found, strict=True)]

    @property
    def points(self) -> int:
        """The number of known points in the window."""
        return sum(one.points for _, one in self._visits if one is not None)

    @property
    def _complete(self) -> bool:
        """True if all columns of all ways are known."""
        return {way for way, one in self._visits if one is not None} == set(self.host.pieces) and all(
            one is not None for _, one in self._visits
        )

    def counts(self, way: str) -> Array:
        """Return the number of points of a way in each pixel, (n, m)."""
        groups = [one.counts for name, one in self._visits if one is not None and name == way]
        return np.concatenate(groups, axis=1) if groups else np.zeros((_ROWS, self._columns), np.uint32)

    @cached_property
    def tones(self) -> Sequence[Array]:
        """The tones of each way, see `views.plane.density.tones`; empty until all columns are known."""
        if not (self._complete and self.points):
            return ()
        backward, back, there = (self.counts(way) for way in self.forward)
        from scipy.ndimage import maximum_filter1d

        near = maximum_filter1d(there, 2 * _NEAR + 1, axis=0) > 0
        # Draw falling points near rising points in the colour of the rising ones, so that only hysteresis stands out.
        return view.tones((backward, np.where(near, 0, back), there + np.where(near, back, 0)))

    @property
    def phrase(self) -> str:
        """The number of points as a sentence; an empty string until the density is shown."""
        return f"{self.points:,} points. " if self.tones else ""

    def status(self) -> Iterator[str]:
        """Yield the size and drift of the density."""
        if self.has_result("_visits") and self.points:
            yield f"density {self.points} points"
            yield from drift_status(one.drift for _, one in self._visits if one is not None)


@dataclass(frozen=True)
class _Columns:
    """Columns of pixels whose orbits are followed together; `first` crossings of each in the first stage."""

    family: Family
    values: tuple[float, ...]
    side: int
    reach: tuple[float, float]
    starts: tuple[Point, ...]
    first: int
    forward: bool
    level: Accuracy

    def visits(self, starts: Sequence[Point] | Array, transient: int, crossings: int) -> Visits:
        """Return the visits of orbits that start at these points."""
        some = self.family, self.values, self.side, self.reach, _ROWS
        return visits_over(*some, starts, transient, crossings, self.forward, self.level)


def _stage(columns: _Columns, number: int) -> Visits:
    """Return the visits of some columns, including earlier stages."""
    if number == 0:
        return columns.visits(columns.starts, _TRANSIENT, columns.first)
    before = Task(_stage, columns, number - 1).get()
    return columns.visits(before.ends, 0, columns.first * _GROWTH**number).combine(before)
