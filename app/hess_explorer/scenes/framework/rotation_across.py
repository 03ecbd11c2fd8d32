"""Rotation numbers of the orbits that start on a line across a section g = π/2, as they become known."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.filled_window import FilledWindow, OrbitBatch, in_pieces
from hess_explorer.scenes.framework.one_orbit import Start
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views import theme
from hess_explorer.views.comparison import Curves, Frame
from hess_explorer.views.graph import with_room
from hess_explorer.views.layers import Axes, Range, curves, points, region
from hess_explorer.views.plot import Plot
from hess_explorer.views.section_plane import joined
from hess_explorer.views.text import digits
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, andoyer_points, relation
from hess_mechanics.euler_poisson.rotation import RESOLVED, RotationProfile, on_line, rotation_along
from hess_mechanics.numerics.accuracy import Computation, Level, Plan
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["ROTATION", "RotationAcross", "rotation_picture"]

_ACROSS = 48
"""Orbits on the line along which the rotation number is looked at."""
_ON_LINE = 3000
"""Crossings of each: with fewer the rotation number in a chain of islands is not known to `RESOLVED`."""
_MOST_STEPS = 200_000
_HELD = (16, 40, 1e-2)
"""While a slider is held: orbits, crossings of each, and to what both halves of a closed curve then agree."""


class RotationAcross(FilledWindow):
    """A filled window of the Andoyer–Deprit section, with rotation numbers along a line across it."""

    @property
    @abstractmethod
    def section(self) -> AndoyerSection:
        """The section.  Raises `ModelError`."""

    def piece(self, starts: tuple[Start, ...], crossings: int, forward: bool, level: Level) -> Task:
        """What follows these orbits."""
        return Task(_piece, (self.section, starts, crossings, level))

    @property
    @abstractmethod
    def about_middle(self) -> bool:
        """Whether turns are counted about the middle of the window, on a line from there to the right.

        Else by the angle l, on a vertical line through the first chosen start: another one leaves it where it is.
        """

    @property
    def axis(self) -> int:
        """The coordinate along the line: l (0) or L/G (1)."""
        return 0 if self.about_middle else 1

    @cached_property
    def ends(self) -> Window:
        """Of the line along which the rotation number is looked at."""
        (l0, x0), (l1, x1) = self.frame
        if not self.about_middle:
            l = self.picked.places[0][0]
            return (l, x0), (l, x1)
        middle = 0.5 * (x0 + x1)
        return (0.5 * (l0 + l1), middle), (l1, middle)

    @cached_property
    def _orbits_on_line(self) -> tuple[list[tuple[float, Array]], bool]:
        """Shares of the way along the line, with the orbits from there that are known; whether these are all."""
        plan = self.plan(Computation.ROTATION)
        count, crossings = _HELD[:2] if self.dragging else (plan.side(_ACROSS), self._crossings_on_line(plan))
        starts = self.work.get(on_line, self.section, self.ends, count)
        found: list[tuple[float, Array]] = []
        for some in in_pieces(starts):
            task = self.piece(tuple(state for _, state in some), crossings, True, plan.level)
            piece = self.work.soon(task.function, *task.arguments)
            if piece is not None:
                found += zip((share for share, _ in some), piece.orbits, strict=True)
        return found, len(found) == len(starts)

    def _crossings_on_line(self, plan: Plan) -> int:
        return max(self.plan(Computation.SECTION).part(self.count), plan.part(_ON_LINE))

    @cached_property
    def rotation(self) -> RotationProfile:
        """Rotation numbers along the line, as far as they are known; of few and short orbits while a slider is held."""
        count = _HELD[0] if self.dragging else self.plan(Computation.ROTATION).side(_ACROSS)
        return self._rotation_of(self._orbits_on_line[0], count)

    @property
    def _resolved(self) -> float:
        return _HELD[2] if self.dragging else RESOLVED

    def _rotation_of(self, found: list[tuple[float, Array]], count: int) -> RotationProfile:
        return rotation_along(self.ends, [share for share, _ in found], [orbit for _, orbit in found],
                              self.about_middle, count, self._resolved)

    def rotation_at(self, plan: Plan) -> RotationProfile:
        """Rotation numbers along the line, computed here and now."""
        count = plan.side(_ACROSS)
        starts = on_line(self.section, self.ends, count)
        orbits = [orbit for some in in_pieces(starts) for orbit in self.piece(
            tuple(state for _, state in some), self._crossings_on_line(plan), True, plan.level).now().orbits]
        return self._rotation_of([(share, orbit) for (share, _), orbit in zip(starts, orbits, strict=True)], count)

    def rotation_message(self) -> str:
        """Why there is nothing to see, when all is known."""
        if self.rotation.numbers.size or not self._orbits_on_line[1]:
            return ""
        return ("No closed curve of the line goes round" if self.rotation.standing.size else
                "No orbit of the line is a closed curve")

    def rotation_axis(self) -> Range:
        """The axis of ρ, with 0 where curves do not go round."""
        return _axis_of(self.rotation)

    def parts_at_sea(self, axes: Axes) -> list[list[Array]]:
        """Those of the line, as rectangles."""
        low, high = axes.y
        return [[np.array([[a, low], [b, low], [b, high], [a, high]])] for a, b in self.rotation.sea]

    def about_rotation(self) -> str:
        """The caption."""
        if not self.rotation.numbers.size:
            return self.rotation_message() + "." if self._orbits_on_line[1] else "It is being computed."
        rho = self.rotation.numbers
        # A line through all of the section meets orbits of many kinds, whose numbers are no one function of the place.
        turning = self.rotation.extremum if self.about_middle else None
        still = self.rotation.standing.size
        standing = f"; {still} {'does' if still == 1 else 'do'} not go round." if still else "."
        low, high = self._turns(rho.min()), self._turns(rho.max())
        if low == high:
            return f"All closed curves have ρ = {low}{standing}"
        return f"Closed curves: ρ = {low} … {high}" + (
            standing if turning is None else
            f", turns round at {digits(turning[0])} (ρ = {self._turns(turning[1])}): no twist.")

    def _turns(self, rho: float) -> str:
        """A rotation number, to what is known of it."""
        return digits(round(float(rho) / self._resolved) * self._resolved)


def _piece(section: AndoyerSection, starts: tuple[Start, ...], crossings: int, level: Level) -> OrbitBatch:
    found = andoyer_points(section.body, section.h, section.f, starts, crossings, level, threads=1,
                           most_steps=_MOST_STEPS)
    signs = np.sign(relation(section.body, np.array(starts)))
    kept = (bool(np.all(sign * relation(section.body, states) >= 0.0))
            for states, sign in zip(found.states, signs, strict=True))
    other = [section.places_of(states)[~section.is_on(states)] for states in found.states]
    return OrbitBatch(tuple(frozen(section.places_of(states)) for states in found.states),
                      tuple(bool(sign > 0.0) for sign in signs), found.drift, tuple(kept), frozen(joined(other)))


def _axis_of(found: RotationProfile) -> Range:
    shown = np.concatenate([found.numbers, np.zeros(min(1, found.standing.size))])
    return with_room(shown, 0.06, 1e-4) if found.numbers.size else (-0.56, 0.56)


def _look(s: RotationAcross, found: RotationProfile) -> Curves:
    axes = Axes((s.ends[0][s.axis], s.ends[1][s.axis]), _axis_of(found))
    parts = tuple(np.column_stack(part) for part in zip(found.along, found.rho, strict=True))
    return Curves(Frame(axes, ("L/G" if s.axis else "l", "ρ")), parts)


ROTATION: Trial[RotationAcross] = Trial(
    Computation.ROTATION, ("rotation",), RotationAcross.rotation_at, lambda s, found, truth: found.distance(truth),
    _look,
    unit="turns, the median", seen=RESOLVED)


def rotation_picture() -> Plot[Any]:
    """ρ along the line, in branches, and the orbits that it is known from; and where on the line there is none, why."""
    return Plot(
        name="rotation", title="Rotation number across the section", caption=lambda s: s.about_rotation(),
        axes=lambda s: ("L/G" if s.axis else "l", "ρ"), first=Axes((-1.0, 1.0), (-0.5, 0.5)),
        message=lambda s: s.rotation_message(),
        x=lambda s: (s.ends[0][s.axis], s.ends[1][s.axis]), y=lambda s: s.rotation_axis(),
        layers=(
            region("sea", within=lambda s, axes: s.parts_at_sea(axes), color=theme.MUTED + "38", moving=True,
                   label="ρ does not settle"),
            points("standing", lambda s: (s.rotation.standing, np.zeros(s.rotation.standing.size)), size=7, hollow=True,
                   color=theme.MUTED, edge_width=1.5, label="does not go round: 0 turns"),
            curves("rho", lambda s: [
                np.column_stack(part) for part in zip(s.rotation.along, s.rotation.rho, strict=True)],
                color=theme.ORBIT),
            # An orbit between two gaps is a curve of one point.
            points("orbits", lambda s: (s.rotation.places, s.rotation.numbers), size=4, color=theme.ORBIT)))
