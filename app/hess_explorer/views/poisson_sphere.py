"""The Poisson sphere: the vertical γ as seen from the body, drawn by "sphere.js"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hess_explorer.protocol.wire import Wire

__all__ = ["Circle", "Mark", "PoissonSphere"]


@dataclass(frozen=True)
class Circle:
    """The circle (γ, axis) = height; look: "limit", "stable", "unstable" or "muted"."""

    axis: Sequence[float]
    height: float
    look: str


@dataclass(frozen=True)
class Mark:
    """A point of the sphere with a label; look: "stable", "unstable" or "muted"."""

    at: Sequence[float]
    look: str
    label: str = ""


class PoissonSphere:
    """Draws tracks that other pictures hold in their sources (columns g1, g2, g3).

    tracks : source → look: "orbit", "second", "stable", "unstable" or "muted".
    """

    kind = "sphere"

    def __init__(self, wire: Wire, tracks: Mapping[str, str], name: str = "sphere") -> None:
        self.wire = wire
        self.name = name
        self._tracks = dict(tracks)
        self._shown: dict[str, Any] | None = None

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know."""
        return {"name": self.name, "kind": self.kind, "tracks": self._tracks}

    def show(self, axis: Sequence[float] = (), label: str = "", circles: Sequence[Circle] = (),
             marks: Sequence[Mark] = ()) -> None:
        """The axis (a unit vector, or none) with its label, circles and marks."""
        plain = {
            "axis": [float(x) for x in axis], "label": label,
            "circles": [[*map(float, one.axis), float(one.height), one.look] for one in circles],
            "marks": [[*map(float, one.at), one.look, one.label] for one in marks],
        }
        if plain != self._shown:
            self._shown = plain
            self.wire.put(self.name, plain)

    def show_nothing(self, sentence: str = "") -> None:
        """Neither axis nor circles nor marks; tracks are their own pictures' to clear, the reason its caption's."""
        self.show()
