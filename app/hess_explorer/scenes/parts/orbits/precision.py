"""Errors, drift and cost of a motion, measured at every level of accuracy."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.scene import Motion
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.chart import POWERS, clip, limit
from hess_explorer.views.graphs.levels import curves_of_integrals, curves_of_levels, methods
from hess_explorer.views.layers import Columns, Range, column, ring
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics import work_precision as mechanics
from hess_mechanics.numerics.accuracy import LEVELS, level
from hess_mechanics.numerics.results import Array

SAMPLES = 400
_FLOOR, _PIXEL_FLOOR = 1e-17, 1e-14
_ERRORS = (_FLOOR, 10.0)
Curve = tuple[Array, Array]


@dataclass(frozen=True)
class Precision:
    """Errors, drift and cost of a motion at every level of accuracy.

    Attributes
    ----------
    work : Work
        Computation of the state.
    motion : Motion
        The motion.
    """

    work: Work
    motion: Motion

    @cached_property
    def limited_motion(self) -> Motion:
        """The measured motion: `motion`, or its beginning if all of it would take too long."""
        return replace(
            self.motion, duration=min(self.motion.duration, mechanics.longest_duration(*self.motion.arguments[:3]))
        )

    @cached_property
    def work_points(self) -> tuple[mechanics.WorkPoint, ...]:
        """Error and cost of every level, then of SciPy's methods unless they are slow or during a drag."""
        others = (
            ()
            if self.work.is_preview or mechanics.scipy_takes_long(*self.limited_motion.arguments)
            else self.work.need(Task(mechanics.measure_scipy, *self.limited_motion.arguments, SAMPLES))
        )
        return self.work.need(Task(mechanics.measure_levels, *self.limited_motion.arguments, SAMPLES)) + others

    @cached_property
    def growth(self) -> mechanics.ErrorGrowth:
        """Errors and drifts over time at every level."""
        return self.work.need(
            Task(mechanics.growth, *self.limited_motion.arguments, self.limited_motion.weights, SAMPLES)
        )

    @cached_property
    def times(self) -> Array:
        """The times (n,) of the measured errors, in the units of the scene."""
        return self.growth.times * self.limited_motion.unit

    @property
    def _taylor(self) -> list[mechanics.WorkPoint]:
        return [point for point in self.work_points if point.method == "Taylor"]

    @property
    def _here(self) -> mechanics.WorkPoint:
        return next(point for point in self._taylor if point.setting == self.work.level_name)

    @property
    def _drifts(self) -> Mapping[str, Array]:
        return self.growth.drifts[self.work.level_name]

    # ---- pictures -----------------------------------------------------------------------------------------------

    def _of_method(self, method: str) -> Curve:
        own = [point for point in self.work_points if point.method == method]
        return clip(np.array([point.error for point in own]), _FLOOR), np.array([point.ms for point in own])

    def _at_level(self, name: str) -> Curve:
        errors, ms = self._of_method("Taylor")
        i = [*LEVELS].index(name)
        return errors[i : i + 1], ms[i : i + 1]

    def _level_point(self) -> list[tuple[float, float]]:
        return [(max(self._here.error, _FLOOR), max(self._here.ms, _FLOOR))]

    def _over_time(self, values: Array, floor: float = _FLOOR) -> Curve:
        return self.times, clip(values, floor)

    def _drift(self, i: int) -> Curve | None:
        drifts = [*self._drifts.values()]
        return self._over_time(drifts[i]) if i < len(drifts) else None

    def _span(self) -> Range:
        return 0.0, float(self.times[-1])

    def track(self) -> Columns:
        """Return the columns that the moving points follow: t, and error, largest drift and pixels at the level."""
        return {
            "t": column(self.times),
            "growth": column(clip(self.growth.errors[self.work.level_name], _FLOOR)),
            "drift": column(clip(np.max([*self._drifts.values()], axis=0), _FLOOR)),
            "pixels": column(clip(self.growth.pixels[self.work.level_name], _PIXEL_FLOOR)),
        }

    def choose(self, x: float, y: float) -> Mapping[str, str]:
        """Return the level whose error is nearest to x on a logarithmic axis, as a parameter; empty unless x > 0."""
        if not x > 0.0:
            return {}
        return {"accuracy": min(self._taylor, key=lambda point: abs(math.log10(max(point.error, _FLOOR) / x))).setting}

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_cost(self) -> Caption:
        here = self._here
        numbers_text = f"{self.work.level_name}: {digits(here.ms, 2)} ms, error {digits(here.error, 2)}"
        other = mechanics.fastest_scipy_method(self.work_points, 10.0 * here.error)
        if other is not None:
            numbers_text += f"; {other.method}: {digits(other.ms / here.ms, 2)} × as long, {digits(other.error, 2)}"
        return Caption(numbers=f"{numbers_text}.")

    def _about_growth(self) -> Caption:
        own, promise = float(self.growth.errors[self.work.level_name][-1]), level(self.work.level_name).promise
        return Caption(
            numbers=f"{self.work.level_name}: {digits(own, 2)} at the end; promised {digits(promise)} (dotted)."
        )

    def _about_drift(self) -> Caption:
        largest = ", ".join(
            f"({i + 1}) {name} {digits(float(drift.max()), 2)}" for i, (name, drift) in enumerate(self._drifts.items())
        )
        return Caption(numbers=f"{self.work.level_name}: largest drift {largest}.")

    def _about_pixels(self) -> Caption:
        t, pixels = self.times, self.growth.pixels[self.work.level_name]
        wrong = np.flatnonzero(pixels > 1.0)
        if wrong.size:
            until = digits(float(t[wrong[0]]))
            return Caption(
                f"{self.work.level_name}: not accurate to the end.", f"Error below one pixel until t = {until}."
            )
        return Caption(
            f"{self.work.level_name}: accurate to the end.",
            f"Error below one pixel until t = {digits(float(t[-1]))} (at most {digits(pixels.max(), 2)}).",
        )

    def quantities(self) -> Iterator[str]:
        """Yield the system, its parameters and the initial state."""
        motion, system = self.limited_motion, self.limited_motion.system
        yield f"System: {system.title}"
        yield f"Equations: {system.source} ({', '.join(system.labels)} in the LaTeX source)"
        named = ((system.parameters, motion.parameters, ""), (system.variables, motion.start, "(0)"))
        for names, values, when in named:
            yield from (f"{name}{when} = {digits(value)}" for name, value in zip(names, values, strict=True))

    def status(self) -> Iterator[str]:
        """Yield the cost and error of every level, if they have been measured."""
        for point in self._taylor if "work_points" in vars(self) else ():
            yield f"{point.setting} {digits(point.ms, 2)} ms, error {digits(point.error, 2)}"

    def notes(self) -> Iterator[str]:
        """Yield the limits of the measurement with reasons."""
        motion = self.limited_motion
        if motion.duration < self.motion.duration:
            yield f"Measured up to t = {digits(motion.duration * motion.unit)}, because more takes several seconds."
        if "work_points" in vars(self) and mechanics.scipy_takes_long(*motion.arguments):
            yield "SciPy's methods are slow over this time span and were omitted: choose a shorter one."


PRECISION_PICTURES: tuple[Plot[Precision], ...] = (
    Plot(
        name="precision",
        title="Cost against error",
        caption=Precision._about_cost,
        log="xy",
        axes=("largest error", "milliseconds"),
        x=_ERRORS,
        y=(1e-2, 1e4),
        x_ticks=POWERS,
        y_tick_count=5,
        on_click=Precision.choose,
        layers=(
            *methods(Precision._of_method, Precision._at_level),
            ring("chosen", Precision._level_point, size=20, label="chosen level"),
        ),
    ),
    Plot(
        name="growth",
        title="Error over time",
        caption=Precision._about_growth,
        log="y",
        axes=("t", "error"),
        x=Precision._span,
        y=_ERRORS,
        y_tick_count=5,
        dot=("t", "growth"),
        layers=(
            limit(lambda s: level(s.work.level_name).promise),
            *curves_of_levels(lambda s, name: s._over_time(s.growth.errors[name])),
        ),
    ),
    Plot(
        name="drift",
        title="Drift of the integrals",
        caption=Precision._about_drift,
        log="y",
        x=Precision._span,
        y=_ERRORS,
        axes=("t", "relative drift"),
        y_tick_count=5,
        dot=("t", "drift"),
        layers=curves_of_integrals(Precision._drift),
    ),
    Plot(
        name="pixels",
        title="Error in pixels",
        caption=Precision._about_pixels,
        log="y",
        x=Precision._span,
        axes=("t", "error in pixels"),
        y=(_PIXEL_FLOOR, 1e4),
        y_tick_count=5,
        dot=("t", "pixels"),
        layers=(
            limit(lambda s: 1.0),
            *curves_of_levels(lambda s, name: s._over_time(s.growth.pixels[name], _PIXEL_FLOOR)),
        ),
    ),
)
"""Cost against error, error over time, drift, and error in pixels."""
