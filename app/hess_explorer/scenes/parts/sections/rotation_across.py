"""Rotation numbers of orbits that start on a line across a section g = π/2."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.orbit_batches import OrbitBatch, batches
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.parts.sections.section import Section
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import with_margin
from hess_explorer.views.layers import Axes, Range, curves, points, region
from hess_explorer.views.picture import Picture
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.rotation import RESOLUTION, RotationProfile, rotation_along, states_on_line
from hess_mechanics.numerics.accuracy import Kind, Plan
from hess_mechanics.numerics.results import Array

_ACROSS = 48
"""Number of orbits on the line."""
_ON_LINE = 3000
"""Crossings of each orbit: fewer do not resolve the rotation number in a chain of islands to `RESOLUTION`."""
_PREVIEW = (16, 40, 1e-2)
"""While a slider is held: orbits, crossings of each, and the resolution of the rotation number."""


class _Host(Host, Protocol):
    @property
    def poincare(self) -> AndoyerSection:
        """The section in its coordinates.  Raises `ModelError`."""

    @property
    def count(self) -> float:
        """The number of crossings of each orbit of the section."""


@dataclass(frozen=True, eq=False)
class RotationAcross(Part[_Host]):
    """Rotation numbers along a line across the Andoyer–Deprit section.

    Attributes
    ----------
    section : Section
        The section.
    first : callable
        `first()` returns the point (l, L/G) of the first chosen start.
    about_middle : bool
        True to count turns about the centre of the window, on a line from the centre to the right; False to count them
        by the angle l, on a vertical line through the first start.
    """

    section: Section
    first: Callable[[], tuple[float, float]]
    about_middle: bool

    @property
    def axis(self) -> int:
        """The coordinate along the line: l (0) or L/G (1)."""
        return 0 if self.about_middle else 1

    @cached_property
    def ends(self) -> Window:
        """The ends (l, L/G) of the line: centre and right edge of the window, or its lower and upper edge."""
        (l0, x0), (l1, x1) = self.section.frame
        if not self.about_middle:
            l = self.first()[0]
            return (l, x0), (l, x1)
        middle = 0.5 * (x0 + x1)
        return (0.5 * (l0 + l1), middle), (l1, middle)

    def _pieces(self, plan: Plan) -> list[tuple[list[float], Task[OrbitBatch]]]:
        """Return groups of starts along the line, each with the task of its orbits."""
        crossings = max(self.work.plan(Kind.SECTION).part(self.host.count), plan.part(_ON_LINE))
        starts = self.work.need(Task(states_on_line, self.host.poincare, self.ends, self._count(plan)))
        return [
            (
                [share for share, _ in some],
                self.section.batch(
                    tuple(state for _, state in some),
                    True,
                    _PREVIEW[1] if self.work.is_preview else crossings,
                    plan.level,
                ),
            )
            for some in batches(starts)
        ]

    def _count(self, plan: Plan) -> int:
        return _PREVIEW[0] if self.work.is_preview else plan.side(_ACROSS)

    @cached_property
    def _results(self) -> list[tuple[list[float], OrbitBatch | None]]:
        held, pieces = self.work.is_preview, self._pieces(self.work.plan(Kind.ROTATION))
        return [(shares, self.work.need(task, preview=task if held else None)) for shares, task in pieces]

    @property
    def _complete(self) -> bool:
        return all(batch is not None for _, batch in self._results)

    @cached_property
    def profile(self) -> RotationProfile:
        """The known rotation numbers along the line; from a few short orbits during a drag."""
        return self._profile(self._results, self.work.plan(Kind.ROTATION))

    @property
    def _resolution(self) -> float:
        return _PREVIEW[2] if self.work.is_preview else RESOLUTION

    def _profile(self, pieces: Sequence[tuple[list[float], OrbitBatch | None]], plan: Plan) -> RotationProfile:
        known = [(shares, batch.orbits) for shares, batch in pieces if batch is not None]
        return rotation_along(
            self.ends,
            [share for shares, _ in known for share in shares],
            [orbit for _, orbits in known for orbit in orbits],
            self.about_middle,
            self._count(plan),
            self._resolution,
        )

    def compute(self, plan: Plan) -> RotationProfile:
        """Return the rotation numbers along the line for a plan, computed at once.  Raises `WorkLimit`."""
        return self._profile([(shares, task.compute()) for shares, task in self._pieces(plan)], plan)

    def message(self) -> str:
        """Return the reason why the picture is empty; an empty string if it is not, or until all orbits are known."""
        if self.profile.numbers.size or not self._complete:
            return ""
        return "No closed curve on the line rotates" if self.profile.librations.size else "No closed curve on the line"

    @property
    def line_range(self) -> Range:
        """The range of the coordinate along the line."""
        return self.ends[0][self.axis], self.ends[1][self.axis]

    @property
    def names(self) -> tuple[str, str]:
        """The names of the axes of its picture."""
        return ("L/G" if self.axis else "l"), "ρ"

    def chaotic_parts(self, axes: Axes) -> list[list[Array]]:
        """Return rectangles over the chaotic parts of the line, as high as the axes, as a region."""
        low, high = axes.y
        return [[np.array([[a, low], [b, low], [b, high], [a, high]])] for a, b in self.profile.chaotic_intervals]

    def caption(self) -> Caption:
        """Return the caption: the range of the rotation numbers and an extremum, or why there are none."""
        if not self.profile.numbers.size:
            return Caption(self.message() + "." if self._complete else self.work.pending_caption())
        rho = self.profile.numbers
        # Across the whole section ρ is not a continuous function of the point, so an extremum has no meaning.
        turning = self.profile.extremum if self.about_middle else None
        still = self.profile.librations.size
        standing = f"; {still} do not rotate" if still else ""
        low, high = self._turns(rho.min()), self._turns(rho.max())
        if low == high:
            return Caption("One rotation number for all closed curves.", f"ρ = {low}{standing}.")
        if turning is None:
            return Caption("Rotation numbers of the closed curves.", f"From {low} to {high}{standing}.")
        return Caption(
            "No twist where ρ has an extremum.",
            f"ρ from {low} to {high}, extremum {self._turns(turning[1])} at {digits(turning[0])}.",
        )

    def _turns(self, rho: float) -> str:
        """Return a rotation number, rounded to its resolution."""
        return digits(round(float(rho) / self._resolution) * self._resolution)


def _axis_of(profile: RotationProfile) -> Range:
    shown = np.concatenate([profile.numbers, np.zeros(min(1, profile.librations.size))])
    return with_margin(shown, 0.06, 1e-4) if profile.numbers.size else (-0.56, 0.56)


def rotation_trial() -> Trial[Any]:
    """Return the trial of the rotation numbers, computed at each level."""
    return Trial(
        Kind.ROTATION,
        ("rotation",),
        lambda s, plan: s.rotation.compute(plan),
        lambda s, found, truth: found.distance(truth),
        unit="turns, the median",
        tolerance=RESOLUTION,
    )


def _branches(profile: RotationProfile) -> list[Array]:
    return [np.column_stack(part) for part in zip(profile.along, profile.rho, strict=True)]


def rotation_picture() -> Picture[Any]:
    """Return the picture of ρ along the line: its branches, the measured orbits, and the parts without ρ."""
    return Plot(
        name="rotation",
        title="Rotation number across the section",
        caption=lambda s: s.rotation.caption(),
        axes=lambda s: s.rotation.names,
        first=Axes((-1.0, 1.0), (-0.5, 0.5)),
        message=lambda s: s.rotation.message(),
        x=lambda s: s.rotation.line_range,
        y=lambda s: _axis_of(s.rotation.profile),
        layers=(
            region(
                "sea",
                data_in_axes=lambda s, axes: s.rotation.chaotic_parts(axes),
                color=theme.MUTED + "38",
                is_overlay=True,
                label="ρ does not converge",
            ),
            points(
                "standing",
                lambda s: (s.rotation.profile.librations, np.zeros(s.rotation.profile.librations.size)),
                size=7,
                hollow=True,
                color=theme.MUTED,
                edge_width=1.5,
                label="no rotation: 0 turns",
            ),
            curves("rho", lambda s: _branches(s.rotation.profile), color=theme.ORBIT),
            # A curve of one point, between two gaps, is visible only as a marker.
            points(
                "orbits", lambda s: (s.rotation.profile.points, s.rotation.profile.numbers), size=4, color=theme.ORBIT
            ),
        ),
    )
