"""The body itself as it lies in space, or what of it draws curves on a sphere fixed there; drawn by "body.js"."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views.figure import columns_of
from hess_explorer.views.poisson_sphere import Circle, Mark
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import Attitude

__all__ = ["BodyView", "Curve", "Rod", "Shape", "seen_in_space"]

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


class BodyView:
    """The sphere fixed in space, γ downwards as gravity, and in it the body at the time of the player.

    attitude : the source with the attitude, that of another such picture, or None for its own; title : what a screen
    reader calls it; bare : without the lines of the sphere.
    """

    kind = "sphere"

    def __init__(self, wire: Wire, name: str, title: str, attitude: str | None = None, bare: bool = False) -> None:
        self.wire = wire
        self.name = name
        self._attitude = attitude or name
        self._title, self._bare = title, bare

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know."""
        return {"name": self.name, "kind": self.kind, "tracks": {}, "attitude": self._attitude, "title": self._title,
                "bare": self._bare}

    def show(self, shape: Shape | None = None, attitude: Attitude | None = None, times: Array | None = None,
             rods: Sequence[Rod] = (), curves: Sequence[Curve] = (), circles: Sequence[Circle] = (),
             marks: Sequence[Mark] = ()) -> None:
        """The body with its ellipsoid, None for none; circles and marks are fixed in the picture's space.

        times : (n,) of the attitude in the player's units.
        """
        columns: dict[str, Any] = {}
        if attitude is not None and times is not None:
            directions = attitude.axes[:, :2].reshape(len(times), 6)
            columns = {"t": times.astype(np.float32), **columns_of(directions, _COLUMNS)}
        if shape is not None:
            radius = LARGEST * math.sqrt(float(np.median(shape.moments) / np.max(shape.moments)))
            columns |= {"axes": shape.axes.tolist(), "semi": shape.semi_axes.tolist(), "names": list(shape.names),
                        "section": [*map(float, shape.centre), radius]}
        self.wire.put(self.name, {
            **columns,
            "rods": [[*map(float, one.along), one.look, one.label] for one in rods],
            "curves": [[one.look, *np.ascontiguousarray(seen_in_space(one.points).T, np.float32)] for one in curves],
            "axis": [0.0, 0.0, -1.0], "label": "γ",
            "circles": [[*map(float, one.axis), float(one.height), one.look] for one in circles],
            "marks": [[*map(float, one.at), one.look, one.label] for one in marks]})

    def show_nothing(self, sentence: str = "") -> None:
        """The empty sphere; the reason is for the caption to say."""
        self.wire.put(self.name, {})
