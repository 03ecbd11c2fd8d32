"""Starts of orbits chosen by clicks, in a section whose window is filled with other orbits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Points, Values, points_of, points_text
from hess_explorer.scenes.framework.orbit_batches import batches
from hess_explorer.scenes.framework.part import Host, Part, Start
from hess_explorer.scenes.framework.periodic_search import ClosedOrbit
from hess_explorer.scenes.framework.sliders import number, specs_of
from hess_explorer.scenes.framework.windows import Window, box_window
from hess_explorer.scenes.parts.sections.section import Section
from hess_explorer.views import theme
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

Point = tuple[float, float]


def orbits_spread(default: float, longest: float, most: float) -> Any:
    """Declare the number of orbits that fill a window; its slider ends at `longest`, typed values at `most`."""
    return number(
        "n",
        default,
        (0.0, longest),
        1.0,
        bounds=(0.0, most),
        label="Orbits",
        group="Computation",
        doc="Number of orbits spread over the window.",
    )


def points_of_each(default: float) -> Any:
    """Declare the number of crossings of each orbit of a filled section."""
    return number(
        "N",
        default,
        (20.0, 1000.0),
        10.0,
        bounds=(2.0, 4000.0),
        label="Crossings",
        group="Computation",
        doc="Number of points of each orbit.",
    )


class _Filled(PoincareSection, Protocol):
    def forbidden_cells(self, window: Window) -> Array:
        """Return cells (m, n) over the window: 1 in the forbidden region."""


class _Host(Host, Protocol):
    @property
    def poincare(self) -> _Filled:
        """The section in its coordinates.  Raises `ModelError`."""

    @property
    def section(self) -> Section:
        """The section, with its visible window."""

    @property
    def starts(self) -> str:
        """The points where the chosen orbits start, as in a link."""

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The periodic orbit; None if unknown."""


@dataclass(frozen=True)
class _Chosen:
    """The starts of the orbits chosen by clicks; the last one is the current orbit.

    Attributes
    ----------
    points : sequence of tuple
        Points in the section.
    states : sequence of tuple
        States (d,) at these points.
    forbidden_cells : tuple or None
        Chosen point of the current orbit, if no motion is possible there; otherwise None.
    """

    points: Sequence[Point]
    states: Sequence[Start]
    forbidden_cells: Point | None = None


@dataclass(frozen=True, eq=False)
class Clicks(Part[_Host]):
    """Orbits that start where the user has clicked in a section.

    Attributes
    ----------
    reason : str
        Reason why some points have no orbit, such as "no motion has this energy".
    remedy : str
        Suggested change, after "choose".
    """

    reason: str
    remedy: str = "a larger h"

    @property
    def _spec(self) -> Points:
        """The specification of the parameter `starts`."""
        return next(one for one in specs_of(type(self.host)) if isinstance(one, Points) and one.name == "starts")

    def corrections(self, notes: list[str]) -> Values:
        """Return the starts, at least one, as a change of the parameter."""
        return {"starts": self.host.starts or self._spec.default}

    @cached_property
    def selection(self) -> _Chosen:
        """The chosen starts with a motion; if the last start has no motion, another start replaces them all.

        Raises `InvalidParameter` if no motion is possible in the window.
        """
        chosen = points_of(self.host.starts)
        states, possible = self.host.poincare.states_at(*np.array(chosen).T)
        if possible[-1]:
            there = np.flatnonzero(possible).tolist()
            return _Chosen([chosen[i] for i in there], [tuple(map(float, states[i])) for i in there])
        others = [start for some in self.host.section.seeds(self.host.section) for start in some]
        others = others or [*_spread(self.host, 1)]
        if not others:
            raise InvalidParameter(
                f"In this window {self.reason}: choose {self.remedy}, or More → Remove clicks and boxes."
            )
        return _Chosen([_point(self.host.poincare.points_of(np.array(others))[0])], [others[0]], chosen[-1])

    @property
    def rings(self) -> list[Point]:
        """The points where the chosen orbits start; a periodic orbit replaces the current orbit, which is the last."""
        closed = self.host.closed_orbit
        return (
            [*self.selection.points]
            if closed is None
            else [*self.selection.points[:-1], _point(closed.orbit.points[0])]
        )

    @property
    def colour(self) -> int:
        """Index of the colour of the current orbit in `theme.CHOSEN`."""
        return (len(self.selection.points) - 1) % len(theme.CHOSEN)

    @cached_property
    def forbidden_cells(self) -> Array:
        """Cells (m, n) over the window: 1 in the forbidden region."""
        return self.work.need(
            Task(type(self.host.poincare).forbidden_cells, self.host.poincare, self.host.section.frame)
        )

    def add(self, x: float, y: float) -> Values:
        """Return the starts with another orbit added at (x, y), clamped to the bounds, as a parameter."""
        return {"starts": points_text([*self.selection.points, self._inside(x, y)])}

    def move(self, x: float, y: float) -> Values:
        """Return the starts with the current orbit moved to (x, y), clamped to the bounds, as a parameter."""
        return {"starts": points_text([*points_of(self.host.starts)[:-1], self._inside(x, y)])}

    def box_window(self, corners: tuple[float, float, float, float]) -> Values:
        """Return the window that a box selects; empty for a box without area."""
        return box_window(corners, (self._spec.low, self._spec.high))

    def _inside(self, x: float, y: float) -> Point:
        (x0, y0), (x1, y1) = self._spec.low, self._spec.high
        return min(max(x, x0), x1), min(max(y, y0), y1)

    def _at(self, point: Point) -> str:
        names = self.host.poincare.names
        return ", ".join(f"{name} = {digits(value)}" for name, value in zip(names, point, strict=True))

    def quantities(self) -> Iterator[str]:
        """Yield the start of the current orbit."""
        yield f"chosen: {self._at(self.rings[-1])}"

    def notes(self) -> Iterator[str]:
        """Yield a note if no motion is possible at the chosen start."""
        if self.selection.forbidden_cells is not None:
            yield (
                f"At {self._at(self.selection.forbidden_cells)} {self.reason}: the chosen orbit starts at "
                f"{self._at(self.selection.points[0])}."
            )


def filled_section(state: Any, held: int, **more: Any) -> Section:
    """Return the section of a state with the orbits of its `clicks`, and `state.orbits` others that fill the window.

    Parameters
    ----------
    state : FilledState
        The state.
    held : int
        Largest number of other orbits during a drag.
    **more
        Other arguments of `Section`.
    """

    def seeds(section: Section) -> list[tuple[Start, ...]]:
        count = int(state.orbits)
        return [*batches(_spread(state, min(count, held) if section.work.is_preview else count))]

    return Section(
        state,
        lambda: state.clicks.selection.states,
        seeds=seeds,
        is_immediate=False,
        **more,
    )


def _spread(state: _Host, count: int) -> tuple[Start, ...]:
    return state.work.need(Task(type(state.poincare).spread, state.poincare, count, state.section.frame))


def _point(point: Array) -> Point:
    return float(point[0]), float(point[1])
