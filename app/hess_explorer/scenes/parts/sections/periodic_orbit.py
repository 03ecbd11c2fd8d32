"""The periodic orbit that Newton's method finds near the chosen point, and the manifolds of a saddle."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Part
from hess_explorer.scenes.framework.periodic_search import (
    ANY,
    LENGTH_REACHED,
    MAX_CROSSINGS,
    MAX_POINTS,
    NONE,
    PERIODS,
    BranchChoice,
    ClosedOrbit,
    NotFound,
    Search,
    branch_of,
    crossings_between,
    find_orbit,
)
from hess_explorer.scenes.framework.sliders import choice, number
from hess_explorer.scenes.framework.windows import pixels_in
from hess_explorer.scenes.parts.sections.section import Section
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Layers
from hess_explorer.views.plane import periodic as view
from hess_explorer.views.text import conjugates, digits
from hess_mechanics.dynamics import periodic as mechanics
from hess_mechanics.dynamics.manifolds import Intersection, Manifold
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.numerics.accuracy import PRECISE, Status

T = TypeVar("T")

_WHOLE = 3
"""Largest period for which the manifolds of all points are drawn: they are images of one another."""


def choice_of_orbit() -> Any:
    """Declare the choice of a periodic orbit, by its period, in place of the chosen orbit."""
    return choice(
        "Periodic orbit",
        (NONE, *PERIODS),
        NONE,
        group="State",
        doc="Replaces the chosen orbit by a periodic one that Newton's method finds near it. The period is "
        "its number of points in the section. A saddle shows its manifolds.",
    )


def length_of_manifolds() -> Any:
    """Declare the length of the manifolds of a saddle."""
    return number(
        "s",
        5.0,
        (0.0, 20.0),
        0.5,
        bounds=(0.0, 100.0),
        label="Length of manifolds",
        group="Computation",
        doc=f"Length of each branch, in units of the axes of the section; at most {MAX_POINTS} points.",
    )


@dataclass(frozen=True, eq=False)
class SectionPeriodicOrbit(Part[Section]):
    """A periodic orbit in place of the chosen orbit of a section.

    Attributes
    ----------
    period : str
        One of `PERIODS`, or `NONE`.
    reach : float
        Length of the manifolds of a saddle, in units of the axes.
    """

    period: str
    reach: float

    @property
    def is_on(self) -> bool:
        """True if a periodic orbit is requested."""
        return self.period != NONE

    @property
    def _search(self) -> Search | None:
        """The arguments of `find_orbit`; None if there is nothing to search for."""
        if not self.is_on or self.host.start_point is None:
            return None
        # The error of an unstable orbit grows along it.
        level, held = self.work.level, self.work.is_preview
        level = level if held else max(level, PRECISE, key=lambda rung: rung.order)
        return ReturnMap(self.host.poincare, level), self.host.start_point, PERIODS[self.period], held

    @cached_property
    def _result(self) -> ClosedOrbit | NotFound | None:
        if self._search is None:
            return None
        task = Task(find_orbit, *self._search)
        return self.work.need(task, preview=task if self.work.is_preview else None)

    @property
    def is_searching(self) -> bool:
        """True while the requested orbit is being searched for; False after a search without result, too."""
        return self._search is not None and self._result is None

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The periodic orbit; None if none is requested or known."""
        return self._result if isinstance(self._result, ClosedOrbit) else None

    @property
    def _manifold_key(self) -> tuple[Search, list[BranchChoice], float] | None:
        """Cache key of a saddle's manifolds: search, branches, size of a pixel; None for any other orbit."""
        orbit = self._saddle
        if orbit is None or self._search is None:
            return None
        indices = range(orbit.period if orbit.period <= _WHOLE else 1)
        return (
            self._search,
            [(index, stable, side) for index in indices for stable in (True, False) for side in (1, -1)],
            1.0 / max(pixels_in(self.host.frame)),
        )

    @cached_property
    def _branches(self) -> list[Manifold | NotFound] | None:
        """The branches of a saddle's manifolds, empty for any other orbit; None until all are known."""
        if self._manifold_key is None:
            return []
        if self.work.is_preview:
            return None
        search, branches, pixel = self._manifold_key
        found = [self.work.need(Task(branch_of, search, one, self.reach, pixel), preview=None) for one in branches]
        return _all(found)

    @property
    def manifolds(self) -> list[Manifold]:
        """The drawn branches of the manifolds of a saddle; empty until all are known."""
        return [one for one in self._branches or () if isinstance(one, Manifold)]

    @cached_property
    def _intersections(self) -> list[tuple[Intersection, ...]] | None:
        """The crossings of each unstable branch with each stable one; None until all are known."""
        if self._manifold_key is None or not self._branches:
            return None
        search, branches, pixel = self._manifold_key
        found = [
            self.work.need(Task(crossings_between, search, one, other, self.reach, pixel), preview=None)
            for one in branches
            if not one[1]
            for other in branches
            if other[1]
        ]
        return _all(found)

    @property
    def homoclinic(self) -> list[Intersection]:
        """The reliable crossings of the drawn manifolds of a saddle; empty until all are known."""
        return [one for some in self._intersections or () for one in some if one.is_certain]

    @property
    def _saddle(self) -> mechanics.PeriodicOrbit | None:
        """The periodic orbit, if its manifolds are drawn."""
        wanted = (
            self.closed_orbit is not None and self.closed_orbit.orbit.kind.startswith("saddle") and self.reach > 0.0
        )
        return self.closed_orbit.orbit if self.closed_orbit is not None and wanted else None

    @property
    def growth(self) -> tuple[float, float] | None:
        """Growth rate ln|μ₁|/T and mean divergence ln|μ₁μ₂|/T of the periodic orbit; None without a periodic orbit."""
        if self.closed_orbit is None:
            return None
        sizes = np.abs(self.closed_orbit.orbit.multipliers)
        with np.errstate(divide="ignore"):
            logarithms = np.log(sizes) / self.closed_orbit.time
        # If the flow preserves volume, the sum is round-off only.
        return float(logarithms[0]), round(float(logarithms.sum()), 9) + 0.0

    # ---- texts --------------------------------------------------------------------------------------------------

    def idle_values(self) -> Mapping[str, float]:
        """Return the length of the manifolds if it has no effect, otherwise nothing."""
        return {} if self.is_on or not self.host.is_exclusive else {"reach": self.reach}

    @property
    def caption(self) -> Caption | None:
        """The caption of the section if a periodic orbit is requested; otherwise None."""
        if not self.is_on or self.host.start_point is None:
            return None
        if self.is_searching:
            return Caption("Searching for a periodic orbit.")
        if self.closed_orbit is None:
            which = "No periodic orbit" if self.period == ANY else f"No orbit of {self.period}"
            return Caption(f"{which} found near this point.", "The chosen orbit is shown.")
        orbit = self.closed_orbit.orbit
        # An imaginary part within the error counts as 0: at a double multiplier 1 its sign depends on round-off.
        first = complex(orbit.multipliers[0])
        multipliers = (
            conjugates(first)
            if abs(first.imag) > orbit.multiplier_error
            else ", ".join(digits(float(one.real)) for one in orbit.multipliers)
        )
        return Caption(
            f"Period {orbit.period}, {orbit.kind}.",
            f"Multipliers μ = {multipliers}, error {digits(orbit.multiplier_error, 1)}.",
        )

    def quantities(self) -> Iterator[str]:
        """Yield the period T, the error of the points, the symmetries and the drawn manifolds."""
        if self.closed_orbit is None:
            return
        orbit = self.closed_orbit.orbit
        yield f"T = {digits(self.closed_orbit.time)}, periodic; error of its points {digits(orbit.error_estimate, 1)}"
        yield from (f"symmetric under {name}" for name in orbit.symmetric)
        if self._saddle is not None and self._branches is None:
            yield self.work.pending_caption("Its manifolds are")
        elif self._branches:
            whole = sum(_end_reason(one) == LENGTH_REACHED for one in self._branches)
            yield f"{whole} of {len(self._branches)} branches of its manifolds are drawn to length {digits(self.reach)}"
            yield self._about_crossings()

    def status(self) -> Iterator[str]:
        """Yield the cost of Newton's method and the error of the manifolds."""
        if self.closed_orbit is not None:
            orbit = self.closed_orbit.orbit
            yield (
                f"Newton's method: {orbit.iterations} steps, condition {digits(orbit.condition, 2)} ({orbit.status})"
            )
        if self.manifolds:
            yield (
                f"manifolds {sum(len(one.points) for one in self.manifolds)} points, error across ≤ "
                f"{max(one.error_estimate for one in self.manifolds):.1e}"
            )

    def notes(self) -> Iterator[str]:
        """Yield why there is no periodic orbit or why its manifolds end, and notes on their accuracy and crossings."""
        if isinstance(self._result, NotFound):
            yield self._result.reason
        reasons = {_end_reason(one) for one in self._branches or ()} - {LENGTH_REACHED}
        yield from (f"A branch of a manifold ends early. {reason}" for reason in sorted(reasons))
        if any(one.status is not Status.OK for one in self.manifolds):
            yield (
                "The manifolds are not known to half a pixel: choose a shorter length of manifolds, or a higher "
                "accuracy."
            )
        apart = sum(not one.is_certain for some in self._intersections or () for one in some)
        if apart:
            yield (
                f"At {apart} more point{'s' * (apart > 1)} the manifolds meet within their error: whether they "
                "cross there is not known."
            )
        orbit = self._saddle
        if orbit is not None and orbit.period > _WHOLE:
            yield f"The manifolds are drawn for one of its {orbit.period} points; those of the others are their images."

    def _about_crossings(self) -> str:
        """Return a sentence on the number of homoclinic points and their error."""
        if self._intersections is None:
            return self.work.pending_caption("Where they cross is")
        found = self.homoclinic
        if not found:
            return "No homoclinic point is visible on the drawn parts of the manifolds"
        least = "at least " if any(len(some) == MAX_CROSSINGS for some in self._intersections) else ""
        return (
            f"{least}{len(found)} homoclinic point{'s' * (len(found) > 1)} on the drawn parts of the manifolds, error "
            f"{digits(max(one.error for one in found), 1)}; longer manifolds cross more often"
        )


def _all(results: Sequence[T | None]) -> list[T] | None:
    """Return the results; None until all are known."""
    known = [one for one in results if one is not None]
    return known if len(known) == len(results) else None


def _end_reason(branch: Manifold | NotFound) -> str:
    return branch.end_reason if isinstance(branch, Manifold) else branch.reason


class _Bounds(Protocol):
    @property
    def saddles(self) -> Sequence[mechanics.PeriodicOrbit]:
        """The saddles on the boundaries of basins."""

    @property
    def manifolds(self) -> Sequence[Manifold]:
        """The stable manifolds of these saddles."""


def periodic_layers(bounds: Callable[[Any], _Bounds | None] = lambda s: None) -> Layers[Any]:
    """Return the layers of the periodic orbit in a section, and of the saddles and manifolds of basin boundaries.

    `bounds(state)` returns these saddles and manifolds, or None.
    """

    def orbits(s: Any) -> list[mechanics.PeriodicOrbit]:
        closed, bounding = s.periodic_orbit.closed_orbit, bounds(s)
        own = [] if closed is None else [closed.orbit]
        return own if bounding is None else [*own, *bounding.saddles]

    def manifolds(s: Any) -> list[Manifold]:
        bounding = bounds(s)
        return [*s.periodic_orbit.manifolds, *([] if bounding is None else bounding.manifolds)]

    return view.layers(orbits, manifolds, lambda s: s.periodic_orbit.homoclinic)
