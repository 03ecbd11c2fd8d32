"""The branch of a periodic orbit over a parameter of a scene; a click selects an orbit on it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, Self

import numpy as np

from hess_explorer.protocol.specs import NumberSpec, Values
from hess_explorer.scenes.framework.continuation import Continuation
from hess_explorer.scenes.framework.families import BranchStart, Family
from hess_explorer.scenes.framework.part import HasSection
from hess_explorer.scenes.framework.periodic_search import PERIODS
from hess_explorer.scenes.framework.sliders import Slider, choice, number, specs_of
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.parts.sections.periodic_orbit import SectionPeriodicOrbit
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Range, curves, points
from hess_explorer.views.maps import branch as view
from hess_explorer.views.picture import Corners, Picture
from hess_explorer.views.plane.periodic import visible_points
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.results import Array

_AROUND = 0.125
"""Half-width of the default range, as a share of the slider's."""
_ROOM = 0.08
_LEAST = 1e-3
"""Least height of the picture, as a share of the section's."""
_FARTHEST = (-1e5, 1e5)


def parameter_of_branch(symbols: tuple[str, ...]) -> Any:
    """Declare the parameter of the branch; the default is the first symbol."""
    return choice(
        "Branch over",
        symbols,
        symbols[0],
        doc="Parameter on the horizontal axis of “Branch of the periodic orbit”; all others keep their values.",
    )


def end_of_branch(word: str) -> Any:
    """Declare one end of the range of the branch, named by `word`: "from" or "to"."""
    return number(
        word,
        0.0,
        (-1.0, 6.0),
        0.01,
        bounds=_FARTHEST,
        label=f"Branch {word}",
        group="Computation",
        doc="Range of “Branch of the periodic orbit”. If both ends are equal, the range surrounds the current value.",
    )


def coordinate_of_branch(names: tuple[str, str]) -> Any:
    """Declare the coordinate of the section on the vertical axis."""
    return choice(
        "Branch upwards",
        names,
        names[0],
        doc="Coordinate of the section on the vertical axis of “Branch of the periodic orbit”.",
    )


class _Section(HasSection, Protocol):
    @property
    def over(self) -> str: ...

    @property
    def low(self) -> float: ...

    @property
    def high(self) -> float: ...

    @property
    def upwards(self) -> str: ...

    def limits(self) -> Mapping[str, Slider]: ...

    def with_values(self, values: Values) -> Self: ...

    def start_at(self, x: float, y: float) -> Values:
        """Return the parameter values with which the orbit starts at a point of the section."""


@dataclass(frozen=True, eq=False)
class SectionBranch(Continuation[_Section]):
    """The branch of the periodic orbit of a section over a parameter.

    Attributes
    ----------
    orbit : SectionPeriodicOrbit
        The periodic orbit to continue.
    along : mapping of str to str
        Names of the section's parameters by symbol.
    besides : tuple of str
        Choices on which the section also depends.
    """

    orbit: SectionPeriodicOrbit
    along: Mapping[str, str]
    besides: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name of the parameter."""
        return self.along[self.host.over]

    @property
    def value(self) -> float:
        """The current value of the parameter."""
        return float(getattr(self.host, self.name))

    @property
    def side(self) -> int:
        """Index of the coordinate on the vertical axis."""
        return self.host.poincare.names.index(self.host.upwards)

    @cached_property
    def ends(self) -> tuple[float, float]:
        """The range of the parameter, clipped to its bounds: around the current value if both ends are equal."""
        spec = next(one for one in specs_of(type(self.host)) if one.name == self.name)
        assert isinstance(spec, NumberSpec)
        least, most = spec.bounds
        first, last, _ = self.host.limits().get(self.name, (*spec.softbounds, spec.step))
        low, high = (min(max(one, least), most) for one in sorted((self.host.low, self.host.high)))
        if low == high:
            away, at = _AROUND * (last - first), self.value
            # Below the slider's range there may be no motion.
            low, high = (max(at - away, first) if at > first else at - away), at + away
            low, high = max(low, least), min(high, most)
        return low, high

    @cached_property
    def branch_start(self) -> BranchStart | None:
        """The start of the branch; None until a periodic orbit is known."""
        if self.orbit.host.start_point is None or self.orbit.closed_orbit is None:
            return None
        low, high = self.ends
        family = Family.of(self.host, self.name, self.host.over, (*self.along.values(), *self.besides))
        return BranchStart(
            family,
            self.value,
            self.orbit.host.start_point,
            PERIODS[self.orbit.period],
            (min(low, self.value), max(high, self.value)),
        )

    @property
    def orbit_points(self) -> Array | None:
        """The points (2, m) of the periodic orbit, value and coordinate; None without a periodic orbit."""
        closed = self.orbit.closed_orbit
        return None if closed is None else np.array([(self.value, point[self.side]) for point in closed.orbit.points]).T

    @property
    def _whole(self) -> Range:
        """The full range of the coordinate on the vertical axis."""
        return self.host.poincare.window[self.side]

    @cached_property
    def vertical_range(self) -> Range | None:
        """The vertical range of the known branch; None until a piece is known, the full range without a branch."""
        if self.message:
            return self._whole
        if not self.branches:
            return None
        found = np.concatenate([one.points[:, :, self.side].ravel() for one in self.branches])
        low, high = self._whole
        if found.max() - found.min() >= self.turn:
            return low, high
        middle = 0.5 * float(found.min() + found.max())
        half = (0.5 + _ROOM) * max(float(found.max() - found.min()), _LEAST * (high - low))
        return middle - half, middle + half

    @property
    def frame(self) -> Window:
        """The visible window."""
        low, high = self.vertical_range or self._whole
        return (self.ends[0], low), (self.ends[1], high)

    def choose(self, x: float, y: float) -> Values:
        """Return the parameter values that show the orbit of the branch at (x, y), with the same visible range.

        Empty away from the branch.
        """
        found = self.orbit_at(x, y)
        if found is None:
            return {}
        value, point, period = found
        there = self.host.with_values({self.name: value})
        low, high = self.ends
        return {
            self.name: value,
            **there.start_at(point[0], point[1]),
            "periodic": f"period {period}",
            "low": low,
            "high": high,
        }

    def box_window(self, corners: Corners) -> Values:
        """Return the range that a box selects; a box around everything selects the default.

        Any other box selects nothing if it has no width or there is no branch.
        """
        low, high = sorted((corners[0], corners[2]))
        if low <= _FARTHEST[0] and high >= _FARTHEST[1]:
            low = high = 0.0
        elif low == high or not self.branches:
            return {}
        return {"low": low, "high": high}

    # ---- texts --------------------------------------------------------------------------------------------------

    @property
    def caption(self) -> Caption:
        """The caption of the picture."""
        if not self.orbit.is_on:
            return Caption(
                "No periodic orbit is chosen.", "Choose a periodic orbit, then click its branch to select an orbit."
            )
        return Caption(self.work.pending_caption("A periodic orbit is")) if self.orbit.is_searching else super().caption

    @property
    def message(self) -> str:
        """The reason why the picture is empty; otherwise an empty string."""
        if not self.orbit.is_on:
            return "Choose a Periodic orbit to show its branch here"
        found = self.orbit.is_searching or self.orbit.closed_orbit is not None
        return "" if found else "No periodic orbit found near this point"

    def meanings(self) -> Mapping[str, str]:
        """Return the meanings of the choices of the branch, which differ between scenes."""
        return dict.fromkeys(("over", "low", "high", "upwards"), f"branch of {type(self.host).__name__}")

    def idle_values(self) -> Mapping[str, float]:
        """Return the ends of the range if there is no branch, because they have no effect."""
        return {} if self.orbit.is_on else {"low": self.host.low, "high": self.host.high}

    def adjustments(self, before: Self) -> Mapping[str, float]:
        """Return the default range after a change of the parameter, otherwise nothing."""
        return {} if self.host.over == before.host.over else {"low": 0.0, "high": 0.0}


def branch_picture() -> Picture[Any]:
    """Return the picture of the branch over its parameter."""

    def itself(s: SectionBranch) -> SectionBranch:
        return s

    def at_the_value(s: SectionBranch, axes: Axes) -> list[Array]:
        return [np.array([[s.value, y] for y in axes.y])] if s.branches else []

    def shown(s: SectionBranch, axes: Axes) -> Array | None:
        here = s.orbit_points
        return None if here is None else visible_points(here[::-1].T, s.turn, Axes(axes.y, axes.x))[:, ::-1].T

    return Plot[SectionBranch](
        name="branch",
        title="Branch of the periodic orbit",
        caption=lambda s: s.caption,
        button="Show the branch of the periodic orbit",
        axes=lambda s: (s.host.over, s.host.upwards),
        message=lambda s: s.message,
        on_click=SectionBranch.choose,
        on_box=SectionBranch.box_window,
        on_hover=SectionBranch.tooltip,
        x=lambda s: s.ends,
        y=lambda s: s.vertical_range,
        layers=(
            curves(
                "value",
                data_in_axes=at_the_value,
                color=theme.INK,
                width=1.5,
                label="current state",
                tag="current state",
            ),
            *view.layers(itself),
            points(
                "shown",
                data_in_axes=shown,
                size=15,
                color=theme.INK,
                hollow=True,
                edge_width=2.0,
                label="current periodic orbit",
            ),
        ),
    ).of(lambda s: s.branch)
