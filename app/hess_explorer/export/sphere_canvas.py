"""Canvas for drawings on a sphere: projection, lines on the near and far half, labels that do not overlap."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.elements import Colour
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["LOOKS", "ROOM", "Look", "SphereCanvas", "circle", "graticule", "seen"]

Point = Sequence[float] | Array
"""Coordinates (3,)."""
Look = tuple[str, Any, float]
"""Colour, dash style, line width in points."""

ROOM = 1.25
"""Half the width of the picture, in radii of the sphere."""

LOOKS: dict[str, Look] = {
    "orbit": (theme.ORBIT, "-", 1.3),
    "second": (theme.MAP, "-", 1.3),
    "stable": (theme.STABLE, "-", 1.8),
    "unstable": (theme.UNSTABLE, (0, (5, 3)), 1.8),
    "limit": (theme.INK, (0, (2, 3)), 0.7),
    "muted": (theme.MUTED, "-", 0.7),
    "axis": (theme.INK, "-", 1.5),
    "mass": (theme.INK, "-", 1.8),
}
"""Line styles by the names that `Circle`, `Mark`, `Rod`, `Trail` and the tracks use."""
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 181)
_ASIDE = ((0, 0), (0, -1), (0, 1), (1, 0), (-1, 0), (1, -1), (-1, -1))
"""Alternative positions of a label: below, above, right, left."""


def seen(points: Array, azimuth: float, elevation: float) -> Array:
    """Return points (n, 3) in view coordinates: right, up, towards the viewer."""
    ca, sa, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(elevation), math.sin(elevation)
    turned: Array = points @ np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]]).T
    return turned


def circle(axis: Array, height: float) -> Array:
    """Return the circle (γ, axis) = height on the unit sphere, (n, 3)."""
    axis = axis / np.linalg.norm(axis)
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    across /= np.linalg.norm(across)
    radius = math.sqrt(max(0.0, 1.0 - height**2))
    turned: Array = height * axis + radius * (
        np.cos(_ANGLES)[:, None] * across + np.sin(_ANGLES)[:, None] * np.cross(axis, across)
    )
    return turned


def graticule() -> Iterator[Array]:
    """Yield three parallels and six meridians."""
    for height in (-0.5, 0.0, 0.5):
        yield circle(np.array([0.0, 0.0, 1.0]), height)
    for angle in np.arange(3) * math.pi / 3.0:
        yield circle(np.array([-math.sin(angle), math.cos(angle), 0.0]), 0.0)


class SphereCanvas:
    """Matplotlib axes with an orthographic view of the unit sphere from an azimuth and elevation in radians.

    Later items are drawn above earlier ones.  Lengths of text are in points, all others in radii of the sphere.
    """

    def __init__(self, frame: Frame, view: tuple[float, float], colour: Colour) -> None:
        self.frame, self.view, self.colour = frame, view, colour
        self._order = 1.0
        figure = frame.get_figure(root=True)
        assert figure is not None
        self.point = 2.0 * ROOM / (72.0 * figure.get_figwidth())
        """Size of a typographic point, in radii of the sphere."""
        self._taken: list[tuple[float, float, float]] = []

    def prepare(self) -> None:
        """Set the limits and hide the axes."""
        self.frame.set(xlim=(-ROOM, ROOM), ylim=(-ROOM, ROOM), aspect="equal")
        self.frame.set_axis_off()

    def start(self, order: float) -> None:
        """Set the drawing order of the next item."""
        self._order = order

    def above(self) -> float:
        """Return the drawing order of the next item, above all previous ones."""
        self._order += 0.001
        return self._order

    def at(self, point: Point) -> tuple[float, float, float]:
        """Return a point (3,) in view coordinates."""
        ((x, y, depth),) = seen(np.asarray(point, float)[None, :], *self.view)
        return float(x), float(y), float(depth)

    def is_near(self, point: Point) -> bool:
        """Return True if the point lies on the near half."""
        return self.at(point)[2] >= 0.0

    def outline(self) -> None:
        """Draw the outline of the sphere."""
        self.frame.plot(
            np.cos(_ANGLES),
            np.sin(_ANGLES),
            color=self.colour(theme.INK),
            linewidth=0.6,
            alpha=0.5,
            zorder=self.above(),
        )

    def stroke(self, curve: Array, look: Look, near: bool, alpha: float = 1.0, sides: Array | None = None) -> None:
        """Draw the parts of a curve (n, 3) where it, or else `sides` (n, 3), is on the given half."""
        ink, dash, weight = look
        place, depth = seen(curve, *self.view), seen(curve if sides is None else sides, *self.view)[:, 2]
        at = np.flatnonzero((depth[1:] + depth[:-1] >= 0.0) == near)
        order = self.above()
        for run in np.split(at, np.flatnonzero(np.diff(at) > 1) + 1):
            if run.size:
                part = place[run[0] : run[-1] + 2]
                self.frame.plot(
                    part[:, 0],
                    part[:, 1],
                    color=self.colour(ink),
                    linestyle=dash,
                    linewidth=weight,
                    alpha=alpha,
                    zorder=order,
                )

    def line(self, start: Point, end: Point, look: Look, alpha: float = 1.0) -> None:
        """Draw a straight line, including hidden parts."""
        (x0, y0, _), (x1, y1, _) = self.at(start), self.at(end)
        self.frame.plot(
            (x0, x1),
            (y0, y1),
            color=self.colour(look[0]),
            linewidth=look[2],
            alpha=alpha,
            solid_capstyle="round",
            zorder=self.above(),
        )

    def area(self, corners: Array, **style: Any) -> None:
        """Draw a polygon (n, 2) in the plane of the picture."""
        from matplotlib.patches import Polygon

        # `add_artist`, because `add_patch` computes the extent first, which takes longer than drawing.
        self.frame.add_artist(Polygon(corners, zorder=self.above(), **style))

    def disc(self, x: float, y: float, radius: float, **style: Any) -> None:
        """Draw a disc in the plane of the picture; radius : in radii of the sphere."""
        from matplotlib.patches import Circle

        self.frame.add_patch(Circle((x, y), radius, zorder=self.above(), **style))

    def dot(self, x: float, y: float, size: float, **style: Any) -> None:
        """Draw a disc in the plane of the picture; size : diameter in typographic points."""
        self.frame.plot([x], [y], marker="o", markersize=size, linestyle="none", zorder=self.above(), **style)

    def moving_point(self, at: Point, near: bool) -> None:
        """Draw the moving point; a dashed ring marks one that is hidden."""
        x, y, _ = self.at(at)
        ink = self.colour(theme.INK)
        self.dot(x, y, 6.5, markerfacecolor=theme.POINT, markeredgecolor=ink, markeredgewidth=0.9)
        if not near:
            radius = 6.6 * self.point
            ring: dict[str, Any] = {
                "color": ink,
                "linewidth": 0.9,
                "linestyle": (0, (2.2, 2.1)),
                "zorder": self.above(),
            }
            self.frame.plot(x + radius * np.cos(_ANGLES), y + radius * np.sin(_ANGLES), **ring)

    def write(self, label: str, x: float, y: float, alpha: float = 1.0) -> None:
        """Draw a label in the plane of the picture, completely visible and clear of other labels."""
        if not label:
            return
        from matplotlib import rcParams

        size = float(rcParams["font.size"])
        across, up = 0.31 * size * len(label) * self.point, 0.62 * size * self.point
        places = [
            (
                min(max(x + far * a * (across + size * self.point), across - ROOM), ROOM - across),
                min(max(y + far * 2.05 * b * up, up - ROOM), ROOM - up),
            )
            for far in (1, 2)
            for a, b in _ASIDE
        ]
        free = (
            place
            for place in places
            if all(
                abs(place[0] - other) >= across + wide or abs(place[1] - high) >= 2.0 * up
                for other, high, wide in self._taken
            )
        )
        left, top = next(free, places[0])
        self._taken.append((left, top, across))
        self.frame.text(
            left, top, label, ha="center", va="center", color=self.colour(theme.INK), alpha=alpha, zorder=self.above()
        )
