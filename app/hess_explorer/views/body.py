"""The body itself as it lies in space, solid, and what of it draws curves on a sphere fixed there: "body.js"."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Sign, Sources, column
from hess_explorer.views.picture import Picture
from hess_explorer.views.poisson_sphere import Circle, Direction, Mark, drawn
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Attitude, Lying

__all__ = ["BodyInSpace", "Curve", "Rod", "Shape", "Trail", "Wheels", "seen_in_space"]

S = TypeVar("S")

LARGEST = 0.8
"""Half the longest axis of the ellipsoid, in radii of the sphere that the picture turns on."""

_COLUMNS = ("g1", "g2", "g3", "e1", "e2", "e3")


_THINNEST = 0.12
"""Of the half axes, of the longest: a thinner body would not be seen from the side."""


@dataclass(frozen=True)
class Shape:
    """A body with a fixed point, in the coordinates in which its attitude is given.

    axes : (3, 3), the principal axes in its rows; moments : (3,); names : of the axes.
    section : (3,), the normal of a circular section of the gyration ellipsoid, whose radius belongs to the middle
    moment: then that ellipsoid is drawn, (M, I⁻¹M) = const; None: the ellipsoid of inertia is, (ω, Iω) = const.
    """

    axes: Array
    moments: Array
    section: Array | None
    names: tuple[str, str, str] = ("1", "2", "3")

    @classmethod
    def of_tensor(cls, tensor: Array, section: Sequence[float] | Array | None = None) -> Shape:
        """From the tensor of inertia (3, 3), with axes that have no names."""
        moments, vectors = np.linalg.eigh(tensor)
        # Round-off may leave nothing, or less, of a moment much smaller than the others.
        moments = np.maximum(moments, 1e-9 * moments[-1])
        return cls(vectors.T, moments, None if section is None else np.asarray(section, float), ("", "", ""))

    @property
    def semi_axes(self) -> Array:
        """Half the axes of the picture's ellipsoid, as √I1 : √I2 : √I3 or as their inverses; shape (3,)."""
        lengths = np.sqrt(self.moments) if self.section is not None else 1.0 / np.sqrt(self.moments)
        return LARGEST * np.maximum(lengths / np.max(lengths), _THINNEST)


@dataclass(frozen=True)
class Wheels:
    """Vagner's wheels for the constraint (ω, e) = 0: they roll on a fixed shell without slipping sideways.

    Their axles are parallel, `at` and −`at` touch the shell, the plane of both is that of `at` and `e`: the velocity
    ω × at has no part along the axle at × e exactly if (ω, e) = 0.

    at : a unit vector of the body across e; e : the unit vector of the constraint.
    """

    at: Sequence[float] | Array
    e: Sequence[float] | Array


@dataclass(frozen=True)
class Trail:
    """What the point of the unit sphere along a direction of the body leaves behind; look as of `Rod`."""

    along: Sequence[float] | Array
    look: str


@dataclass(frozen=True)
class Rod:
    """A rod from the fixed point to the unit sphere, along a direction of the body, with a dot and a label.

    look : "mass", which ends in a ball, "axis", "orbit", "second", "stable", "unstable" or "muted".
    """

    along: Sequence[float] | Array
    look: str
    label: str = ""


@dataclass(frozen=True)
class Curve:
    """A curve in space, components (n, 3) along (γ, e, γ × e); look as of `Rod`, or "limit"; its width in pixels."""

    points: Array
    look: str
    weight: float = 0.0


def seen_in_space(points: Array) -> Array:
    """Components along (γ, e, γ × e) → along the axes of the picture: e, γ × −e and upwards, −γ."""
    return np.stack([points[..., 1], -points[..., 2], -points[..., 0]], axis=-1)


_WHEELS = Sign(
    "wheels of the constraint: (ω, e) = 0, e in their plane",
    "dot",
    f"background: {theme.FORBIDDEN}; border: 2.5px solid",
)


@dataclass(frozen=True, kw_only=True)
class BodyInSpace(Picture[S]):
    """The sphere fixed in space, γ downwards as gravity, and in it the body at the time of the player.

    shape(state) : the body with its ellipsoid, None for none.
    motion(state) : its attitude, and the times (n,) of that in the player's units; None for none.
    wheels(state), trail(state) : of its constraint, and of one of its points.
    hollow : a ball of glass, rolling on a ball inside, stands for the ellipsoid; heavy(state) : whether γ is gravity.
    attitude : the picture whose attitude it follows, where it has none of its own.
    rods, curves : drawn with the body, and in space; circles, marks : fixed in the picture's space.
    bare : without the lines of the sphere.
    """

    shape: Callable[[S], Shape | None] = lambda state: None
    motion: Callable[[S], tuple[Attitude | Lying, Array] | None] | None = None
    wheels: Callable[[S], Wheels] | None = None
    trail: Callable[[S], Trail] | None = None
    hollow: bool = False
    heavy: Callable[[S], bool] = lambda state: True
    attitude: str = ""
    rods: Callable[[S], Sequence[Rod]] = lambda state: ()
    curves: Callable[[S], Sequence[Curve]] = lambda state: ()
    circles: Sequence[Circle] = ()
    marks: Sequence[Mark] = ()
    bare: bool = False

    kind: ClassVar[str] = "sphere"

    @property
    def needs(self) -> frozenset[str]:
        """The pictures whose data must be there for it."""
        return super().needs | ({self.attitude} if self.attitude else set())

    @property
    def tracks(self) -> frozenset[str]:
        """The player takes the time from the track of the orbit."""
        return frozenset({"orbit"})

    @property
    def legend(self) -> tuple[Sign, ...]:
        """What it adds to the legend of its scene."""
        return (*self.signs, *((_WHEELS,) if self.wheels else ()))

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know."""
        title = self.title if isinstance(self.title, str) else "The body in space"
        return {
            **super().describe(),
            "tracks": {},
            "attitude": self.attitude or self.name,
            "title": title,
            "bare": self.bare,
        }

    def data(self, state: S) -> Sources:
        """Return the body, its motion, and what is drawn beside."""
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
                "section": [] if shape.section is None else [*map(float, shape.section), radius],
            }
        if self.wheels is not None:
            wheels = self.wheels(state)
            columns["wheels"] = [*map(float, wheels.at), *map(float, wheels.e)]
        if self.trail is not None:
            trail = self.trail(state)
            columns["trail"] = [*map(float, trail.along), trail.look]
        label = "γ, gravity" if self.heavy(state) else "γ"
        return {
            self.name: {
                **columns,
                "rods": [[*map(float, one.along), one.look, one.label] for one in self.rods(state)],
                "curves": [[one.look, one.weight, *column(seen_in_space(one.points).T)] for one in self.curves(state)],
                **drawn(Direction((0.0, 0.0, -1.0), label), self.circles, self.marks),
            }
        }
