"""What the scenes of sections have in common: starts, clicks, boxes, curves over time, status line."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from hess_explorer.protocol.parameters import Values, written
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.framework.work import orbit_status
from hess_mechanics.numerics.results import Array, Orbit

__all__ = ["PIECE", "TURN", "boxed", "possible_starts", "section_status", "started", "worst"]

PIECE = 4
"""Orbits that are computed together: few enough for points to arrive soon."""
TURN = 3.14159
"""Half a turn, as a place in a link is written."""

Place = tuple[float, float]
State = tuple[float, ...]


def possible_starts(chosen: Sequence[Place], states: Array, possible: Array, instead: Callable[[], tuple[Place, State]]
                    ) -> tuple[Sequence[Place], Sequence[State], bool]:
    """Those of the chosen places where a motion is `possible` (n,), their states (n, d), and whether they were kept.

    Where the last one, that of the chosen orbit, is not possible, all are replaced by the one of `instead`.
    """
    if possible[-1]:
        kept = np.flatnonzero(possible).tolist()
        return [chosen[i] for i in kept], [tuple(map(float, states[i])) for i in kept], True
    place, state = instead()
    return [place], [state], False


def started(starts: Sequence[Place], x: float, y: float, bounds: Window) -> Values:
    """An orbit at (x, y), besides those that there are."""
    (x0, y0), (x1, y1) = bounds
    return {"starts": written([*starts, (min(max(x, x0), x1), min(max(y, y0), y1))])}


def boxed(corners: tuple[float, float, float, float], bounds: Window, name: str = "window") -> Values:
    """The window, of that name, of a box, as far as it lies within the bounds; nothing where it has no size."""
    (x0, y0), (x1, y1) = bounds
    left, right = max(x0, min(corners[0], corners[2])), min(x1, max(corners[0], corners[2]))
    low, high = max(y0, min(corners[1], corners[3])), min(y1, max(corners[1], corners[3]))
    return {name: written([(left, low), (right, high)])} if low < high and left < right else {}


def worst(drift: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    """The larger drift of each integral."""
    return {name: max(drift.get(name, 0.0), value) for name, value in other.items()}


def section_status(section: str, drift: Mapping[str, float], orbit: Orbit | None, ended: str) -> str:
    """The status line: what the section is, drift of the integrals on it, the chosen orbit, time."""
    parts = [section] if section else []
    if drift:
        parts.append("drift " + " ".join(f"{name} {value:.0e}" for name, value in drift.items()))
    if orbit is not None:
        parts += orbit_status(orbit)[:1]
    return " · ".join([*parts, ended]).replace("e-", "e−")
