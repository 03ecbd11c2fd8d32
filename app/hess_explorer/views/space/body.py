"""The body in space, and the curves that its points trace on a fixed sphere; rendered by "body.js"."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Sign, Sources, column
from hess_explorer.views.picture import Picture
from hess_explorer.views.space.poisson_sphere import Circle, Direction, Mark, shape_columns
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Attitude, contact_arc
from hess_mechanics.rigid_body.inertia import paired_weights

S = TypeVar("S")

LARGEST = 0.8
"""Longest semi-axis of the ellipsoid, in radii of the fixed sphere."""

_COLUMNS = ("g1", "g2", "g3", "e1", "e2", "e3")


_WEIGHT = 0.07
"""Largest radius of a weight; its centre is that far above the surface."""
_WALL = 0.71
"""Radius of the middle of a hollow ball's wall."""
_THINNEST = 0.12
"""Smallest semi-axis, relative to the longest: a thinner body would be invisible from the side."""


@dataclass(frozen=True)
class Shape:
    """Ellipsoid of a body with a fixed point, in the axes of its attitude.

    Attributes
    ----------
    axes : array (3, 3)
        Principal axes in rows.
    moments : array (3,)
        Principal moments of inertia, in the order of the axes.
    section : array (3,) or None
        Normal of a circular section of the gyration ellipsoid (M, I⁻¹M) = const, which is then drawn.  None draws the
        ellipsoid of inertia (ω, Iω) = const.
    names : tuple of str
        Names of the axes.
    """

    axes: Array
    moments: Array
    section: Array | None
    names: tuple[str, str, str] = ("1", "2", "3")

    @classmethod
    def of_tensor(cls, tensor: Array, section: Sequence[float] | Array | None = None) -> Shape:
        """Return the shape of a tensor of inertia (3, 3), with unnamed axes and increasing moments."""
        moments, vectors = np.linalg.eigh(tensor)
        # Round-off may make a very small moment zero or negative.
        moments = np.maximum(moments, 1e-9 * moments[-1])
        return cls(vectors.T, moments, None if section is None else np.asarray(section, float), ("", "", ""))

    @property
    def semi_axes(self) -> Array:
        """Semi-axes (3,) of the ellipsoid: √I1 : √I2 : √I3 for the gyration ellipsoid, otherwise their inverses.

        The longest is `LARGEST`; none is shorter than 0.12 of it.
        """
        lengths = np.sqrt(self.moments) if self.section is not None else 1.0 / np.sqrt(self.moments)
        return LARGEST * np.maximum(lengths / np.max(lengths), _THINNEST)

    def weights(self, centre: Array | None, hollow: bool) -> Array:
        """Return six weights on the principal axes, rows (x, y, z, radius), with the moments of inertia of the body.

        Their volumes are proportional to their masses.  Shape (0, 4) if the moments are not those of a rigid body.

        Parameters
        ----------
        centre : array (3,) or None
            Direction of their centre of mass; None for the fixed point.
        hollow : bool
            True for weights in the wall of a hollow ball.
        """
        arms = np.full(3, _WALL) if hollow else self.semi_axes + _WEIGHT
        masses = paired_weights(self.moments, arms, None if centre is None else self.axes @ centre)
        if masses is None:
            return np.empty((0, 4))
        radii = _WEIGHT * np.cbrt(masses / np.max(masses))
        at = arms[:, None] * self.axes
        return np.column_stack([np.vstack([at, -at]), radii.T.ravel()])


@dataclass(frozen=True)
class Wheels:
    """Vagner's wheels for the constraint (ω, e) = 0: they roll on a fixed shell without slipping sideways.

    The axles are parallel; the points c = `contact` and −c touch the shell; the wheels lie in the plane of c and `e`.
    The velocity ω × c has no component along the axle c × e if and only if (ω, e) = 0.

    Attributes
    ----------
    contact : sequence of float
        Unit vector (3,) of the body orthogonal to e.
    e : sequence of float
        Unit vector (3,) of the constraint.
    style : str
        Style of the trace, as in `Rod`.
    """

    contact: Sequence[float] | Array
    e: Sequence[float] | Array
    style: str = "orbit"


@dataclass(frozen=True)
class Rod:
    """A rod from the fixed point to the unit sphere, along a direction of the body, with a dot and a label.

    Attributes
    ----------
    along : sequence of float
        Unit vector (3,) of the body.
    style : str
        "mass" (ends in a ball), "axis", "orbit", "second", "stable", "unstable" or "muted".
    label : str
        Text at the end of the rod; empty for none.
    """

    along: Sequence[float] | Array
    style: str
    label: str = ""


@dataclass(frozen=True)
class Curve:
    """A curve fixed in space.

    Attributes
    ----------
    points : array (n, 3)
        Components along (γ, e, γ × e).
    style : str
        A style of `Rod`, or "limit".
    weight : float
        Line width in pixels; 0 for that of the style.
    """

    points: Array
    style: str
    weight: float = 0.0


def to_picture_axes(points: Array) -> Array:
    """Convert components (..., 3) along (γ, e, γ × e) to the axes of the picture: e, −γ × e and −γ (upwards)."""
    return np.stack([points[..., 1], -points[..., 2], -points[..., 0]], axis=-1)


_WHEEL = Sign(
    "wheels of the constraint: (ω, e) = 0, e in their plane",
    "dot",
    f"background: {theme.FORBIDDEN}; border: 2.5px solid",
)
_TRACE = "trace of a wheel; a dot for each of its turns"
_WEIGHTS = Sign("weights with the body's moments of inertia", "dot", "background: #7C8794")


@dataclass(frozen=True, kw_only=True)
class BodyInSpace(Picture[S]):
    """A sphere fixed in space, with γ pointing down, and the body inside at the time of the player.

    Attributes
    ----------
    shape : callable
        `shape(state)` returns the ellipsoid of the body, or None.
    motion : callable or None
        `motion(state)` returns its attitude and the times (n,) in the player's units; None for an empty picture.
    wheels : Wheels or None
        The wheels of its constraint.
    trail : callable
        `trail(state)` returns the direction (3,) whose trace is drawn, or None.
    mass : callable
        `mass(state)` returns the direction (3,) of the centre of mass of the weights, or None for the fixed point.
    hollow : bool
        True to draw a glass ball rolling on an inner ball instead of the ellipsoid.
    heavy : callable
        `heavy(state)` returns whether γ is the direction of gravity.
    attitude : str
        Name of the picture whose attitude it follows; empty if it has its own.
    rods : callable
        `rods(state)` returns rods fixed to the body.
    curves : callable
        `curves(state)` returns curves in space.
    circles, marks : sequence
        Circles and marks fixed in the space of the picture.
    without_grid : bool
        True to omit the lines of the sphere.
    """

    shape: Callable[[S], Shape | None] = lambda state: None
    motion: Callable[[S], tuple[Attitude, Array] | None] | None = None
    wheels: Wheels | None = None
    trail: Callable[[S], Sequence[float] | Array | None] = lambda state: None
    mass: Callable[[S], Array | None] = lambda state: None
    hollow: bool = False
    heavy: Callable[[S], bool] = lambda state: True
    attitude: str = ""
    rods: Callable[[S], Sequence[Rod]] = lambda state: ()
    curves: Callable[[S], Sequence[Curve]] = lambda state: ()
    circles: Sequence[Circle] = ()
    marks: Sequence[Mark] = ()
    without_grid: bool = False

    kind: ClassVar[str] = "sphere"

    @property
    def dependencies(self) -> frozenset[str]:
        """Names of the pictures whose data the picture requires."""
        return super().dependencies | ({self.attitude} if self.attitude else set())

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the picture adds to the legend of its scene."""
        colour = "" if self.wheels is None else theme.SHADES[self.wheels.style][0]
        wheels = (_WHEEL, Sign(_TRACE, "line", f"border-top: 3px dotted {colour}")) if colour else ()
        return (*self.signs, *wheels, *((_WEIGHTS,) if self.motion else ()))

    def describe(self) -> dict[str, Any]:
        """Return the description of the picture for the browser."""
        title = self.title if isinstance(self.title, str) else "The body in space"
        return {
            **super().describe(),
            "tracks": {},
            "attitude": self.attitude or self.name,
            "title": title,
            "bare": self.without_grid,
        }

    def data(self, state: S) -> Sources:
        """Return the columns of the body, its motion, and the marks and curves; empty if `motion(state)` is None."""
        shape = self.shape(state)
        motion = None if self.motion is None else self.motion(state)
        if self.motion is not None and motion is None:
            return {self.name: {}}
        columns: dict[str, Any] = {}
        if motion is not None:
            attitude, times = motion
            directions = attitude.axes[:, :2].reshape(len(times), 6)
            columns = {"t": column(times), **{name: column(directions[:, i]) for i, name in enumerate(_COLUMNS)}}
        if shape is not None:
            semi = [LARGEST] * 3 if self.hollow else shape.semi_axes.tolist()
            radius = LARGEST * math.sqrt(float(np.median(shape.moments) / np.max(shape.moments)))
            columns |= {
                "axes": shape.axes.tolist(),
                "semi": semi,
                "names": list(shape.names),
                "hollow": self.hollow,
                "weights": shape.weights(self.mass(state), self.hollow).tolist(),
                "section": [] if shape.section is None else [*map(float, shape.section), radius],
            }
        if self.wheels is not None and motion is not None:
            wheels = self.wheels
            columns["wheels"] = [*map(float, wheels.contact), *map(float, wheels.e), wheels.style]
            columns["arc"] = column(contact_arc(attitude.axes, wheels.contact, wheels.e))
        trail = self.trail(state)
        if trail is not None:
            columns["trail"] = [*map(float, trail), "orbit"]
        label = "γ, gravity" if self.heavy(state) else "γ"
        return {
            self.name: {
                **columns,
                "rods": [[*map(float, one.along), one.style, one.label] for one in self.rods(state)],
                "curves": [
                    [one.style, one.weight, *column(to_picture_axes(one.points).T)] for one in self.curves(state)
                ],
                **shape_columns(Direction((0.0, 0.0, -1.0), label), self.circles, self.marks),
            }
        }
