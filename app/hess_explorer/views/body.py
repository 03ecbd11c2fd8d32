"""The body itself as it lies in space, or what of it draws curves on a sphere fixed there; drawn by "body.js"."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from hess_explorer.views.layers import Axes, Columns, f32
from hess_explorer.views.picture import Picture
from hess_explorer.views.poisson_sphere import Circle, Mark
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Attitude

__all__ = ["BodyInSpace", "Curve", "Rod", "Shape", "seen_in_space"]

S = TypeVar("S")

LARGEST = 0.8
"""Half the longest axis of the ellipsoid, in radii of the sphere that the picture turns on."""

_COLUMNS = ("g1", "g2", "g3", "e1", "e2", "e3")


@dataclass(frozen=True)
class Shape:
    """A body with a fixed point, in the coordinates in which its attitude is given.

    axes : (3, 3), the principal axes in its rows; moments : (3,); centre : (3,), the direction of the centre of mass,
    perpendicular to a circular section of the gyration ellipsoid, whose radius belongs to the middle moment; names : of
    the axes.
    """

    axes: Array
    moments: Array
    centre: Array
    names: tuple[str, str, str] = ("1", "2", "3")

    @classmethod
    def of_tensor(cls, tensor: Array, centre: Sequence[float] | Array) -> Shape:
        """From the tensor of inertia (3, 3), with axes that have no names."""
        moments, vectors = np.linalg.eigh(tensor)
        return cls(vectors.T, moments, np.asarray(centre, float), ("", "", ""))

    @property
    def semi_axes(self) -> Array:
        """Of the gyration ellipsoid (M, I⁻¹M) = const, which are as √I1 : √I2 : √I3, for the picture; shape (3,)."""
        return LARGEST * np.sqrt(self.moments / np.max(self.moments))


@dataclass(frozen=True)
class Rod:
    """A rod from the fixed point to the unit sphere, along a direction of the body, with a dot and a label.

    look : "mass", "orbit", "second", "stable", "unstable" or "muted".
    """

    along: Sequence[float] | Array
    look: str
    label: str = ""


@dataclass(frozen=True)
class Curve:
    """A curve in space, components (n, 3) along (γ, e, γ × e); look as of `Rod`, or "limit"."""

    points: Array
    look: str


def seen_in_space(points: Array) -> Array:
    """Components along (γ, e, γ × e) → along the axes of the picture: e, γ × −e and upwards, −γ."""
    return np.stack([points[..., 1], -points[..., 2], -points[..., 0]], axis=-1)


@dataclass(frozen=True, kw_only=True)
class BodyInSpace(Picture[S]):
    """The sphere fixed in space, γ downwards as gravity, and in it the body at the time of the player.

    shape(state) : the body with its ellipsoid, None for none.
    motion(state) : its attitude, and the times (n,) of that in the player's units; None for none.
    attitude : the picture whose attitude it follows, where it has none of its own.
    rods, curves : drawn with the body, and in space; circles, marks : fixed in the picture's space.
    bare : without the lines of the sphere.
    """

    shape: Callable[[S], Shape | None] | None = None
    motion: Callable[[S], tuple[Attitude, Array] | None] | None = None
    attitude: str = ""
    rods: Callable[[S], Sequence[Rod]] | None = None
    curves: Callable[[S], Sequence[Curve]] | None = None
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

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know."""
        title = self.title if isinstance(self.title, str) else "The body in space"
        return {**super().describe(), "tracks": {}, "attitude": self.attitude or self.name, "title": title,
                "bare": self.bare}

    def data(self, state: S) -> dict[str, Columns]:
        """The body, its motion, and what is drawn beside."""
        shape = None if self.shape is None else self.shape(state)
        motion = None if self.motion is None else self.motion(state)
        if self.motion is not None and motion is None:
            return self.nothing("", None)
        columns: dict[str, Any] = {}
        if motion is not None:
            attitude, times = motion
            directions = attitude.axes[:, :2].reshape(len(times), 6)
            columns = {"t": f32(times), **{name: f32(directions[:, i]) for i, name in enumerate(_COLUMNS)}}
        if shape is not None:
            radius = LARGEST * math.sqrt(float(np.median(shape.moments) / np.max(shape.moments)))
            columns |= {"axes": shape.axes.tolist(), "semi": shape.semi_axes.tolist(), "names": list(shape.names),
                        "section": [*map(float, shape.centre), radius]}
        rods = () if self.rods is None else self.rods(state)
        curves = () if self.curves is None else self.curves(state)
        return {self.name: {
            **columns,
            "rods": [[*map(float, one.along), one.look, one.label] for one in rods],
            "curves": [[one.look, *f32(seen_in_space(one.points).T)] for one in curves],
            "axis": [0.0, 0.0, -1.0], "label": "γ",
            "circles": [[*map(float, one.axis), float(one.height), one.look] for one in self.circles],
            "marks": [[*map(float, one.at), one.look, one.label] for one in self.marks]}}

    def nothing(self, sentence: str, axes: Axes | None) -> dict[str, Columns]:
        """The empty sphere; the reason is for the caption to say."""
        return {self.name: {}}
