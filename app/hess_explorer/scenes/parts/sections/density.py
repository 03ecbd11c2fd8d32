"""A section shaded by the density of a million crossings, computed in stages."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Part, Start
from hess_explorer.scenes.framework.points import stages_of
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.framework.work import drift_status
from hess_explorer.scenes.parts.sections.section import Section
from hess_explorer.views.plane import density as view
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.section_density import Visits, visits
from hess_mechanics.numerics.accuracy import Kind, plan
from hess_mechanics.numerics.results import Array

_PIXELS = (512, 512)
_ORBITS = 128
"""More orbits would cover the gaps between the curves of islands."""
_FIRST = 32
"""Crossings of each orbit in the first stage; each further stage has twice as many."""
_STAGES = {"draft": 6, "standard": 8, "precise": 9, "reference": 10}
"""Stages by accuracy level: 1,044,480 crossings at `standard`."""
_LEVEL = plan(Kind.SECTION, "draft").level
"""Level of the orbits: in a million crossings its drift stays below a pixel, and finer ones show the same density."""


@dataclass(frozen=True, eq=False)
class SectionDensity(Part[Section]):
    """Crossings of orbits spread over the window, counted in its pixels.

    Each stage doubles the length of the orbits.

    Attributes
    ----------
    is_on : bool
        True to show the density.
    kinds : int
        Number of kinds of orbits, all forward in time; 0 for one kind for each direction of time of the section.
    kind_of : callable or None
        `kind_of(states)` returns the kinds (k,), from 0, of orbits with the starts (k, d); by default they alternate.
    """

    is_on: bool
    kinds: int = 0
    kind_of: Callable[[Array], Array] | None = None

    @cached_property
    def _kinds(self) -> list[tuple[int, tuple[Start, ...]]]:
        """Kind and starts of each group of orbits; there are at least two groups, for two cores."""
        starts = self.work.need(Task(_starts, self.host.poincare, self.host.frame))
        kinds: Array = np.arange(float(len(starts))) % len(self._ways)
        if self.kind_of is not None and starts:
            kinds = self.kind_of(np.array(starts))
        there = np.unique(kinds).tolist()
        parts = 2 if len(there) == 1 else 1
        return [
            (int(kind), tuple(starts[j] for j in np.flatnonzero(kinds == kind)[i::parts]))
            for kind in there
            for i in range(parts)
        ]

    @cached_property
    def _visits(self) -> list[Visits | None]:
        """The newest visits of each group of orbits; empty during a drag."""
        if not self.is_on or self.work.is_preview:
            return []
        where = self.host.poincare, self.host.frame
        return self.work.newest_results(
            [
                [
                    Task(_stage, *where, starts, self._ways[kind], self.host.second_half_only, i)
                    for i in range(self._stages)
                ]
                for kind, starts in self._kinds
            ]
        )

    @property
    def _ways(self) -> tuple[bool, ...]:
        """The direction of time of each kind."""
        return (True,) * self.kinds or self.host.directions

    @property
    def _stages(self) -> int:
        return stages_of(_ORBITS * _FIRST, _STAGES[self.work.level_name])[1]

    @property
    def points(self) -> int:
        """The number of known crossings in the window."""
        return sum(one.points for one in self._visits if one is not None)

    @cached_property
    def counts(self) -> tuple[Array, ...]:
        """Number of crossings in each pixel, (n, m), for each kind of orbits; empty until some are known."""
        counts = np.zeros((len(self._ways), *_PIXELS[::-1]), np.uint32)
        for (kind, _), one in zip(self._kinds, self._visits, strict=False):
            if one is not None:
                counts[kind] += one.counts
        return tuple(counts) if self.points else ()

    @cached_property
    def tones(self) -> Sequence[Array]:
        """The tones of each kind, see `views.plane.density.tones`; empty until some crossings are known."""
        return view.tones(self.counts) if self.counts else ()

    @property
    def phrase(self) -> str:
        """The number of crossings as a phrase; an empty string until some are known."""
        return f"{self.points:,} points; " if self.points else ""

    def status(self) -> Iterator[str]:
        """Yield the size and drift of the density."""
        if self.has_result("_visits") and self.points:
            yield f"density {self.points} crossings"
            yield from drift_status(one.drift for one in self._visits if one is not None)


def _starts(section: PoincareSection, window: Window) -> tuple[Start, ...]:
    """Return evenly spread starts in the part of the window that motions cross."""
    return section.spread(_ORBITS, window)


def _stage(
    section: PoincareSection, window: Window, starts: tuple[Start, ...], forward: bool, later: bool, number: int
) -> Visits:
    """Return the visits of some orbits up to a stage, or with `later` in this stage only."""
    if number == 0:
        return visits(section, window, _PIXELS, starts, _FIRST, forward, _LEVEL)
    before: Visits = Task(_stage, section, window, starts, forward, later, number - 1).get()
    found = visits(section, window, _PIXELS, before.ends, _FIRST << number, forward, _LEVEL)
    return found if later else found.combine(before)
