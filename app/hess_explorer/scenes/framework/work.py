"""The computation of one state: its level, the cache, and the background computations."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from types import EllipsisType
from typing import Any, TypeVar, cast, overload

from hess_explorer.compute.cache import CACHE, Task
from hess_mechanics.dynamics.sampling import HALF_A_PIXEL
from hess_mechanics.numerics.accuracy import STANDARD, Kind, Level, Plan, cheapest, level, plan
from hess_mechanics.numerics.jit import compile_seconds
from hess_mechanics.numerics.results import Orbit
from hess_mechanics.suslov.free import FreeMotion

_LEAST_COMPILE_TIME = 0.1
"""Least compile time, in seconds, that the status line reports."""

AUTO = "auto"
"""Choice of accuracy for which the level is measured."""

T = TypeVar("T")


class Work:
    """The computation of one state at a level, through the cache.

    Parameters
    ----------
    accuracy : str
        Name of a level, or "auto".
    is_preview : bool
        True while a slider is held.

    Attributes
    ----------
    level_name : str
        Name of the chosen level, also while a slider is held; "standard" until the level of "auto" is measured.
    level : Level
        The level of the computation; while a slider is held, at most the cheapest one with an invisible error.
    auto : bool
        True if the level is determined by measurement, see `set_measured_level`.
    is_preview : bool
        True while a slider is held.
    pieces : int
        Number of background computations so far, known ones included.
    """

    def __init__(self, accuracy: str = "standard", is_preview: bool = False) -> None:
        self._start, self._compiled = time.perf_counter(), compile_seconds()
        self._misses = 0
        self.is_preview = is_preview
        self.auto, self._settled = accuracy == AUTO, False
        self.level_name = STANDARD.name if self.auto else accuracy
        self._todo: list[Task[Any]] = []
        self._refinements: list[Task[Any]] = []
        self.pieces = 0
        chosen = level(self.level_name)
        # While a slider is dragged, use the cheapest level with an error below half a pixel.
        self.level: Level = min(chosen, cheapest(HALF_A_PIXEL), key=lambda rung: rung.order) if is_preview else chosen

    @property
    def todo(self) -> list[Task[Any]]:
        """The computations of missing results in order; refinements of pictures only if nothing else is missing."""
        return self._todo or self._refinements

    def set_measured_level(self, name: str) -> None:
        """Set the level of "auto" to the measured one; until then it is `standard`."""
        self._settled, self.level_name, self.level = True, name, level(name)

    def plan(self, kind: Kind, steady: bool = False) -> Plan:
        """Return the settings of the level for a kind of computation.

        During a drag it keeps `share` and `cells` at 1, because the scenes choose the number of points.

        Parameters
        ----------
        kind : Kind
            The kind of computation.
        steady : bool
            True if hardly any slider changes the result; a drag then keeps the settings, at most those of `standard`.
        """
        if steady:
            return plan(
                kind,
                STANDARD.name if self.is_preview and level(self.level_name).order > STANDARD.order else self.level_name,
            )
        found = plan(kind, self.level.name)
        return replace(found, share=1.0, cells=1.0) if self.is_preview else found

    def pending_caption(self, what: str = "") -> str:
        """Return the caption of a result that is not known yet.

        Parameters
        ----------
        what : str
            Name of the result and "is" or "are"; by default the caption has no subject.
        """
        soon = "computed when the slider is released." if self.is_preview else "being computed."
        return f"{what} {soon}" if what else soon.capitalize()

    @overload
    def need(self, task: Task[T], preview: Task[T] | EllipsisType = ...) -> T: ...

    @overload
    def need(self, task: Task[T], preview: Task[T] | EllipsisType | None) -> T | None: ...

    def need(self, task: Task[T], preview: Task[T] | EllipsisType | None = ...) -> T | None:
        """Return the result of a task; until it is known, the result of its preview, which is computed at once.

        Parameters
        ----------
        task : Task
            The computation.
        preview : Task or None
            By default the task itself; None for no result.  A task with another preview is added to `todo` unless a
            slider is held.  During a drag a preview is shown even if the result is known.
        """
        if preview in (..., task):
            value, hit = CACHE.get(task.function, *task.arguments)
            self._misses += not hit
            return cast(T, value)
        known = None if self.is_preview and preview else CACHE.peek(task.function, *task.arguments)
        if not self.is_preview:
            self.pieces += 1
            if known is None:
                self._todo.append(task)
        return self.need(preview) if known is None and isinstance(preview, Task) else cast("T | None", known)

    def newest_results(self, chains: Sequence[Sequence[Task[T]]], last: bool = False) -> list[T | None]:
        """Return the last cached result of each chain of tasks, or None, and add the tasks after it to `todo`.

        Parameters
        ----------
        chains : sequence of sequences of Task
            In each chain, every task continues the one before, which need not be cached any more.
        last : bool
            True if all other computations come first.
        """
        found, waiting = [], []
        for chain in chains:
            known = ((i, CACHE.peek(task.function, *task.arguments)) for i, task in reversed([*enumerate(chain)]))
            newest, value = next(((i, value) for i, value in known if value is not None), (-1, None))
            found.append(value)
            waiting += [(i, task) for i, task in enumerate(chain) if i > newest]
        self.pieces += sum(map(len, chains))
        (self._refinements if last else self._todo).extend(task for _, task in sorted(waiting, key=lambda one: one[0]))
        return found

    def _spent(self) -> tuple[float, float]:
        """Return the computing time and the compile time so far, in seconds."""
        compiling = compile_seconds() - self._compiled
        return time.perf_counter() - self._start - compiling, compiling

    def summary(self) -> str:
        """Return a short status line: level, promised error and computing time so far."""
        chosen = f"{AUTO}: {self.level.name}" if self.auto else self.level.name
        right = "the floor of double precision" if self.level.is_floor else f"1e−{-math.log10(self.level.promise):.0f}"
        return f"{chosen}, right to {right} · {1e3 * self._spent()[0]:.0f} ms"

    def status_end(self) -> str:
        """Return the end of the status line: compile time, computing time, and "computed" or "cached"."""
        spent, compiling = self._spent()
        once = f"{compiling:.1f} s to compile, once · " if compiling > _LEAST_COMPILE_TIME else ""
        duration = f"{once}{1e3 * spent:.1f} ms, {'computed' if self._misses else 'cached'}"
        if not self.auto:
            return duration
        return f"{AUTO}: {self.level_name}{'' if self._settled else ' until it is measured'} · {duration}"


def orbit_status(orbit: Orbit | FreeMotion) -> list[str]:
    """Return status entries of an orbit: size, cost, error and drift."""
    return [
        f"{orbit.level}: orbit {orbit.times.size} points, {orbit.cost.steps} Taylor steps, "
        f"error ≤ {orbit.error_estimate:.1e} ({orbit.status})",
        "drift " + " ".join(f"{name} {drift:.0e}" for name, drift in orbit.drift.items()),
    ]


def accuracy_status(accurate: tuple[int, int | None] | None, crossings: int) -> Iterator[str]:
    """Yield the status entry of a section: up to which crossings the error is below half a pixel.

    Parameters
    ----------
    accurate : (int, int or None) or None
        Number of accurate crossings of the chosen orbit, and the median of some other orbits, None without others.
        None until known; then nothing is yielded.
    crossings : int
        Requested number of crossings.
    """
    if accurate is not None:
        own, others = (
            "to the end" if count is not None and count >= crossings else f"up to crossing {count}"
            for count in accurate
        )
        median = "" if accurate[1] is None else f", others {others} (median)"
        yield f"error below ½ pixel: chosen orbit {own}{median}"


def drift_status(drifts: Iterable[Mapping[str, float]]) -> Iterator[str]:
    """Yield the status entry of the largest drift of each integral; nothing without drifts."""
    largest: dict[str, float] = {}
    for drift in drifts:
        largest |= {name: max(largest.get(name, 0.0), value) for name, value in drift.items()}
    if largest:
        yield "drift " + " ".join(f"{name} {value:.0e}" for name, value in largest.items())
