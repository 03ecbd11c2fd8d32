"""The torus of the Hess case as a surface in three dimensions, with the curves on it; rendered by "torus.js"."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import MOVING_POINT, Axes, Columns, Sign, Sources, column
from hess_explorer.views.maps.circle_map import cycles
from hess_explorer.views.picture import Picture
from hess_mechanics.numerics.results import Array, Complex
from hess_mechanics.suslov_hess.bifurcation import TurningPoints
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.embedding import CrossSection

S = TypeVar("S")

POINTS = 65
"""Points of the cross-section: even when it is large, its sides are about ten pixels long."""
_LOOKS = ("orbit", "stable", "unstable")
_SECTION = Sign("section of the circle map: n₃ is lowest", "line", f"border-top: 2px dotted {theme.INK}")
FORMULA = "(w₁, w₂, ṅ₃/ρ₀)/ρ₀, ρ₀ the largest |w| of this h."


@dataclass(frozen=True)
class SurfaceCurve:
    """A curve near or on the torus.

    Attributes
    ----------
    points : array (n, 3)
        Points of the curve.
    times : array (n,) or None
        Times of the player; None for a closed curve.
    """

    points: Array
    times: Array | None = None


@dataclass(frozen=True, kw_only=True)
class TorusInSpace(Picture[S]):
    """The torus as `hess_mechanics.suslov_hess.embedding` places it.

    Attributes
    ----------
    surface : callable
        `surface(state)` returns its cross-section, or None without a torus.
    curves : callable
        `curves(state)` returns curves by style, "orbit", "stable" and "unstable"; any of them may be missing.
    zeta : callable or None
        `zeta(state)` returns the points ζ (n,) of the invariant density along the cross-section, or None without one.
    """

    name: str = "surface"
    title: str | Callable[[S], str] = "The torus in space"
    surface: Callable[[S], CrossSection | None]
    curves: Callable[[S], Mapping[str, SurfaceCurve]]
    zeta: Callable[[S], Complex | None] = lambda state: None

    kind: ClassVar[str] = "torus"

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the picture adds to the legend of its scene."""
        return (*self.signs, _SECTION, MOVING_POINT)

    def _source(self, look: str) -> str:
        return f"{self.name}-{look}"

    def describe(self) -> dict[str, Any]:
        """Return the description of the picture for the browser."""
        return {**super().describe(), "curves": {self._source(look): look for look in _LOOKS}}

    def data(self, state: S) -> Sources:
        """Return the columns of the cross-section, and of each curve."""
        found, zeta, curves = self.surface(state), self.zeta(state), self.curves(state)
        section = {} if found is None else {"radius": column(found.radius), "height": column(found.height)}
        density = {} if zeta is None else {"re": column(zeta.real), "im": column(zeta.imag)}
        return {
            self.name: {**section, **density},
            **{self._source(look): _columns(curves.get(look)) for look in _LOOKS},
        }

    def empty_data(self, sentence: str, axes: Axes | None) -> Sources:
        """Return empty columns; the caption contains the reason."""
        return {self.name: {}, **{self._source(look): {} for look in _LOOKS}}


def _columns(curve: SurfaceCurve | None) -> Columns:
    if curve is None:
        return {}
    times = {} if curve.times is None else {"t": column(curve.times)}
    return {**times, **{name: column(curve.points[:, i]) for i, name in enumerate("xyz")}}


def caption(theta: CircleMap | None, turning_points: TurningPoints | None, *more: str) -> Caption:
    """Return the caption: the kind of surface, and the sentences `more`.

    The circle map and the turning points are None on the separatrix.
    """
    return Caption(_kind(theta, turning_points), " ".join(filter(None, more)))


def _kind(theta: CircleMap | None, turning_points: TurningPoints | None) -> str:
    if theta is None or turning_points is None:
        return "Separatrix: the centre is the upper equilibrium."
    if turning_points.roots[2] - turning_points.roots[1] < 1e-6:
        return "Bifurcation curve: the torus is a circle."
    if turning_points.f == 0.0 and turning_points.h < 1.0:
        return "f = 0: the centre is a circle."
    if theta.kind == "hyperbolic":
        return "Two limit cycles on the torus."
    return f"{cycles(theta).capitalize()}." if theta.kind == "parabolic" else "No limit cycle on the torus."
