"""The torus of a motion of the Hess case as a surface in space, optionally shaded by its invariant density."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.hess_case import HeavyHess, limit_cycles, map_or_none
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.sliders import choice
from hess_explorer.views.caption import Caption
from hess_explorer.views.plane import torus_density
from hess_explorer.views.space.torus_in_space import FORMULA, POINTS, SurfaceCurve, TorusInSpace, caption
from hess_mechanics.errors import InvalidParameter, ModelError, Separatrix
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, Complex
from hess_mechanics.suslov_hess.bifurcation import TurningPoints
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.embedding import CrossSection, cross_section, density_along, embed
from hess_mechanics.suslov_hess.torus import Track

PLAIN, INVARIANT = "plain", "invariant density"


def shading() -> Any:
    """Declare whether the torus in space shows the invariant density."""
    return choice(
        "Torus in space",
        (PLAIN, INVARIANT),
        PLAIN,
        doc="Shades the torus by its invariant density, which exists only without limit cycles.",
    )


class HasTorus(Host, Protocol):
    """A host with a torus of the Hess case, in units b = 1."""

    @property
    def level(self) -> Level:
        """The level of accuracy."""

    @property
    def h(self) -> float:
        """The energy in units b = 1.  Raises `ModelError`."""

    @property
    def turning_points(self) -> TurningPoints | None:
        """The turning points of n3; None on the separatrix.  Raises `ModelError`."""

    @property
    def map(self) -> CircleMap | None:
        """The circle map; None on the separatrix.  Raises `ModelError`."""

    @property
    def cycles(self) -> tuple[Track, Track] | None:
        """The stable and the unstable limit cycle; None without limit cycles.  Raises `ModelError`."""


@dataclass(frozen=True, eq=False)
class HeavyTorus(Part[Host]):
    """The torus of the Hess manifold at the integrals of a heavy body.

    Attributes
    ----------
    heavy : HeavyHess
        The motion of the heavy body.
    """

    heavy: HeavyHess

    @property
    def level(self) -> Level:
        """The level of accuracy."""
        return self.work.level

    @property
    def h(self) -> float:
        """The energy in units b = 1."""
        return self.heavy.bridge.in_units_of_b(self.heavy.h, self.heavy.f)[0]

    @cached_property
    def turning_points(self) -> TurningPoints | None:
        """The turning points of n3; None on the separatrix."""
        try:
            return self.heavy.turning_points
        except Separatrix:
            return None

    @cached_property
    def map(self) -> CircleMap | None:
        """The circle map; None on the separatrix."""
        bridge = self.heavy.bridge
        return map_or_none(self.work, bridge.hess.a, *bridge.in_units_of_b(self.heavy.h, self.heavy.f), self.level)

    @cached_property
    def cycles(self) -> tuple[Track, Track] | None:
        """The stable and the unstable limit cycle; None without limit cycles."""
        hess = self.heavy.bridge.hess
        return limit_cycles(
            self.work, hess, self.map, self.level, hess.frequency_unit * math.sqrt(2.0 * (self.h + 1.0))
        )


@dataclass(frozen=True, eq=False)
class HessSurface(Part[HasTorus]):
    """The torus as a surface, and the curves on it.

    Attributes
    ----------
    has_density : bool
        True to shade it by its invariant density.
    orbit : callable
        `orbit()` returns the orbit as reduced states (n, 5) in units b = 1, and its times (n,).
    description : callable
        `description()` returns the second part of the caption.
    """

    has_density: bool
    orbit: Callable[[], tuple[Array, Array]]
    description: Callable[[], str] = lambda: FORMULA

    @cached_property
    def section(self) -> CrossSection | None:
        """The cross-section of the surface; None if no motion has these integrals."""
        try:
            return cross_section(self.host.h, self.host.turning_points, POINTS)
        except ModelError:
            return None

    @cached_property
    def density(self) -> tuple[Complex | None, str]:
        """The points ζ (n,) of the invariant density along the cross-section, or None; and the reason for None.

        The reason is empty if no density is requested or there is no torus.
        """
        if not self.has_density or self.section is None:
            return None, ""
        map_ = self.host.map
        # The caption of the torus already states the reason.
        if map_ is None or torus_density.reason_for_no_density(map_, self.host.turning_points):
            return None, "No density."
        try:
            return self.work.need(Task(density_along, map_, POINTS, self.host.level)), ""
        except InvalidParameter as error:
            return None, str(error)

    def curves(self) -> dict[str, SurfaceCurve]:
        """Return the orbit and the limit cycles by style; empty without a torus."""
        if self.section is None:
            return {}
        states, times = self.orbit()
        found = {"orbit": SurfaceCurve(embed(states, self.host.h), times)}
        for look, cycle in zip(("stable", "unstable"), self.host.cycles or (), strict=False):
            found[look] = SurfaceCurve(embed(cycle.orbit.states, self.host.h))
        return found

    def caption(self) -> Caption:
        """Return the caption: the kind of surface, the description, and the reason for a missing density."""
        if self.section is None:
            return Caption("No torus.", "The Hess manifold has no motion with these h and f.")
        return caption(self.host.map, self.host.turning_points, self.description(), self.density[1])


surface_picture = TorusInSpace[HessSurface](
    caption=HessSurface.caption,
    surface=lambda s: s.section,
    zeta=lambda s: s.density[0],
    curves=HessSurface.curves,
).of
"""The picture of the surface."""
