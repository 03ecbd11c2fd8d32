"""An orbit diagram of a section over one parameter, computed in pieces, and a branch over it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values, points_of, points_text
from hess_explorer.scenes.framework.continuation import Continuation
from hess_explorer.scenes.framework.families import BranchStart, Family
from hess_explorer.scenes.framework.part import Part, Start
from hess_explorer.scenes.framework.periodic_search import NONE, PERIODS
from hess_explorer.scenes.framework.windows import Window, normalized_window, window_of
from hess_explorer.scenes.parts.diagrams.controls import (
    BACKWARD,
    COORDINATES,
    FALLING,
    FARTHEST,
    FOLLOWED,
    RISING,
    WAYS,
    DiagramControls,
)
from hess_explorer.scenes.parts.diagrams.ramps import Ramp, doublings, piece, visible_range
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Range
from hess_explorer.views.plane.section_plane import concatenate
from hess_explorer.views.text import digits
from hess_mechanics.chaplygin_ball.ball_section import BallSection
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, first_doubling
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import Kind, plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.suslov_section import SuslovSection

_FEW = 30
"""Largest number of values while a slider is held."""
_GLANCES = 12
"""Values of the parameter from which the vertical range is taken."""


@dataclass(frozen=True, eq=False)
class OrbitDiagram(Part[DiagramControls]):
    """The points to which the orbits of a section settle, over one of its parameters."""

    def corrections(self, notes: list[str]) -> Values:
        """Return the edges in order, the chosen point or the default, and the window if it overlaps the diagram."""
        first, last = sorted((self.host.first, self.host.last))
        if first == last:
            first = min(first, FARTHEST[1] - 1.0)
            last = first + 1.0
        window = normalized_window(self.host.window)
        (x0, _), (x1, _) = window_of(window, ((first, 0.0), (last, 0.0)))
        return {
            "first": first,
            "last": last,
            "chosen": self.host.chosen or type(self.host).chosen,
            "window": window if x0 < last and x1 > first else "",
        }

    @property
    def poincare(self) -> SuslovSection | BallSection:
        """The section in its coordinates.  Raises `ModelError`."""
        return self.host.poincare

    @cached_property
    def point(self) -> tuple[float, float]:
        """The start of the orbit: the chosen point, or another one if no motion is possible there.

        Raises `OutsideRegion` if no motion crosses the section.
        """
        (chosen,) = points_of(self.host.chosen)[-1:]
        if self.poincare.states_at(*np.array(chosen)[:, None])[1][0]:
            return chosen
        others = self.poincare.spread(1)
        if not others:
            raise OutsideRegion("No motion of this energy crosses γ₃ = 0: choose a larger h.")
        x, y = self.poincare.points_of(np.array(others))[0]
        return float(x), float(y)

    @property
    def start(self) -> Start:
        """The initial state of the current orbit."""
        return tuple(map(float, self.poincare.states_at(*np.array(self.point)[:, None])[0][0]))

    @cached_property
    def _window(self) -> Window:
        """The chosen window, or the whole diagram."""
        low, high = self.poincare.window[self.side]
        return window_of(self.host.window, ((self.host.first, low), (self.host.last, high)))

    @cached_property
    def height(self) -> Range | None:
        """The visible range of the coordinate: of the chosen window, or of the attractor; None until known."""
        (left, low), (right, high) = self._window
        if self.host.window:
            return low, high
        values = tuple(np.linspace(left, right, _GLANCES).tolist())
        glance = Ramp(self.family, values, self.point, 200, 30, True, plan(Kind.SECTION, "draft").level)
        return self.work.need(Task(visible_range, glance, self.side, (low, high)), preview=None)

    @cached_property
    def frame(self) -> Window:
        """The visible window; the full height of the diagram until the range of the attractor is known."""
        (left, low), (right, high) = self._window
        low, high = self.height or (low, high)
        return (left, low), (right, high)

    @property
    def name(self) -> str:
        """The name of the parameter of the diagram."""
        return self.host.symbols[self.host.along]

    @property
    def value(self) -> float:
        """The current value of the parameter."""
        return float(getattr(self.host, self.name))

    @property
    def family(self) -> Family:
        """The section over the parameter, independent of its current value."""
        return Family.of(self.host, self.name, self.host.along, tuple(self.host.symbols.values()))

    @property
    def side(self) -> int:
        """Index of the section's coordinate on the vertical axis."""
        return COORDINATES.index(self.host.shown)

    @cached_property
    def parameter_values(self) -> Array:
        """The values of the parameter (n,), increasing."""
        share = self.work.plan(Kind.SECTION).share
        steps = min(int(self.host.steps), _FEW) if self.work.is_preview else max(2, round(share * self.host.steps))
        return np.linspace(self.frame[0][0], self.frame[1][0], steps)

    @cached_property
    def _ramps(self) -> dict[str, Ramp]:
        """The ramp of each requested way."""
        level = self.work.plan(Kind.SECTION).level
        left, shown = (40, 20) if self.work.is_preview else (int(self.host.transient), int(self.host.count))
        values = tuple(self.parameter_values.tolist())
        rising = Ramp(self.family, values, self.point, left, shown, self.host.begins == FOLLOWED, level)
        ramps = {
            RISING: rising,
            FALLING: replace(rising, values=values[::-1], previous=rising),
            BACKWARD: replace(rising, backward=True),
        }
        return {way: ramps[way] for way in WAYS[self.host.ways]}

    @cached_property
    def pieces(self) -> dict[str, list[Diagram]]:
        """The known pieces of each way, in the order in which they are computed."""
        found: dict[str, list[Diagram]] = {way: [] for way in self._ramps}
        # Compute the falling ramp last, because it starts at the end of the rising one.
        numbers = product(self._ramps, self._ramps[RISING].pieces)
        for way, i in sorted(numbers, key=lambda one: (one[0] == FALLING, one[1])):
            task = Task(piece, self._ramps[way], i)
            known = self.work.need(task, preview=task if self.work.is_preview else None)
            found[way] += [] if known is None else [known]
        return found

    @property
    def progress(self) -> dict[str, int]:
        """The number of known values of each way."""
        return {way: sum(len(one.values) for one in some) for way, some in self.pieces.items()}

    def points(self, way: str) -> Array | None:
        """Return the drawn points (2, n) of a way, parameter and coordinate; n = 0 until some are known."""
        parts = [
            np.column_stack([np.full(len(some), value), some[:, self.side]])
            for one in self.pieces.get(way, ())
            for value, some in zip(one.values, one.points, strict=True)
            if len(some)
        ]
        return concatenate(parts).T

    @property
    def _locates(self) -> bool:
        """True if period doublings are located: not during a drag, and not at the level `draft`."""
        return not self.work.is_preview and self.work.level.name != "draft"

    @cached_property
    def doubling(self) -> tuple[float, Array, float] | None:
        """The first visible period doubling, see `first_doubling`; None until known, and if none is visible."""
        whole = self._locates and self.progress[RISING] == self.parameter_values.size
        return first_doubling(self.pieces[RISING]) if whole else None

    @cached_property
    def cascade(self) -> Cascade | str | None:
        """The located period doublings, or why none was located; None until known, and if none is visible."""
        return (self.work.need(Task(doublings, self._ramps[RISING]), preview=None) or None) if self._locates else None

    @property
    def flips(self) -> Array:
        """The parameter values (k,) of the located period doublings; k = 0 until known, and without any."""
        return self.cascade.values if isinstance(self.cascade, Cascade) else np.empty(0)

    def choose(self, x: float, y: float) -> Values:
        """Return the parameter value and the point that a click at (x, y) selects, at the nearest value with points.

        Without points only the parameter is set, to x.
        """
        # Round the distances, because the values of the two ramps differ by round-off.
        near = min(
            (
                (round(abs(value - x), 12), abs(point[self.side] - y), value, tuple(point))
                for some in self.pieces.values()
                for one in some
                for value, points in zip(one.values.tolist(), one.points, strict=True)
                for point in points.tolist()
            ),
            default=None,
        )
        return {self.name: x} if near is None else {self.name: near[2], "chosen": points_text([near[3]])}

    def caption(self, points: str = "") -> Caption:
        """Return the caption: progress, period doublings or periods; `points` is a sentence on the number of points."""
        known, asked = sum(self.progress.values()), self.parameter_values.size * len(self._ramps)
        if known < asked:
            return Caption(self.work.pending_caption(), f"{known} of {asked} values computed.")
        if all(one.conservative.all() for one in self.pieces[RISING]):
            return Caption("Volume is preserved: no attractors.", f"{points}One orbit for each value.")
        found = self.cascade
        if isinstance(found, Cascade) and self.flips.size:
            ratio = (
                f"; ratio {digits(found.ratios[-1], 4)} ± {digits(found.ratio_errors[-1], 1)}"
                if found.ratios.size
                else ""
            )
            many = f"{self.flips.size} period doublings" if self.flips.size > 1 else "One period doubling"
            first = digits(self.flips[0])
            return Caption(
                f"{many} located.",
                f"{points}The orbit of period {found.periods[0]} doubles at {self.host.along} = {first}{ratio}.",
            )
        periods = sorted({int(m) for one in self.pieces[RISING] for m in one.periods if m})
        if not periods:
            return Caption("No periodic orbit is visible.", points.rstrip())
        return Caption(numbers=f"{points}Periods seen: {', '.join(map(str, periods[:8]))}.")

    def status(self) -> Iterator[str]:
        """Yield the error of the doublings."""
        if self.has_result("cascade") and self.flips.size and isinstance(self.cascade, Cascade):
            yield f"error of the doublings {digits(self.cascade.error_estimate, 1)}"

    def notes(self) -> Iterator[str]:
        """Yield the reason why a doubling could not be located."""
        if self.has_result("cascade") and isinstance(self.cascade, str):
            yield f"A visible doubling was not located: {self.cascade}"


@dataclass(frozen=True, eq=False)
class DiagramBranch(Continuation[OrbitDiagram]):
    """The branch of a periodic orbit over the parameter of the diagram.

    Attributes
    ----------
    period : str
        Period of the orbit to continue, one of `PERIODS`; `NONE` for the first one whose period visibly doubles.
    """

    period: str

    @property
    def branch_start(self) -> BranchStart | None:
        """The start of the branch; None if no orbit is requested and no period doubling is visible."""
        host = self.host
        at, point, period = host.value, host.point, PERIODS.get(self.period)
        if self.period == NONE:
            if host.doubling is None:
                return None
            at, points, _ = host.doubling
            point, period = tuple(points[0].tolist()), len(points)
        (low, _), (high, _) = host.frame
        return BranchStart(host.family, at, point, period, (min(low, at), max(high, at)))

    @property
    def side(self) -> int:
        """Index of the coordinate on the vertical axis."""
        return self.host.side

    @property
    def frame(self) -> Window:
        """The visible window."""
        return self.host.frame
