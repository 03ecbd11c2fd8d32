"""What the scenes of orbits have in common: accuracy, cache, status line, refusal."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import Any, Protocol

from hess_explorer.compute.cache import CACHE, Task
from hess_explorer.protocol.parameters import Choice, Value, Values, places, written
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Picture
from hess_mechanics.dynamics.sampling import HALF_A_PIXEL
from hess_mechanics.numerics.accuracy import LEVELS, Level, Status, cheapest, level
from hess_mechanics.numerics.results import Array, Cost

__all__ = ["ACCURACY", "Window", "Work", "inside", "orbit_status", "refuse", "tidy_window", "window_of"]

ACCURACY = Choice("accuracy", "Accuracy", tuple(LEVELS), "standard",
                  "Promised error: draft 1e-3, standard 1e-6, precise 1e-9; reference: the floor of double precision.")


Window = tuple[tuple[float, float], tuple[float, float]]
"""Two opposite corners of what is seen, the lower left one first."""


def tidy_window(text: Value) -> str:
    """The text of a window with its corners in order; empty where it is none."""
    corners = places(text)
    if len(corners) != 2 or corners[0][0] == corners[1][0] or corners[0][1] == corners[1][1]:
        return ""
    (x0, y0), (x1, y1) = corners
    return written([(min(x0, x1), min(y0, y1)), (max(x0, x1), max(y0, y1))])


def window_of(text: Value, full: Window) -> Window:
    """The window that an admitted text means; `full` where it is empty."""
    corners = places(text)
    return (corners[0], corners[1]) if len(corners) == 2 else full


def inside(points: Sequence[tuple[float, float]], window: Window) -> list[tuple[float, float]]:
    """Those of the points that lie in the window."""
    (x0, y0), (x1, y1) = window
    return [(x, y) for x, y in points if x0 <= x <= x1 and y0 <= y <= y1]


class Work:
    """The computation of one state: at which level, and what came from the cache."""

    def __init__(self, values: Values, dragging: bool) -> None:
        self._start = time.perf_counter()
        self._misses = 0
        self._dragging = dragging
        self.todo: list[Task] = []
        self.pieces = 0
        chosen = level(str(values["accuracy"]))
        # While a slider is dragged, the cheapest that is right to a pixel.
        self.level: Level = min(chosen, cheapest(HALF_A_PIXEL), key=lambda rung: rung.order) if dragging else chosen

    def get(self, function: Callable[..., Any], *arguments: Hashable) -> Any:
        """The cached result of function(*arguments)."""
        value, hit = CACHE.get(function, *arguments)
        self._misses += not hit
        return value

    def later(self, function: Callable[..., Any], *arguments: Hashable) -> Any | None:
        """The same if it is known already; else None, and it is left `todo`."""
        self.pieces += 1
        value = CACHE.peek(function, *arguments)
        if value is None:
            self.todo.append(Task(function, arguments))
        return value

    def sooner(self, whole: Task, few: Task) -> Any:
        """The result of `whole` if it is known and no slider is dragged; for now that of `few`."""
        known = None if self._dragging else CACHE.peek(whole.function, *whole.arguments)
        if known is not None:
            self.pieces += 1
            return known
        found = self.get(few.function, *few.arguments)
        if not self._dragging:
            self.later(whole.function, *whole.arguments)
        return found

    def ended(self) -> str:
        """For the status line: how long it took until now, and whether anything was computed."""
        ms = (time.perf_counter() - self._start) * 1e3
        return f"{ms:.1f} ms, {'computed' if self._misses else 'cached'}"


class _Motion(Protocol):
    times: Array
    level: str
    status: Status
    error_estimate: float
    drift: Mapping[str, float]
    cost: Cost


def orbit_status(orbit: _Motion) -> list[str]:
    """For the status line: size, cost, error and drift of an orbit."""
    return [
        f"{orbit.level}: orbit {orbit.times.size} points, {orbit.cost.steps} Taylor steps, "
        f"error ≤ {orbit.error_estimate:.1e} ({orbit.status})",
        "drift " + " ".join(f"{name} {drift:.0e}" for name, drift in orbit.drift.items()),
    ]


def refuse(pictures: Sequence[Picture], wire: Wire, sentence: str) -> None:
    """Empty pictures, and the sentence where the eye is."""
    for picture in pictures:
        picture.show_nothing(sentence)
        wire.say(picture.name, sentence)
