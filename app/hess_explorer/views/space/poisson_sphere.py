"""The Poisson sphere: the vertical γ in the body frame; the browser draws it on a separate canvas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import MOVING_POINT, Columns, Sign, Sources, column
from hess_explorer.views.picture import Picture
from hess_mechanics.numerics.results import Array

S = TypeVar("S")


@dataclass(frozen=True)
class Circle:
    """The circle (γ, axis) = height on the sphere.

    Attributes
    ----------
    axis : sequence of float
        Unit vector (3,).
    height : float
        Component of γ along the axis, −1 to 1.
    style : str
        "limit", "stable", "unstable" or "muted".
    """

    axis: Sequence[float] | Array
    height: float
    style: str


EQUATOR = Circle((0.0, 0.0, 1.0), 0.0, "limit")


@dataclass(frozen=True)
class Mark:
    """A point on the sphere.

    Attributes
    ----------
    position : sequence of float
        Unit vector (3,).
    style : str
        "stable", "unstable" or "muted".
    label : str
        Text beside the point; empty for none.
    """

    position: Sequence[float] | Array
    style: str
    label: str = ""


@dataclass(frozen=True)
class Direction:
    """A direction of the body.

    Attributes
    ----------
    along : sequence of float
        Unit vector (3,).
    label : str
        Name of the direction.
    """

    along: Sequence[float] | Array
    label: str


def ends(axis: Array) -> tuple[Mark, Mark]:
    """Return muted marks at both ends of an axis, given as a unit vector (3,)."""
    return Mark(axis, "muted"), Mark(-axis, "muted")


def centre_of_mass(b: Sequence[float]) -> Direction | None:
    """Return the direction r of the centre of mass, b = −mg r, with b (3,); None without a field."""
    length = float(np.linalg.norm(b))
    return Direction(-np.array(b) / length, "r") if length > 0.0 else None


def parallels(axis: Sequence[float] | Array, heights: Iterable[float]) -> list[Circle]:
    """Return the limit circles at the given heights about an axis; heights of at least 1 in size are left out."""
    return [Circle(axis, height, "limit") for height in heights if abs(height) < 1.0 - 1e-9]


def levels_about(axis: Direction | None, heights: Iterable[float]) -> list[Circle]:
    """Return circles at the given heights about an axis; empty without an axis."""
    return [] if axis is None else [Circle(axis.along, height, "muted") for height in heights]


def gamma_columns(gamma: Array) -> Columns:
    """Return the columns g1, g2 and g3 of γ (n, 3) along a motion."""
    return {f"g{i + 1}": column(gamma[:, i]) for i in range(3)}


@dataclass(frozen=True, kw_only=True)
class Sphere(Picture[S]):
    """The sphere with the tracks of the scene that have columns g1, g2, g3.

    Attributes
    ----------
    looks : mapping of str to str
        Style of each track: "orbit", "second", "stable", "unstable" or "muted".
    axis : callable
        `axis(state)` returns a direction to draw, or None.
    circles, marks : callable
        Functions of the state that return circles and marked points.
    colour : callable, optional
        `colour(state)` returns the index of the orbit's colour in `theme.CHOSEN`, instead of its style.
    clouds : str
        Name of the picture whose clouds are shown; empty for none.
    labels : tuple of str
        Names of the three axes.
    """

    name: str = "sphere"
    title: str | Callable[[S], str] = "Poisson sphere"
    looks: Mapping[str, str]
    axis: Callable[[S], Direction | None] = lambda state: None
    circles: Callable[[S], Sequence[Circle]] = lambda state: ()
    marks: Callable[[S], Sequence[Mark]] = lambda state: ()
    colour: Callable[[S], int] | None = None
    clouds: str = ""
    labels: tuple[str, str, str] = ("γ₁", "γ₂", "γ₃")

    kind: ClassVar[str] = "sphere"

    @property
    def dependencies(self) -> frozenset[str]:
        """Names of the pictures whose data the picture requires."""
        return super().dependencies | ({self.clouds} if self.clouds else set())

    @property
    def tracks(self) -> frozenset[str]:
        """Names of the tracks that the picture requires; clouds follow the time of the orbit."""
        return frozenset(self.looks) | ({"orbit"} if self.clouds else set())

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the picture adds to the legend of its scene."""
        return (*self.signs, *((MOVING_POINT,) if "orbit" in self.looks else ()))

    def describe(self) -> dict[str, Any]:
        """Return the description of the picture for the browser."""
        clouds = {"clouds": self.clouds} if self.clouds else {}
        tracks = {f"data-{track}": look for track, look in self.looks.items()}
        return {**super().describe(), "tracks": tracks, "labels": self.labels, **clouds}

    def data(self, state: S) -> Sources:
        """Return the columns of the axis, circles and marks."""
        look = {} if self.colour is None else {"look": f"chosen-{self.colour(state)}"}
        return {self.name: {**shape_columns(self.axis(state), self.circles(state), self.marks(state)), **look}}


def orbit_sphere(
    axis: Callable[[S], Direction | None],
    circles: Callable[[S], Sequence[Circle]],
    colour: Callable[[S], int] | None = None,
) -> Sphere[S]:
    """Return the sphere with the vertical along the track "orbit" and, in a field, the centre of mass."""
    return Sphere(
        looks={"orbit": "orbit"},
        axis=axis,
        circles=circles,
        colour=colour,
        caption=lambda s: Caption(
            "The vertical γ along the chosen orbit.",
            "No field: b = 0." if axis(s) is None else "r: the centre of mass.",
        ),
    )


def shape_columns(axis: Direction | None, circles: Sequence[Circle], marks: Sequence[Mark]) -> Columns:
    """Return the columns of an axis, circles and marks."""
    return {
        "axis": [] if axis is None else [float(x) for x in axis.along],
        "label": "" if axis is None else axis.label,
        "circles": [[*map(float, one.axis), float(one.height), one.style] for one in circles],
        "marks": [[*map(float, one.position), one.style, one.label] for one in marks],
    }
